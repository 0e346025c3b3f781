// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Screening for vortex shedding in liquid: where a frequency of the tube is near that of the vortices.
///     f_s(s) = St V(s)/D(s),   coincidence where |f_i - f_s| <= 0.2 f_s
/// Limits: a warning, no amplitude; liquid only (in two-phase flow vortices are not periodic); the Strouhal number of the
/// bundle is the user's.
#pragma once
#include "flow/sampling.hpp"

namespace fretwork::flow {

inline constexpr double shedding_band = 0.2; ///< of f_s

struct SheddingCoincidence {
  int mode;         ///< from 0
  int zone;         ///< from 0
  double s;         ///< m, where f_s is nearest to f_i
  double velocity;  ///< m/s there
  double frequency; ///< Hz, f_s there
};

/// At most one for each mode and zone, modes ascending; modes that do not move the tube across are left out.
/// @param strouhal  St > 0
/// @throws core::Error for a Strouhal number that is not positive
[[nodiscard]] std::vector<SheddingCoincidence> shedding_coincidences(const Sampling& sampling,
                                                                     double strouhal);

} // namespace fretwork::flow
