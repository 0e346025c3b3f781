// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Normal force: a spring and a damper that never pull. With p = -gap the penetration, p' its rate,
///     F_N = <K_N p + c(p) p'>+  for p >= 0, 0 otherwise;   c(p) = C_N + K_N d p
/// C_N: the damper of the reference (R5.06.03 eq. 3.1-4), whose force starts at once at C_N p'.
/// d:   Hunt and Crossley's damper (J. Appl. Mech. 42, 1975, p. 440), F_N = K_N p <1 + d p'>+: no force at first
///      touch, none at release, and a loss that grows with the speed of impact.
/// What impacts lose: restitution.hpp.
#pragma once
#include <algorithm>

namespace fretwork::contact {

struct NormalLaw {
  double stiffness;         ///< K_N, N/m, > 0
  double damping = 0.0;     ///< C_N, N s/m, >= 0
  double dissipation = 0.0; ///< d, s/m, >= 0

  [[nodiscard]] bool damps() const { return damping > 0.0 || dissipation > 0.0; }
  /// c(p), N s/m.
  [[nodiscard]] double damping_at(double penetration) const {
    return damping + stiffness * dissipation * penetration;
  }
};

/// F_N at penetration p (m) and rate p' (m/s).
[[nodiscard]] inline double normal_force(const NormalLaw& law, double penetration, double rate) {
  return penetration < 0.0 ? 0.0
                           : std::max(0.0, law.stiffness * penetration + law.damping_at(penetration) * rate);
}

/// F_N and its derivatives, those of the open side where the force is 0.
struct NormalSlopes {
  double force;          ///< N
  double by_penetration; ///< N/m
  double by_rate;        ///< N s/m
};
[[nodiscard]] inline NormalSlopes normal_slopes(const NormalLaw& law, double penetration, double rate) {
  const double force = normal_force(law, penetration, rate);
  if (!(force > 0.0))
    return {0.0, 0.0, 0.0};
  return {force, law.stiffness * (1.0 + law.dissipation * rate), law.damping_at(penetration)};
}

/// Mean penetration over a window in which it goes linearly from p1 to p2, its open part counted as 0.
[[nodiscard]] inline double mean_penetration(double p1, double p2) {
  if (p1 > 0.0 && p2 > 0.0)
    return 0.5 * (p1 + p2);
  if (p2 > 0.0)
    return 0.5 * p2 * p2 / (p2 - p1);
  if (p1 > 0.0)
    return 0.5 * p1 * p1 / (p1 - p2);
  return 0.0;
}

/// Step form: F_N constant over a step, the damper implicit. `mean` is the mean penetration (> 0),
/// `free_rate` the mean rate p' without this force, `mobility` = (h/2) n.W.n, what the mean normal speed
/// changes by per newton: with p' = free_rate - mobility F_N,
///     F_N = <K_N mean + c(mean) free_rate>+ / (1 + c(mean) mobility).
[[nodiscard]] inline double step_normal(const NormalLaw& law, double mean, double free_rate,
                                        double mobility) {
  const double c = law.damping_at(mean);
  return std::max(0.0, law.stiffness * mean + c * free_rate) / (1.0 + c * mobility);
}

} // namespace fretwork::contact
