// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Normal force of a step h that keeps the energy, constant over the step, from the penetrations p0 and p1 at its ends, <p> = max(p, 0):
///     F = <K_N m + C_N s ((1 - b) p_m' + b <p1'>) + K_N d m p_m'>+,   m = mean of <p> = (<p1>^2 - <p0>^2)/(2 (p1 - p0)),
/// p_m' = (p1 - p0)/h the mean rate, p1' the rate at the end of the step, 0 where it has the other sign, s the share of the step with p > 0.
/// The spring does the work -(V1 - V0), V = K_N <p>^2/2; the dampers and the positive part take energy at any step.
///
/// b makes the decay of a speed by C_N alone exact for a mass, v1 = v0 exp(-z) with z = C_N w, w what the rate changes by per newton over
/// the step (h/m for a mass m):
///     b = coth(z/2) - 2/z      (z/6 for small z: order 2; 1 for large z: no rebound, however large C_N)
/// b = 0, the mean rate alone, would turn the speed round: v1 = v0 (2 - z)/(2 + z). A steady rate has its force C_N p' for every b
/// (exponential fitting: W. Liniger and R. Willoughby, SIAM J. Numer. Anal. 7 (1970) 47).
#pragma once
#include "contact/normal_law.hpp"

namespace fretwork::transient {

/// b, >= 0, < 1. `mobility` is w, m/s per N; 0 is returned where it is not positive.
[[nodiscard]] double end_rate_share(double damping, double mobility);

struct StepNormal {
  double force = 0.0;                 ///< N, F before <>+
  double spring = 0.0;                ///< N, K_N m
  double by_end = 0.0, by_rate = 0.0; ///< dF/dp1, N/m, and dF/dp1', N s/m
};
/// @param share  b   @param rate  p1', m/s
[[nodiscard]] StepNormal step_normal_force(const contact::NormalLaw& law, double share, double p0, double p1,
                                           double rate, double h);

} // namespace fretwork::transient
