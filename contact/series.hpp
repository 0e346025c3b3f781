// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The normal force over a step of a contact with a spring in series: the residual flexibility of the modes (transient/splitting/flexible_contacts.hpp).
#pragma once
#include "contact/normal_law.hpp"

namespace fretwork::contact {

/// Step form: F_N constant over a step, the damper implicit. `mean` is the mean penetration (> 0) and `free_rate` the mean rate p' there would be without
/// this force, `mobility` = (h/2) n.W.n what the mean normal speed changes by per newton, `compliance` R (m/N, >= 0) a spring in series that the
/// force compresses: P = mean - R F_N,
///     F_N = <K_N P + c(P) p'>+,  p' = free_rate - mobility F_N,
/// linear in F_N but for Hunt and Crossley's damper, which makes it a F^2 - b F + c = 0, the smaller root: K_N/(1 + K_N R) alone.
[[nodiscard]] inline double series_force(const NormalLaw& law, double mean, double free_rate, double mobility,
                                         double compliance) {
  const double growth = law.stiffness * law.dissipation, impact = 1.0 + law.dissipation * free_rate;
  const double c = law.stiffness * mean * impact + law.damping * free_rate;
  if (!(c > 0.0))
    return 0.0;
  const double a = growth * compliance * mobility;
  const double b = 1.0 + law.stiffness * compliance * impact + (law.damping + growth * mean) * mobility;
  return 2.0 * c / (b + std::sqrt(std::max(0.0, b * b - 4.0 * a * c)));
}

} // namespace fretwork::contact
