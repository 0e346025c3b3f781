// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// A normal spring whose force acts at one instant t_k for a whole step h, between free flights (transient/splitting/flexible_contacts.hpp).
///
/// A mass 1/W that meets the spring K at the speed v (w_c^2 = K W, x = w_c h, P = p/h, p > 0) under a constant acceleration (of the structure it
/// belongs to) is to leave as it would from a force without end:
/// - while it stays closed, with its own frequency: F = K_h p, 1/K_h = (1/K)(1 + a + 3/5 a^2), a = x^2/12, which is K sinc^2(x/2) (to
///   x^6/6000). Masses pushed at instants stand (h^2/12) W F behind their mean between two of them, so that it also rests where K lets it
///   (to 3/5 a^2). With K alone the frequency is x^2/24 off and the place x^2/12 (the gradient correction of Takahashi and Imada,
///   J. Phys. Soc. Jpn. 53, 1984, p. 3765, of one contact);
/// - the instants at which it closes (m > P: open a step before) and opens lie anywhere among the actions. Sums over actions miss the force
///   h F'(t) B_2(P/v)/2 of one of them there (Euler and Maclaurin), which made a lossless impact gain or lose 7 % of its energy at x = 0.7.
///   From what the map of closed steps keeps, p^2 + q^2 - 2 p q cos x with q a step before or after (p and q from where the acceleration
///   alone would have them rest), the force that leaves the amplitude of the impact that touched at v, v^2 = s^2 - 4 d P, whenever it
///   began, and its mirror image that gives the speed back:
///       closing   F = (N + K_h h P (P + s + d))/(s + g P/2 + sqrt(k v^2 + (1 - g/4) P (4 d - g P)))
///       opening   F = (N + K_h h P (P - s + d))/(k (u - s)),   k u^2 = s^2 + g P (P - m) - 4 (1 - k) d P, u the speed after it;
///                 where m < g P/2, P + d < u
///       m, s      the rate of p: mean since the last action, and before this one;   d = s - m, half of h times the acceleration
///       g = K_h W h^2 = 2 - 2 cos x,   k = ((x/2) cot(x/2))^2 = 1 - 2 a + 3/5 a^2,   N = (1 - k) v^2/(h W) = K h v^2 (1 - 0.3 a)/6
/// So an impact of a mass alone keeps its energy and its impulse to round-off, for x up to 1.05, under a constant acceleration too: without
/// d, one of 1 % of v w_c off the obstacle gave 0.1 % of energy at each impact at x = 0.8, and a tube that bounces without other losses
/// had work rates 8 % too high. Faster modes are no constant acceleration: |d| <= g P/2 + |m|/10, beyond
/// which energy is not kept. Above 1.05 (no step to take) F = K_h p.
///
/// F h is an impulse; where it is that of an impact's beginning or end, the force at t_k is another one: K p sinc(x P/v), sinc(x P/u), of the
/// impact that touches at the speed v, u that time away. Integrals of F^2 are sums of h F times it (in the mean over all beginnings to 1e-3
/// for x up to 0.95; sums of h F^2 are 0.7 % high at 0.8 and 2.4 % at 0.95).
#pragma once
#include <algorithm>
#include <cmath>

namespace fretwork::contact {

class InstantSpring {
public:
  struct Push {
    double force;   ///< F, N
    double instant; ///< N, the force at t_k
  };

  /// @param stiffness  K, N/m   @param mobility  (h/2) W, m/s per N   @param step  h, s
  InstantSpring(double stiffness, double mobility, double step)
      : step_(step), a_(stiffness * mobility * step / 6.0), share_(1.0 / (1.0 + a_ * (1.0 + 0.6 * a_))),
        stiffness_(stiffness), g_(12.0 * a_ * share_) {}

  /// K_h, N/m.
  [[nodiscard]] double closed_stiffness() const { return share_ * stiffness_; }

  /// At penetration p (m, > 0) which has grown at the rate m in the mean since the last action and grows at `rate` before this one, m/s.
  [[nodiscard]] Push push(double penetration, double m, double rate) const {
    const double closed = closed_stiffness() * penetration, per_step = penetration / step_;
    if (!(a_ <= most))
      return {closed, closed};
    const double limit = 0.5 * g_ * per_step + smooth * std::abs(m), d = std::clamp(rate - m, -limit, limit);
    const double s = m + d, v2 = s * s - 4.0 * d * per_step, k = 1.0 - 2.0 * a_ + 0.6 * a_ * a_;
    const double pushed = stiffness_ * step_ * v2 * (1.0 - 0.3 * a_) / 6.0;
    if (m > per_step) {
      const double rest = k * v2 + (1.0 - 0.25 * g_) * per_step * (4.0 * d - g_ * per_step);
      return {(pushed + closed * (per_step + s + d)) /
                  (s + 0.5 * g_ * per_step + std::sqrt(std::max(0.0, rest))),
              instant(penetration, v2)};
    }
    const double after2 = s * s + g_ * per_step * (per_step - m) - 4.0 * (1.0 - k) * d * per_step; // k u^2
    const double leaves = per_step + d;
    if (m < 0.5 * g_ * per_step && leaves > 0.0 && k * leaves * leaves < after2)
      return {(pushed + closed * (per_step - s + d)) / (std::sqrt(k * after2) - k * s),
              instant(penetration, after2 / k)};
    return {closed, closed};
  }
  /// The same without an acceleration, F.
  [[nodiscard]] double force(double penetration, double rate) const {
    return push(penetration, rate, rate).force;
  }

  static constexpr double most =
      1.05 * 1.05 / 12.0;               ///< a at x = 1.05: from 1.1 on impacts gain or lose energy
  static constexpr double smooth = 0.1; ///< |d| over |m|

private:
  /// K p sinc(x P/speed), to (x P/speed)^6/5040.
  [[nodiscard]] double instant(double penetration, double speed2) const {
    const double angle2 = 12.0 * a_ * penetration * penetration / (step_ * step_ * speed2);
    return stiffness_ * penetration * (1.0 - angle2 / 6.0 * (1.0 - angle2 / 20.0));
  }

  double step_, a_, share_, stiffness_, g_;
};

} // namespace fretwork::contact
