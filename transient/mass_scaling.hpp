// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Selective mass scaling: modes too fast for a step of splitting, which resonates with them at w h = pi, are made heavier. Stiffness,
/// shape, damper and forces stay, so that their flexibility at the contacts stays; their frequency falls to `fastest` = 2.5/h, which is
/// five times the frequency of the contacts or more (step_rule.hpp): they follow the contact forces statically, as they would at their own
/// frequency. (L. Olovsson, K. Simonsson, M. Unosson, Int. J. Numer. Meth. Engng 63 (2005) 1436, for meshes.)
///
///     m q'' + c q' + w^2 q = f, m = (w/fastest)^2;   q = s p, s = m^-1/2:   p'' + s^2 c p' + fastest^2 p = s f
///
/// Measured on a short tube with modes to 14 w_c (bench_statistics, 100 runs of 10 s): work rate -1.1 +- 0.6 %, forces -0.7 %, impacts
/// 0.0 %, as without (-0.6 +- 0.5 % for the step alone), in less than half of the steps.
#pragma once
#include "transient/scene.hpp"

namespace fretwork::transient {

/// w h of splitting above which modes are scaled; the flow between actions errs by (w h)^2/12 in their flexibility, and diverges at pi.
constexpr double before_resonance = 2.5;

/// Modal masses, n, >= 1. Modes that no contact moves are followed at any frequency: 1.
/// @param fastest  rad/s; 0: none is scaled
[[nodiscard]] Eigen::VectorXd scaled_masses(const Scene& scene, double fastest);

/// True where nothing but contacts makes scaled modes vibrate to speak of, at their own frequency or the lower one: of the energy with which
/// modes start to vibrate (initial state, loads that set in) they have a share below `accuracy`/10, of what loads bend statically one below
/// `accuracy`, and the intervals of tables are not shorter than the period 2 pi / fastest.
[[nodiscard]] bool may_scale(const Scene& scene, double fastest, double table_interval, double accuracy);

/// The scene in the coordinates p.
[[nodiscard]] Scene with_masses(const Scene& scene, const Eigen::VectorXd& masses);

} // namespace fretwork::transient
