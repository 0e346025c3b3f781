// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Forces of a law frozen at the frequency of each mode (fluidelastic_law.hpp) on the modes of a tube. Each mode n by itself, unit modal mass:
///     K_nn = int q c_k n_l^2 ds,  C_nn = int q (D/V) [c_d n_l^2 + (4/K^2) Vr (n_d^2 + n_l^2)] ds,  Vr = V/(f D)
/// n_d, n_l its shape along drag and lift. f is the frequency under flow, (2 pi f)^2 = w^2 - K_nn(f): what |s|/2 pi of s^2 + (c - C_nn) s + w^2 - K_nn
/// is. Where that has several solutions, one between w and the bound on the side to which K_nn moves it. No solution above 0: divergence, f = 0.
/// Modes of equal frequency are turned first to those that int q n_l^2 ds tells apart, so that the result does not depend on their axes.
/// Coupling between modes is left out. Source: Code_Aster R4.07.04 (CALC_FLUI_STRU).
#pragma once
#include "core/motion_forces.hpp"
#include "flow/fluidelastic_law.hpp"
#include "flow/law_places.hpp"

namespace fretwork::flow {

/// @param places  of the tube   @param frequency  Hz, of its vibration modes in still fluid; of equal modes exactly equal
/// @param first  mode of its structure among all `modes`   @param factor  >= 0, of all velocities
/// @throws core::Error for Connors' damping of a mode of frequency 0
[[nodiscard]] core::MotionForces frozen_forces(const std::vector<LawPlace>& places, const FrozenForce& law,
                                               const Eigen::VectorXd& frequency, Eigen::Index first,
                                               Eigen::Index modes, double factor);

} // namespace fretwork::flow
