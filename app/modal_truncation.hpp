// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Warnings of modal truncation: what the modes that are left out take from the results.
///
/// Load band: a load above the highest mode excites nothing there; of a random load the share of its band above it is the share of its
/// power that is lost.
/// Flexibility: with x = K_N times the flexibility that the modes lack, a contact is too stiff by 1 + x, and the force of an impact, which
/// goes with the square root of the stiffness, too high by up to sqrt(1 + x) (doc/theory.md, section 5).
#pragma once
#include "app/build_scene.hpp"

namespace fretwork::app {

/// K_N times the missing flexibility from which on it is warned about: forces are too high by up to 14 %.
constexpr double much_missing = 0.3;

/// Modes are wanted up to so many times the highest frequency of the loads: what lies higher responds quasi-statically.
constexpr double modes_above_loads = 2.0;

/// Hz up to which the structure was given modes; infinite where it has no more.
[[nodiscard]] double end_of_modes(const study::Modes& modes, const modal::Basis& basis);

/// Of the load that goes farthest beyond the modes of a structure that it acts on; empty where none does, where the structure has no more
/// modes, and with modes.accuracy, which takes as many as the loads need (modes_limit.hpp).
/// @param bases  of all structures   @param loads  those of the fields
[[nodiscard]] std::string load_band_warning(const study::Study& study, const std::vector<modal::Basis>& bases,
                                            const std::vector<Fields::Load>& loads);

/// Of all contacts that lack more than `much_missing`; empty where there is none.
[[nodiscard]] std::string missing_flexibility_warning(const study::Study& study,
                                                      const std::vector<BuiltScene>& scenes);

/// What would give the contacts of a study the flexibility that they lack.
[[nodiscard]] std::string more_modes(const study::Study& study);

} // namespace fretwork::app
