// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Values that are legal and in another unit than the SI's: sizes in mm, moduli in MPa, densities in t/m3, coefficients in per cent,
/// dynamic viscosities.
///
/// A value is suspected where it is outside what slender structures have, with a factor of ten or more of room:
///     sizes of sections      up to 3 m                        radial gaps           up to 0.1 m, about a tube up to 1.1 diameters
///     size of the mesh       up to 1000 m                     Young's modulus       from 1e7 Pa (rubber)
///     density                0 or 50 (foam) to 30000 kg/m3    friction coefficient  up to 2
///     supports of wear       up to 1 m long               correlation lengths   up to 10 m
///     modal damping          up to 0.3
///     liquids of flows       from 50 kg/m3         their kinematic viscosity   up to 2e-5 m2/s (ten times that of cold water)
///     mesh over sections     up to 2e4             added mass           up to 100 times that of the material
///     stiffness of contacts  above 1e3 N/m
///     offsets of contacts    up to 0.1 m           thickness of supports  up to 1 m
///     coefficients of wear   up to 1e-10 m2/N      gravity              up to 100 m/s2
///     gap velocities         up to 100 m/s, of gas up to 1000 m/s
///     fixed time step        up to the period of the stiffest contact against the whole mass of the model
#pragma once
#include "fem/model.hpp"
#include "mesh/line_mesh.hpp"
#include "study/study.hpp"
#include <functional>
#include <string>
#include <vector>

namespace fretwork::app {

/// One warning for all suspected values of a unit, each value with its key; none where nothing is suspected.
[[nodiscard]] std::vector<std::string> unit_slips(const study::Study& study, const mesh::LineMesh& mesh,
                                                  const fem::Model& model);

/// Runs `work`; what it refuses or fails to compute may follow from values in another unit, and its message then ends with the questions of
/// unit_slips.
/// @throws core::Error, core::ComputationError  what `work` throws
void asking_about_units(const std::vector<std::string>& slips, const std::function<void()>& work);

} // namespace fretwork::app
