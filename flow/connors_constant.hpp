// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Instability constants K of Connors' formula (stability.hpp).
///
/// Default, all arrangements, liquid and two-phase flow (Pettigrew and Taylor, Journal of Fluids and Structures 18 (2003)
/// 469):
///     K = 3.0 for P/D >= 1.47,   K = 4.76 (P - D)/D + 0.76 below
/// By arrangement, mean and lower bound of 90 % of the measurements (ASME Boiler and Pressure Vessel Code, section III,
/// appendix N-1330):
///     triangle 4.5, 2.8; rotated triangle 4.0, 2.3; rotated square 5.8, 3.5; square 3.4, 2.4; all 4.0, 2.4
#pragma once
#include "flow/added_mass.hpp"

namespace fretwork::flow {

/// By P/D.
/// @throws core::Error for a single tube, or P/D <= 1.05
[[nodiscard]] double default_connors_constant(const Bundle& bundle, double diameter);

struct MeasuredConstant {
  double mean, bound; ///< bound: below 90 % of the measurements
};
inline constexpr MeasuredConstant all_arrangements{4.0, 2.4};
/// @throws core::Error for a single tube
[[nodiscard]] MeasuredConstant measured_connors_constant(Arrangement arrangement);

} // namespace fretwork::flow
