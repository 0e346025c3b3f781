// SPDX-License-Identifier: GPL-3.0-or-later
#include "post/batch_maxima.hpp"
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace fretwork::post {

double error_of_largest(std::span<const double> maxima) {
  constexpr std::size_t fewest_batches = 8, most_batches = 31;
  std::vector<double> of(maxima.begin(), maxima.end());
  while (of.size() > most_batches) { // an odd last one joins the pair before it
    const std::size_t pairs = of.size() / 2;
    const double last = of.back();
    for (std::size_t k = 0; k < pairs; ++k)
      of[k] = std::max(of[2 * k], of[2 * k + 1]);
    of.resize(pairs);
    of.back() = std::max(of.back(), last);
  }
  if (of.size() < fewest_batches)
    return std::numeric_limits<double>::quiet_NaN();
  const auto n = static_cast<double>(of.size());
  const double mean = std::accumulate(of.begin(), of.end(), 0.0) / n;
  double squares = 0.0;
  for (const double value : of)
    squares += (value - mean) * (value - mean);
  return std::sqrt(squares / (n - 1.0));
}

void BatchMaxima::end_batch() {
  const std::size_t values = current_.size();
  std::copy(current_.begin(), current_.end(), rows_.begin() + static_cast<std::ptrdiff_t>(count_ * values));
  std::fill(current_.begin(), current_.end(), 0.0);
  if (++count_ < BatchEnds::most)
    return;
  count_ /= 2; // as BatchEnds joins pairs
  for (std::size_t batch = 0; batch < count_; ++batch)
    for (std::size_t k = 0; k < values; ++k)
      rows_[batch * values + k] =
          std::max(rows_[2 * batch * values + k], rows_[(2 * batch + 1) * values + k]);
}

double BatchMaxima::error(std::size_t which) const {
  std::vector<double> maxima;
  for (std::size_t batch = 0; batch < count_; ++batch)
    maxima.push_back(rows_[batch * current_.size() + which]);
  return error_of_largest(maxima);
}

} // namespace fretwork::post
