// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// A mass on springs that meets one stop with friction, by an integrator of its own: the laws of doc/contact.md written down once more.
///
/// Heun's method; forces from x, v and the tangential spring T. T follows T' = -K_T v in stick and T' = -(K_T/C_T)(T - F) in slip or open; with
/// C_T = 0 it is the radial return of elastic-perfectly-plastic slip, T = P(T - K_T dx), |T| <= mu F_N, and 0 while open. Errors of the first
/// order of the step at events and in the turning of the slip direction: the step is made fine instead.
#pragma once
#include "scenes.hpp"
#include <array>

namespace fretwork::tests {

/// Along x, y and z; the stop faces z.
struct SingleMass {
  double mass = 1.0;
  Vec3 stiffness = Vec3::Zero(), damping = Vec3::Zero(); ///< N/m, N s/m
  std::array<signals::Harmonic, 3> load{};
  Vec3 velocity = Vec3::Zero(); ///< at the start
  double gap = 0.0;             ///< m, < 0: overlap
  contact::NormalLaw normal{};
  double mu = 0.0, tangential_stiffness = 0.0, tangential_damping = 0.0;
  double duration = 1.0;
};

[[nodiscard]] transient::Scene scene_of(const SingleMass& mass);

/// Figures of a run, as post::ContactSummary has them.
struct MassFigures {
  double work_rate = 0.0, friction_power = 0.0, normal_rms = 0.0, normal_mean = 0.0, normal_max = 0.0,
         tangential_rms = 0.0, contact_time_ratio = 0.0;
  int impacts = 0;
  double tangential_max = 0.0;
};
[[nodiscard]] MassFigures integrate(const SingleMass& mass, double step);

/// A scene at random, the same for the same seed everywhere: pressed or with a gap, K_T/K_N from 0.01 to 1, mu from 0.1 to 1, the normal damper's ratio
/// from 0 to 0.3, five periods of the mass under harmonic loads in space.
/// @param damping  C_T over (K_T m)^1/2
[[nodiscard]] SingleMass random_mass(unsigned seed, double damping);
[[nodiscard]] MassFigures figures_of(const post::ContactSummary& summary);

} // namespace fretwork::tests
