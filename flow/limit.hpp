// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Limits that act on a result, and ranges of correlations that are left: returned as data, never silent.
#pragma once
#include <vector>

namespace fretwork::flow {

enum class LimitKind {
  damping_floor,       ///< applied: `value` became `bound`
  damping_ceiling,     ///< applied: `value` became `bound`
  stokes_number,       ///< noted: viscous damping holds above `bound`
  confinement,         ///< noted: the confinement of viscous damping holds for q above `bound`
  pitch_ratio,         ///< noted: q holds for P/D from 1.2 to 2; `bound` is the one that is passed
  elements_of_zone,    ///< noted: fewer elements than `bound` across the zone
  support_in_no_fluid, ///< noted: the support number `value` (from 0) is in no zone and damps nothing
};

struct Limit {
  LimitKind kind;
  int mode = -1;      ///< number, from 0; -1: all
  int zone = -1;      ///< number in the profile, from 0; -1: the whole tube
  double value = 0.0; ///< before, or found
  double bound = 0.0; ///< after, or of the range
};
using Limits = std::vector<Limit>;

} // namespace fretwork::flow
