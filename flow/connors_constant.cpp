// SPDX-License-Identifier: GPL-3.0-or-later
#include "flow/connors_constant.hpp"
#include "core/error.hpp"

namespace fretwork::flow {
namespace {

// Pettigrew and Taylor 2003
constexpr double wide_pitch_ratio = 1.47, wide_constant = 3.0, narrow_slope = 4.76, narrow_offset = 0.76;

} // namespace

double default_connors_constant(const Bundle& bundle, double diameter) {
  const double ratio = pitch_ratio(bundle, diameter);
  return ratio >= wide_pitch_ratio ? wide_constant : narrow_slope * (ratio - 1.0) + narrow_offset;
}

MeasuredConstant measured_connors_constant(Arrangement arrangement) {
  switch (arrangement) { // ASME III, appendix N-1330
  case Arrangement::triangle:
    return {4.5, 2.8};
  case Arrangement::rotated_triangle:
    return {4.0, 2.3};
  case Arrangement::rotated_square:
    return {5.8, 3.5};
  case Arrangement::square:
    return {3.4, 2.4};
  case Arrangement::single:
    break;
  }
  throw core::Error(
      "a single tube has no measured Connors constant; give K, or the arrangement of its bundle");
}

} // namespace fretwork::flow
