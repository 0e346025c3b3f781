// SPDX-License-Identifier: GPL-3.0-or-later
#include "post/batch_means.hpp"
#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>

namespace fretwork::post {
namespace {

constexpr double fewest =
    7.5; ///< 8 that need not be quite equal: the error itself is then known to a quarter
constexpr double quantile = 1.645; ///< of the normal distribution, 95 %

struct Batches {
  std::vector<double> lengths, deviations; ///< T_b, e_b

  /// Pairs become one, an odd last one joins the pair before it.
  void join_pairs() {
    const std::size_t pairs = lengths.size() / 2;
    for (std::vector<double>* values : {&lengths, &deviations}) {
      const double odd = values->size() % 2 == 1 ? values->back() : 0.0;
      for (std::size_t i = 0; i < pairs; ++i)
        (*values)[i] = (*values)[2 * i] + (*values)[2 * i + 1];
      values->resize(pairs);
      values->back() += odd;
    }
  }
};

double sum_of_squares(const std::vector<double>& values) {
  return std::inner_product(values.begin(), values.end(), values.begin(), 0.0);
}

} // namespace

BatchEstimate batch_means(std::span<const double> lengths, std::span<const double> sums) {
  assert(lengths.size() == sums.size());
  const double time = std::accumulate(lengths.begin(), lengths.end(), 0.0);
  if (!(time > 0.0))
    return {std::numeric_limits<double>::quiet_NaN(), 0.0};
  const double mean = std::accumulate(sums.begin(), sums.end(), 0.0) / time;
  Batches b{{lengths.begin(), lengths.end()}, {sums.begin(), sums.end()}};
  for (std::size_t i = 0; i < lengths.size(); ++i)
    b.deviations[i] -= mean * lengths[i];
  if (time * time < fewest * sum_of_squares(b.lengths))
    return {std::numeric_limits<double>::quiet_NaN(), time * time / sum_of_squares(b.lengths)};
  for (;;) {
    const double n = time * time / sum_of_squares(b.lengths), squares = sum_of_squares(b.deviations);
    const double neighbours =
        std::inner_product(b.deviations.begin(), b.deviations.end() - 1, b.deviations.begin() + 1, 0.0);
    const bool follow = neighbours > (quantile / std::sqrt(n) - 1.0 / n) * squares;
    if (!follow || n < 2.0 * fewest)
      return {std::sqrt(squares / (1.0 - 1.0 / n)) / time, n};
    b.join_pairs();
  }
}

BatchEstimate batch_deviation(std::span<const double> lengths, std::span<const double> first,
                              std::span<const double> squares, double shift, double deviation) {
  std::vector<double> about_mean(squares.begin(), squares.end());
  for (std::size_t b = 0; b < about_mean.size(); ++b)
    about_mean[b] += shift * (shift * lengths[b] - 2.0 * first[b]);
  BatchEstimate out = batch_means(lengths, about_mean);
  if (deviation > 0.0) // otherwise the error is 0 already, or not a number
    out.error /= 2.0 * deviation;
  return out;
}

BatchSums BatchEnds::batches_with_rest(double elapsed, std::span<const double> row) const {
  BatchSums out{{}, std::vector<std::vector<double>>(sums_)};
  double begin = 0.0;
  std::vector<double> before(sums_, 0.0);
  const auto add = [&](double end, std::span<const double> sums) {
    out.lengths.push_back(end - begin);
    begin = end;
    for (std::size_t k = 0; k < sums_; ++k)
      out.sums[k].push_back(sums[k] - before[k]);
    before.assign(sums.begin(), sums.end());
  };
  for (std::size_t b = 0; b < count_; ++b)
    add(times_[b], {rows_.data() + b * sums_, sums_});
  if (elapsed > begin)
    add(elapsed, row);
  return out;
}

/// Every second end remains.
void BatchEnds::join_pairs() {
  count_ /= 2;
  for (std::size_t i = 0; i < count_; ++i) {
    times_[i] = times_[2 * i + 1];
    std::copy_n(rows_.data() + (2 * i + 1) * sums_, sums_, rows_.data() + i * sums_);
  }
  length_ *= 2.0;
}

} // namespace fretwork::post
