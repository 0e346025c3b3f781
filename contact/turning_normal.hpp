// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The penetration of a contact over an interval dt in which its normal turns, as the wall is curved (doc/schemes.md, Turning normal, with these
/// letters). n and t are the axes at the mean position of the contact over the interval, tau the time since its middle, u the path of the contact
/// with a mean acceleration u'' that grows evenly, and v its velocity at the middle:
///     theta(tau) = omega tau + omega_dot tau^2/2 - delta,   omega = kappa v_t,
///     omega_dot = kappa (t.u'' - 2 omega v_n),   delta = kappa (t.u'') dt^2/24                                        (S6)
///     p'_0 = -(1 - (omega dt)^2/8) n.u'_0 - theta(-dt/2) t.u'_0                                                       (S7)
///     p'' = -n.u'' - omega v_t,   p''' = -n.u''' - omega t.u'' - b,   b = omega (t.u'' - omega v_n) + omega_dot v_t   (S8)
///     p_0 = p_m - (dt/2) (p'_0 + (dt/3) (p'' - p''' dt/4)),   p_m = -gap - omega v_t dt^2/24                          (S9)
/// Errors: of dt^4 in p_0, of dt^3 in p'_0.
#pragma once
#include <algorithm>
#include <cmath>

namespace fretwork::contact {

/// Components along n and t.
struct AlongAxes {
  double n, t;
};

/// The path of a contact over an interval, along the axes at its mean position.
struct PathAlongAxes {
  AlongAxes start;        ///< m/s, u'_0
  AlongAxes middle;       ///< m/s, v
  AlongAxes acceleration; ///< m/s2, u'', mean
  AlongAxes growth;       ///< m/s2, u''' dt
};

/// How the axes turn in the interval, n towards t.
struct AxesTurn {
  bool turns = false;
  double omega = 0.0;     ///< rad/s, at the middle
  double omega_dot = 0.0; ///< rad/s2
  double delta = 0.0;     ///< rad, by which the axes at the mean position are ahead of those at the middle
};

struct NormalKinematics {
  AxesTurn turn;
  double penetration;     ///< m, p_0
  double rate;            ///< m/s, p'_0
  double acceleration;    ///< m/s2, p'', mean
  double jerk_by_turning; ///< m/s3, b
};

/// rad: by which the normal turns in an interval at most. Near a centre or a corner it turns at once: no more than the interval can follow.
inline constexpr double most_turned = 1.0;

/// @param gap  m, at the mean position   @param curvature  1/m, kappa there
[[nodiscard]] inline NormalKinematics normal_kinematics(double dt, double gap, double curvature,
                                                        const PathAlongAxes& u) {
  const auto [vn, vt] = u.middle;
  const double at = u.acceleration.t;
  const double most = most_turned / (dt * (std::abs(vt) + std::abs(vn) + dt * std::abs(at)));
  const double kappa = std::clamp(curvature, -most, most);
  const double omega = kappa * vt, omega_dot = kappa * (at - 2.0 * omega * vn),
               delta = dt * dt / 24.0 * kappa * at;
  const double turned = -0.5 * dt * omega,
               theta = 0.125 * dt * dt * omega_dot - delta + turned; // at the start
  const double rate = -theta * u.start.t - (1.0 - 0.5 * turned * turned) * u.start.n;
  const double acceleration = -u.acceleration.n - omega * vt;
  const double b = omega * (at - omega * vn) + omega_dot * vt;
  const double growth = -u.growth.n - dt * (b + omega * at); // p''' dt
  const double mean = -gap - dt * dt / 24.0 * (omega * vt);
  return {{kappa != 0.0, omega, omega_dot, delta},
          mean - 0.5 * dt * (rate + dt / 3.0 * (acceleration - 0.25 * growth)),
          rate,
          acceleration,
          b};
}

} // namespace fretwork::contact
