// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// A normal spring whose force acts at one instant t_k for a whole step h, between free flights (transient/contact_solver.hpp).
///
/// A mass 1/W that meets the spring K at the speed v (w_c^2 = K W, x = w_c h, P = p/h, p > 0) is to leave as it would from a force without end:
/// - while it stays closed, with its own frequency: F = K_h p, 1/K_h = (1/K)(1 + a + 3/5 a^2), a = x^2/12, which is K sinc^2(x/2) (to
///   x^6/6000). Masses pushed at instants stand (h^2/12) W F behind their mean between two of them, so that it also rests where K lets it
///   (to 3/5 a^2). With K alone the frequency is x^2/24 off and the place x^2/12 (the gradient correction of Takahashi and Imada,
///   J. Phys. Soc. Jpn. 53, 1984, p. 3765, of one contact);
/// - the instants at which it closes (v > P: open a step before) and opens lie anywhere among the actions. Sums over actions miss the force
///   h F'(t) B_2(P/v)/2 of one of them there (Euler and Maclaurin), which made a lossless impact gain or lose 7 % of its energy at x = 0.7.
///   From what the map of closed steps keeps, p^2 + q^2 - 2 p q cos x with q a step before or after, the force that leaves the amplitude
///   v/w_c K/K_h of the actions, whenever the impact begins, and its mirror image that gives the speed back:
///       closing   F = (N + K_h h P (P + v))/(v + g P/2 + sqrt(k v^2 - g (1 - g/4) P^2))
///       opening   F = (N + K_h h P (P - v))/(k (u - v)),   u = sqrt((v^2 + g P (P - v))/k) the speed after it; where v < g P/2, P < u
///       g = K_h W h^2 = 2 - 2 cos x,   k = ((x/2) cot(x/2))^2 = 1 - 2 a + 3/5 a^2,   N = (1 - k) v^2/(h W) = K h v^2 (1 - 0.3 a)/6
/// So an impact of a mass alone keeps its energy to round-off, and its impulse, for x up to 0.95. Above that (no step to take) F = K_h p.
#pragma once
#include <cmath>

namespace fretwork::contact {

class InstantSpring {
public:
  /// @param stiffness  K, N/m   @param mobility  (h/2) W, m/s per N   @param step  h, s
  InstantSpring(double stiffness, double mobility, double step)
      : step_(step), a_(stiffness * mobility * step / 6.0), share_(1.0 / (1.0 + a_ * (1.0 + 0.6 * a_))),
        stiffness_(stiffness), g_(12.0 * a_ * share_) {}

  /// K_h, N/m.
  [[nodiscard]] double closed_stiffness() const { return share_ * stiffness_; }

  /// F at penetration p (m, > 0) which has grown at `rate` (m/s) in the mean since the last action.
  [[nodiscard]] double force(double penetration, double rate) const {
    const double closed = closed_stiffness() * penetration, v = rate, per_step = penetration / step_;
    if (!(a_ <= most))
      return closed;
    const double k = 1.0 - 2.0 * a_ + 0.6 * a_ * a_;
    const double pushed = stiffness_ * step_ * v * v * (1.0 - 0.3 * a_) / 6.0;
    if (v > per_step)
      return (pushed + closed * (per_step + v)) /
             (v + 0.5 * g_ * per_step + std::sqrt(k * v * v - g_ * (1.0 - 0.25 * g_) * per_step * per_step));
    const double after2 = v * v + g_ * per_step * (per_step - v); // k u^2
    if (v < 0.5 * g_ * per_step && k * per_step * per_step < after2)
      return (pushed + closed * (per_step - v)) / (std::sqrt(k * after2) - k * v);
    return closed;
  }

  static constexpr double most = 0.95 * 0.95 / 12.0; ///< a at x = 0.95: above 0.96 one at rest would open

private:
  double step_, a_, share_, stiffness_, g_;
};

} // namespace fretwork::contact
