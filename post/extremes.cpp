// SPDX-License-Identifier: GPL-3.0-or-later
#include "post/extremes.hpp"
#include "kernels/vector_lanes.hpp"
#include <algorithm>
#include <cmath>

namespace fretwork::post {
namespace {

using namespace kernels;

constexpr double round_off = 1e-6; ///< of a spacing of samples, after 1e9 steps

// No array overlaps another: the compiler takes as many signals at once as a vector has numbers.
/// The extremes of samples. Returns of how many signals the last sample may have a crest beside it that is one.
template <class>
FRETWORK_INLINE double watch_samples_on(std::size_t n, const double* __restrict before,
                                        const double* __restrict last, const double* __restrict value,
                                        double* __restrict min, double* __restrict max) {
  double crests = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    const double a = before[i], b = last[i], c = value[i], margin = 0.125 * std::abs(c - a);
    const double low = c < min[i] ? c : min[i], high = c > max[i] ? c : max[i];
    min[i] = low;
    max[i] = high;
    const double outside = b - margin < low ? 1.0 : b + margin > high ? 1.0 : 0.0;
    crests += (b - a) * (c - b) <= 0.0 ? outside : 0.0;
  }
  return crests;
}
FRETWORK_KERNEL(double, watch_samples,
                (std::size_t n, const double* before, const double* last, const double* value, double* min,
                 double* max),
                (n, before, last, value, min, max))

} // namespace

void Extremes::watch(const double* values, double time) {
  const std::size_t n = last_.size();
  if (samples_ == 0)
    for (auto* all : {&min_, &max_, &before_, &last_})
      all->assign(values, values + n);
  const double spacing = time - time_,
               crests = watch_samples(n, before_.data(), last_.data(), values, min_.data(), max_.data());
  const bool even = samples_ == 2 && std::abs(spacing - spacing_) <= round_off * spacing;
  for (std::size_t i = 0; even && crests > 0.0 && i < n; ++i) {
    const double before = last_[i] - before_[i], after = values[i] - last_[i], sum = before + after;
    if (before * after > 0.0 || before == after)
      continue;
    const double crest =
        last_[i] - sum * sum / (8.0 * (after - before)); // of opposite signs: nothing cancels
    min_[i] = std::min(min_[i], crest);
    max_[i] = std::max(max_[i], crest);
  }
  samples_ = std::min(samples_ + 1, 2);
  spacing_ = spacing;
  time_ = time;
  before_.swap(last_);
  std::copy_n(values, n, last_.begin());
}

} // namespace fretwork::post
