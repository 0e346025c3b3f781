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

namespace fretwork::vibration {

/// Impulse response g and its derivative at time t.
struct Impulse {
  double g, rate;
};
[[nodiscard]] Impulse impulse_response(double k, double c, double t);

/// The coefficients of a step of length h.
[[nodiscard]] kernels::StepCoefficients step_coefficients(double k, double c, double h);

/// State at an instant inside a step, for output: as step_coefficients, cheap enough to be made for each
/// instant (no quadrature).
struct DenseCoefficients {
  double qq, qv, qf, qs; ///< f and s: load and its slope at the start
  double vq, vv, vf, vs;
};
[[nodiscard]] DenseCoefficients dense_coefficients(double k, double c, double t);

} // namespace fretwork::vibration
