// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The exact motion of one mode, q'' + c q' + k q = f(t), over a step in which f is linear.
///
/// With g the response to a unit impulse (g(0) = 0, g'(0) = 1) and a = g' + c g (the response to a unit
/// displacement):
///     q(h) = a q0 + g v0 + R0 f0 + R1 (f1 - f0)          R_j = int_0^h g(h - t) (t/h)^j dt
///     v(h) = -k g q0 + g' v0 + R0' f0 + R1' (f1 - f0)    R_j' = int_0^h g'(h - t) (t/h)^j dt
/// k >= 0 and c >= 0 are arbitrary: under-, over- and critically damped, rigid (k = 0) with and without
/// damping.
#pragma once
#include "kernels/kernels.hpp"
#include <Eigen/Core>
#include <array>

namespace fretwork::vibration {

/// Impulse response g and its derivative at time t.
struct Impulse {
  double g, rate;
};
[[nodiscard]] Impulse impulse_response(double k, double c, double t);

/// The coefficients of a step of length h.
[[nodiscard]] kernels::StepCoefficients step_coefficients(double k, double c, double h);

/// w h up to which the end of a step tells what a force does to a mode within it: above, half a period is shorter than the step.
inline constexpr double highest_followed = 3.0;
/// A force mean - slope to mean + slope, linear over a step.
struct LinearForce {
  double mean, slope;
};
/// Those that leave the mode where forces by Legendre's polynomials of degree 2 and 3 leave it, 6 s^2 - 6 s + 1 and 20 s^3 - 30 s^2 + 12 s - 1 with
/// s = t/h. Their mean and first moment are 0: a mode that is slow in the step does not feel them. With Q_j the response to s^j:
/// Q_j' = j Q_(j-1)/h, k Q_j = 1 - c Q_j' - j (j-1) Q_(j-2)/h^2.
/// @param k, c  0.1 <= sqrt(k) h < highest_followed, c h <= 1e3: else closed forms cancel   @param s  step_coefficients(k, c, h)
[[nodiscard]] std::array<LinearForce, 2> linear_for_bends(double k, double c, double h,
                                                          const kernels::StepCoefficients& s);

/// State at an instant inside a step, for output: as step_coefficients, cheap enough to be made for each
/// instant (no quadrature).
struct DenseCoefficients {
  double qq, qv, qf, qs; ///< f and s: load and its slope at the start
  double vq, vv, vf, vs;
};
[[nodiscard]] DenseCoefficients dense_coefficients(double k, double c, double t);

} // namespace fretwork::vibration
