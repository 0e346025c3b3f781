// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Friction of one contact (friction_law.hpp, `return_map`) over an interval in which its normal force N is a parabola in time. The contact moves
/// under a force of friction with the mean F and the growth G (normal_interval.hpp), over a time tau from the velocity v, by
///     dx = tau v + tau^2 (a/2 + j tau/6 + W (F/2 - G/12)) + Y G + S,    v1 = v + tau (a + j tau/2 + W F)
/// W its mobility. Y, the lift L of the mean of its displacement above the parabola through its ends, and S, what moves only the end, are those of the interval
/// by the fourth power of tau over it; in a plane K_T', c' and A are tensors with the axes of W. The interval is made in pieces of stick and slip, each of which ends where the law says so:
///     stick  F = T - A K_T dx + K_T' (tau (v1 - v)/12 - L - Y (F + 5 K_T' dx/8)) - C_T dx/tau,   G = -K_T' dx - c' (v1 - v);   T1 = T - K_T dx;
///            until |T - C_T v| reaches mu_s N
///     slip   F: mu_d times the mean of N, G: its growth;   T1 = T + (1 - e^-r)(F_s - T),  r = K_T tau/C_T;   until the slider stands
/// F_s is the force at the share s = 1/(1 - e^-r) - 1/r of the piece, of length mu_d N there; T1 is exact where F is a parabola, from slow dampers (s = 1/2)
/// to none (s = 1). The slider's speed against F is (|T - C_T v| - mu_d N)/C_T, without damper -v - mu_d N'/K_T along F.
/// In a plane F is along e, that of P = T - C_T v, and turns towards g = -v/|v|:
///     e' = (K_T |v|/|P|) (g - (g . e) e),    |P|' = -(K_T/C_T) (|P| - mu_d N - C_T |v| g . e)
/// At a constant velocity that is known in closed form (turning_slip.hpp), a tractrix without damper.
/// The displacement of the piece is found with F_s along T - (s K_T + C_T/tau) dx (radial return), which is implicit; directions then follow from it.
/// Stick is of order 4, as the normal motion; where a contact begins and ends to slide, and how its direction turns, is found to order 2.
#pragma once
#include "contact/friction_tables.hpp"
#include "contact/normal_interval.hpp"

namespace fretwork::contact {

/// Motion in the tangent plane (V = Vec2, M = Sym2), or on the line across x_loc (V = M = double).
template <class V, class M> struct TangentialPath {
  V velocity;     ///< m/s, at the start
  V acceleration; ///< m/s2, without friction, at the start
  V jerk;         ///< m/s3, without friction
  M mobility;     ///< 1/kg
  V lift{};       ///< m, L over the whole interval
  M compliance{}; ///< m/N, Y over the whole interval
  V shift{};      ///< m, S over the whole interval
  /// m: what the mean of the displacement exceeds that of the parabola by, under a force; of a piece the fourth power of its share.
  [[nodiscard]] V lift_under(V mean, V growth, double fourth = 1.0) const {
    return fourth * (lift + compliance * V(mean - 0.625 * growth));
  }
};

template <class V> struct FrictionInterval {
  V impulse{};               ///< N s
  V moment{};                ///< N s2, of the force about the middle of the interval
  V displacement{};          ///< m
  V spring{};                ///< N, T at the end
  V velocity{};              ///< m/s, at the end
  bool sliding = false;      ///< at the end
  double slider_work = 0.0;  ///< J
  double wear_work = 0.0;    ///< J, integral of N |v| while it slides
  double slid = 0.0;         ///< m, the path of that
  double sliding_time = 0.0; ///< s
  double at_changes = 0.0;   ///< N, the largest force where it changes between stick and slip
};

/// @param usual  of pieces of the length of most intervals; others are made
/// @param length  s   @param normal  N   @param mobility  1/kg, as that of `usual`
[[nodiscard]] FrictionInterval<double> friction_over_interval(const FrictionLaw& law,
                                                              const PieceTables& usual, double mobility,
                                                              double spring, bool sliding, double length,
                                                              const ParabolicForce& normal,
                                                              const TangentialPath<double, double>& path);
[[nodiscard]] FrictionInterval<Vec2> friction_over_interval(const FrictionLaw& law, const PieceTables& usual,
                                                            double mobility, Vec2 spring, bool sliding,
                                                            double length, const ParabolicForce& normal,
                                                            const TangentialPath<Vec2, Sym2>& path);

/// Share of the spring's force that is left of an open contact after t seconds.
[[nodiscard]] double spring_left(const FrictionLaw& law, double t);

} // namespace fretwork::contact
