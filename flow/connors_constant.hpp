// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The default instability constant K of Connors' formula (stability.hpp), all arrangements, liquid and two-phase flow (Pettigrew and Taylor, Journal of Fluids and Structures 18 (2003)
/// 469):
///     K = 3.0 for P/D >= 1.47,   K = 4.76 (P - D)/D + 0.76 below
/// Measured ones by arrangement: doc/tube-flow.md.
#pragma once
#include "flow/added_mass.hpp"

namespace fretwork::flow {

/// By P/D.
/// @throws core::Error for a single tube, or P/D <= 1.05
[[nodiscard]] double default_connors_constant(const Bundle& bundle, double diameter);

} // namespace fretwork::flow
