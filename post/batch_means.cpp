// SPDX-License-Identifier: GPL-3.0-or-later
#include "post/batch_means.hpp"
#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>

namespace fretwork::post {
namespace {

constexpr double fewest = 7.5; ///< 8 that need not be quite equal
constexpr std::size_t enough =
    31; ///< of more batches pairs are joined: what follows one another over several of them is seen
constexpr double strongest =
    0.8; ///< correlation that so few batches can tell: beyond, the window is shorter than the memory
constexpr double weakest = -0.35; ///< neighbours that undo each other: the variance falls to 0.3 at most
constexpr double least_freedom = 2.0;
constexpr double least_seen =
    0.2; ///< share of the variance of batches that their scatter about the mean of the window shows

/// Pairs become one, an odd last one joins the pair before it.
std::vector<double> joined(std::span<const double> values) {
  std::vector<double> out(values.size() / 2);
  for (std::size_t i = 0; i < out.size(); ++i)
    out[i] = values[2 * i] + values[2 * i + 1];
  if (values.size() % 2 == 1)
    out.back() += values.back();
  return out;
}

double sum_of_squares(const std::vector<double>& values) {
  return std::inner_product(values.begin(), values.end(), values.begin(), 0.0);
}

/// For a memory exp(-t/tau) and batches of length a tau.
double correlation_of_neighbours(double a) {
  const double fades = -std::expm1(-a);
  return fades * fades / (2.0 * (a - fades));
}

/// Variance of the mean of many batches over that of as many independent ones of the same variance.
double inflation(double correlation) {
  if (correlation <= 0.0)
    return 1.0 + 2.0 * correlation;
  double
      low = 0.1,
      high =
          2.0 +
          1.0 / correlation; // a: correlation_of_neighbours(low) > strongest; for large a it is 1/(2 (a - 1))
  constexpr int halvings = 50;
  for (int i = 0; i < halvings; ++i) {
    const double middle = 0.5 * (low + high);
    (correlation_of_neighbours(middle) > correlation ? low : high) = middle;
  }
  return low / (low + std::expm1(-low));
}

} // namespace

BatchEstimate batch_means(std::span<const double> lengths, std::span<const double> sums) {
  assert(lengths.size() == sums.size());
  if (lengths.size() > enough)
    return batch_means(joined(lengths), joined(sums));
  const double time = std::accumulate(lengths.begin(), lengths.end(), 0.0);
  if (!(time > 0.0))
    return {std::numeric_limits<double>::quiet_NaN(), 0.0};
  const double mean = std::accumulate(sums.begin(), sums.end(), 0.0) / time;
  std::vector<double> deviations(sums.begin(), sums.end());
  for (std::size_t i = 0; i < lengths.size(); ++i)
    deviations[i] -= mean * lengths[i];
  const double n = time * time / std::inner_product(lengths.begin(), lengths.end(), lengths.begin(), 0.0);
  if (n < fewest)
    return {std::numeric_limits<double>::quiet_NaN(), n};
  const double squares = sum_of_squares(deviations);
  if (!(squares > 0.0))
    return {squares, n};
  const double neighbours =
      std::inner_product(deviations.begin(), deviations.end() - 1, deviations.begin() + 1, 0.0);
  const double biased = neighbours / squares;
  const double r = std::clamp(biased + (1.0 + 3.0 * biased) / n, weakest, strongest), f = inflation(r);
  const double seen = std::max(1.0 - (f - 1.0) / (n - 1.0), least_seen);
  return {std::sqrt(f * squares / (seen * (1.0 - 1.0 / n))) / time,
          1.0 + std::max(n * (1.0 - r * r) / (3.0 + r * r), least_freedom)};
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
