// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Normal force of the reference: a spring and a damper that never pull,
///     F_N = <K_N p + C_N p'>+  for p >= 0, 0 otherwise;   p = -gap, p' = -gap rate.
/// Source: R5.06.03 eq. 3.1-4. A free mass m that hits it at speed v leaves at e v with, for xi = C_N / (2
/// sqrt(K_N m)) < 1, e = exp(-2 xi acos(xi) / sqrt(1 - xi^2)).
#pragma once
#include <algorithm>

namespace fretwork::contact {

struct NormalLaw {
  double stiffness;     ///< K_N, N/m, > 0
  double damping = 0.0; ///< C_N, N s/m, >= 0
};

/// F_N at penetration p (m) and rate p' (m/s).
[[nodiscard]] inline double normal_force(const NormalLaw& law, double penetration, double rate) {
  return penetration < 0.0 ? 0.0 : std::max(0.0, law.stiffness * penetration + law.damping * rate);
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
///     F_N = <K_N mean + C_N free_rate>+ / (1 + C_N mobility).
[[nodiscard]] inline double step_normal(const NormalLaw& law, double mean, double free_rate,
                                        double mobility) {
  return std::max(0.0, law.stiffness * mean + law.damping * free_rate) / (1.0 + law.damping * mobility);
}

} // namespace fretwork::contact
