// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Normal force: a spring and a damper that never pull. With p = -gap the penetration, p' its rate,
///     F_N = <K_N p + c(p) p'>+  for p >= 0, 0 otherwise;   c(p) = C_N + K_N d p
/// C_N: the damper of the reference (R5.06.03 eq. 3.1-4), whose force starts at once at C_N p'.
/// d:   Hunt and Crossley's damper (J. Appl. Mech. 42, 1975, p. 440), F_N = K_N p <1 + d p'>+: no force at
///      first touch, none at release, and a loss that grows with the speed of impact.
/// What impacts lose: restitution.hpp.
#pragma once
#include <algorithm>
#include <cmath>

namespace fretwork::contact {

struct NormalLaw {
  double stiffness;         ///< K_N, N/m, > 0
  double damping = 0.0;     ///< C_N, N s/m, >= 0
  double dissipation = 0.0; ///< d, s/m, >= 0

  [[nodiscard]] bool damps() const { return damping > 0.0 || dissipation > 0.0; }
  /// c(p), N s/m.
  template <class T> [[nodiscard, gnu::always_inline]] T damping_at(T penetration) const {
    return damping + stiffness * dissipation * penetration;
  }
  /// K_N p + c(p) p', N: the force of a closed contact, whatever its sign. Numbers, or lanes of them.
  template <class T> [[nodiscard, gnu::always_inline]] T spring_and_damper(T penetration, T rate) const {
    return stiffness * penetration + damping_at(penetration) * rate;
  }
  /// Energy of the spring, J; none where the contact is open.
  [[nodiscard]] double spring_energy(double penetration) const {
    const double closed = std::max(0.0, penetration);
    return 0.5 * stiffness * closed * closed;
  }
};

/// F_N at penetration p (m) and rate p' (m/s).
[[nodiscard]] inline double normal_force(const NormalLaw& law, double penetration, double rate) {
  return penetration < 0.0 ? 0.0 : std::max(0.0, law.spring_and_damper(penetration, rate));
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

/// The share s of the window that is closed gives its derivatives: 1/2 by both ends where s = 1, else s^2/2
/// by the end that is open and s - s^2/2 by the one that is closed.
struct MeanSlopes {
  double by_p1, by_p2;
};
[[nodiscard]] inline MeanSlopes mean_slopes(double p1, double p2) {
  if (p1 > 0.0 && p2 > 0.0)
    return {0.5, 0.5};
  if (!(p1 > 0.0 || p2 > 0.0))
    return {0.0, 0.0};
  const double s = std::max(p1, p2) / std::abs(p2 - p1);
  const double open = 0.5 * s * s, closed = s - open;
  return p1 > 0.0 ? MeanSlopes{closed, open} : MeanSlopes{open, closed};
}

/// Share of the way from p1 to p2 on which the contact is closed.
[[nodiscard]] inline double closed_share(double p1, double p2) {
  const double high = std::max(p1, p2), low = std::min(p1, p2);
  return low > 0.0 ? 1.0 : high > 0.0 ? high / (high - low) : 0.0;
}

} // namespace fretwork::contact
