// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Selective mass scaling: modes too fast for a step of splitting, which resonates with them at w h = pi, are made heavier. Stiffness,
/// shape, damper and forces stay, so that their flexibility at the contacts stays; their frequency falls to `fastest` = m/h, m/(w_c h)
/// times the frequency of the contacts (m = 2.5 and 5.5 at an accuracy of 0.01, step_rule.hpp): they go on following the contact forces statically.
/// (L. Olovsson, K. Simonsson, M. Unosson, Int. J. Numer. Meth. Engng 63 (2005) 1436, for meshes.)
///
///     m q'' + c q' + w^2 q = f, m = (w/fastest)^2;   q = s p, s = m^-1/2:   p'' + s^2 c p' + fastest^2 p = s f
///
/// Measured on a short tube with modes to 14 w_c (100 runs of 10 s, forces at instants): work rate -1.1 +- 0.6 %, forces -0.7 %, impacts
/// 0.0 %; the scaling by itself -0.3 +- 0.6, +0.1 and +0.1 %; in less than half of the steps.
#pragma once
#include "transient/scene/scene.hpp"

namespace fretwork::transient {

/// w h of splitting above which modes are scaled; under impulses h apart a mode deflects by (x/2) cot(x/2) of its flexibility, x = w h: 0.8 at 1.5,
/// 0.4 at 2.5, nothing at pi.
constexpr double before_resonance = 2.5;

/// Modal masses, n, >= 1. Modes that no contact moves are followed at any frequency: 1.
/// @param fastest  rad/s; 0: none is scaled
[[nodiscard]] Eigen::VectorXd scaled_masses(const Scene& scene, double fastest);

/// True where nothing but contacts makes scaled modes vibrate to speak of, at their own frequency or the lower one: of the energy with which
/// modes start to vibrate (initial state, loads that set in) they have a share below `accuracy`/10, of what loads bend statically one below
/// `accuracy`, and no table of a load that acts on them changes in less than the period 2 pi / fastest (jumps, pulses).
[[nodiscard]] bool may_scale(const Scene& scene, double fastest, double accuracy);

/// The scene in the coordinates p.
[[nodiscard]] Scene with_masses(const Scene& scene, const Eigen::VectorXd& masses);

} // namespace fretwork::transient
