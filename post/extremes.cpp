// SPDX-License-Identifier: GPL-3.0-or-later
#include "post/extremes.hpp"
#include "kernels/vector_lanes.hpp"
#include <algorithm>
#include <cmath>

namespace fretwork::post {
namespace {

using namespace kernels;

constexpr double round_off = 1e-9; ///< of a step

/// The extremes of samples. Returns how many signals may have a new one at the last sample's crest.
// No array overlaps another: the compiler takes as many signals at once as a vector has numbers.
template <class>
FRETWORK_INLINE double watch_samples_on(std::size_t n, const double* __restrict before,
                                        const double* __restrict last, const double* __restrict value,
                                        double* __restrict least, double* __restrict most) {
  double crests = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    const double a = before[i], b = last[i], c = value[i], more = 0.125 * std::abs(c - a);
    const double low = c < least[i] ? c : least[i], high = c > most[i] ? c : most[i];
    least[i] = low;
    most[i] = high;
    const double outside = b - more < low ? 1.0 : b + more > high ? 1.0 : 0.0;
    crests += (b - a) * (c - b) <= 0.0 ? outside : 0.0;
  }
  return crests;
}
FRETWORK_KERNEL(double, watch_samples,
                (std::size_t n, const double* before, const double* last, const double* value, double* least,
                 double* most),
                (n, before, last, value, least, most))

} // namespace

void Extremes::watch(const double* values, double step) {
  const std::size_t n = last_.size();
  if (equal_ == 0)
    for (auto* samples : {&least_, &most_, &before_, &last_})
      samples->assign(values, values + n);
  const bool equal = std::abs(step - step_) <= round_off * step;
  const double crests = watch_samples(n, before_.data(), last_.data(), values, least_.data(), most_.data());
  for (std::size_t i = 0; crests > 0.0 && equal && equal_ == 2 && i < n; ++i) {
    const double a = before_[i], b = last_[i], c = values[i];
    if (a == c || (b - a) * (c - b) > 0.0)
      continue;
    const double crest = b - (c - a) * (c - a) / (8.0 * (a - 2.0 * b + c));
    least_[i] = std::min(least_[i], crest);
    most_[i] = std::max(most_[i], crest);
  }
  equal_ = equal ? std::min(equal_ + 1, 2) : 1;
  step_ = step;
  before_.swap(last_);
  std::copy_n(values, n, last_.begin());
}

} // namespace fretwork::post
