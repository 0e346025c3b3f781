// SPDX-License-Identifier: GPL-3.0-or-later
#include "transient/splitting/force_answer.hpp"

namespace fretwork::transient {

LinearInTime answer_of(const Element& element, double step, double from, double to,
                       const LinearInTime& change) {
  const double k = element.stiffness * step * step, c = element.damping * step, w = element.mobility;
  const double from2 = from * from, to2 = to * to;
  // integrals of s, s2, s3, s4 while it is closed
  const double s1 = (to2 - from2) / 2.0, s2 = (to2 * to - from2 * from) / 3.0,
               s3 = (to2 * to2 - from2 * from2) / 4.0, s4 = (to2 * to2 * to - from2 * from2 * from) / 5.0;
  const double touch_mean = from2 / 2.0, touch_slope = from2 * (from / 3.0 - 0.5), late = 2.0 * from - 1.0;
  // of the force by a mean acceleration, by a slope: its mean, its slope 3 (2s - 1)
  const double mean_mean = k * s2 / 2.0 + c * (s1 + touch_mean);
  const double slope_mean = 3.0 * (k * (s3 - s2 / 2.0) + c * (2.0 * s2 - s1 + late * touch_mean));
  const double mean_slope = k * (s3 / 3.0 - s2 / 2.0) + c * (s2 - s1 + touch_slope);
  const double slope_slope = 3.0 * (k * (2.0 / 3.0 * s4 - 4.0 / 3.0 * s3 + s2 / 2.0) +
                                    c * (2.0 * s3 - 3.0 * s2 + s1 + late * touch_slope));
  // (1 + W J) f = -J x
  const double by_mean = -(mean_mean * change.mean + mean_slope * change.slope),
               by_slope = -(slope_mean * change.mean + slope_slope * change.slope);
  const double a = 1.0 + w * mean_mean, b = w * mean_slope, d = w * slope_mean, e = 1.0 + w * slope_slope;
  const double det = a * e - b * d;
  return {(e * by_mean - b * by_slope) / det, (a * by_slope - d * by_mean) / det};
}

} // namespace fretwork::transient
