// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Friction of one contact (friction_law.hpp, `return_map`) over an interval in which its normal force N is linear in time. The contact moves under
/// the force F of friction, over a time tau from the velocity v, by
///     dx = tau v + beta tau^2 (a + A F),    v1 = v + tau (a + A F)
/// A its mobility, beta: implicit_share in stick, 1/2 in slip. The interval is made in pieces of stick and slip, each of which ends where the law says
/// so:
///     stick  F = T - (K_T/2 + C_T/tau) dx,   T1 = T - K_T dx;   until |T - C_T v| reaches mu_s N
///     slip   F: mu_d times the mean of N;   T1 = T + (1 - e^-r)(F_s - T),  r = K_T tau/C_T;   until the slider stands
/// F_s is the force at the share s = 1/(1 - e^-r) - 1/r of the piece, of length mu_d N there and along T - (s K_T + C_T/tau) dx; T1 is exact where F is linear in time,
/// from slow dampers (s = 1/2) to none (s = 1: radial return). The slider's speed against F is (|T - C_T v| - mu_d N)/C_T, without damper -v - mu_d N'/K_T
/// along F. Order 2, wherever in an interval the contact begins and ends to slide; directions of slip that turn without damper: order 1.
#pragma once
#include "contact/friction_law.hpp"

namespace fretwork::contact {

/// Motion in the tangent plane (V = Vec2, M = Sym2), or on the line across x_loc (V = M = double).
template <class V, class M> struct TangentialPath {
  V velocity;     ///< m/s, at the start
  V acceleration; ///< m/s2, without friction
  M mobility;     ///< 1/kg
};

/// What a law needs of a piece of a given length.
struct PieceTable {
  double length;         ///< tau, s
  double answer;         ///< beta tau^2, s2
  double stick_gradient; ///< K_T/2 + C_T/tau, N/m
  double slip_gradient;  ///< s K_T + C_T/tau, N/m
  double share;          ///< s
  double relaxed;        ///< 1 - e^-r
};
/// @param mobility  1/kg, the largest along a tangent
[[nodiscard]] PieceTable piece_table(const FrictionLaw& law, double mobility, double length);

template <class V> struct FrictionInterval {
  V impulse{};               ///< N s
  V displacement{};          ///< m
  V spring{};                ///< N, T at the end
  V velocity{};              ///< m/s, at the end
  bool sliding = false;      ///< at the end
  double slider_work = 0.0;  ///< J
  double wear_work = 0.0;    ///< J, integral of N |v| while it slides
  double slid = 0.0;         ///< m, the path of that
  double sliding_time = 0.0; ///< s
};

/// @param usual  of the whole interval, if it is of the usual length
/// @param length  s   @param normal0, normal1  N, at its ends   @param mobility  1/kg, as that of `usual`
[[nodiscard]] FrictionInterval<double> friction_over_interval(const FrictionLaw& law, const PieceTable& usual,
                                                              double mobility, double spring, bool sliding,
                                                              double length, double normal0, double normal1,
                                                              const TangentialPath<double, double>& path);
[[nodiscard]] FrictionInterval<Vec2> friction_over_interval(const FrictionLaw& law, const PieceTable& usual,
                                                            double mobility, Vec2 spring, bool sliding,
                                                            double length, double normal0, double normal1,
                                                            const TangentialPath<Vec2, Sym2>& path);

/// Share of the spring's force that is left of an open contact after t seconds.
[[nodiscard]] double spring_left(const FrictionLaw& law, double t);

} // namespace fretwork::contact
