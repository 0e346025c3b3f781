// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Selective mass scaling: modes too fast for a step of splitting, which resonates with them at w h = pi, are made heavier. Stiffness,
/// shape, damper and forces stay, so that their flexibility at the contacts stays; their frequency falls to `fastest`, what splitting
/// follows (step_rule.hpp), which is above that of the contacts: they go on following the contact forces statically.
/// (L. Olovsson, K. Simonsson, M. Unosson, Int. J. Numer. Meth. Engng 63 (2005) 1436, for meshes.)
///
///     m q'' + c q' + w^2 q = f, m = (w/fastest)^2;   q = s p, s = m^-1/2:   p'' + s^2 c p' + fastest^2 p = s f
///
/// Measured on a short tube with modes to 14 w_c, w_c h = 0.72 (16 runs): work rate +2.1 +- 3.7 %, forces -1.8 +- 1.2 %, impacts -0.6 +- 0.6 %.
#pragma once
#include "transient/scene/scene.hpp"

namespace fretwork::transient {

/// Modal masses, n, >= 1. Modes that no contact moves are followed at any frequency: 1.
/// @param fastest  rad/s; 0: none is scaled
[[nodiscard]] Eigen::VectorXd scaled_masses(const Scene& scene, double fastest);

/// True where nothing but contacts makes scaled modes vibrate to speak of, at their own frequency or the lower one: of the energy with which
/// modes start to vibrate (initial state but for what contacts hold bent, loads that set in) they have a share below `accuracy`/10, of what loads bend statically one below
/// `accuracy`, and no table of a load that acts on them changes in less than the period 2 pi / fastest (jumps, pulses). False where forces depend on the
/// motion: their damping of a mode goes with its frequency.
[[nodiscard]] bool may_scale(const Scene& scene, double fastest, double accuracy);

/// The scene, without forces that depend on the motion, in the coordinates p.
[[nodiscard]] Scene with_masses(const Scene& scene, const Eigen::VectorXd& masses);

} // namespace fretwork::transient
