// SPDX-License-Identifier: GPL-3.0-or-later
#include "flow/connors_constant.hpp"

namespace fretwork::flow {
namespace {

// Pettigrew and Taylor 2003
constexpr double wide_pitch_ratio = 1.47, wide_constant = 3.0, narrow_slope = 4.76, narrow_offset = 0.76;

} // namespace

double default_connors_constant(const Bundle& bundle, double diameter) {
  const double ratio = pitch_ratio(bundle, diameter);
  return ratio >= wide_pitch_ratio ? wide_constant : narrow_slope * (ratio - 1.0) + narrow_offset;
}

} // namespace fretwork::flow
