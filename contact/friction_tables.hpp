// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// What a piece of stick or slip (friction_interval.hpp) needs of its length tau alone. r = K_T tau/C_T; s = 1/(1 - e^-r) - 1/r: the share of the piece at
/// which its force has the spring's end, T + (1 - e^-r)(F_s - T).
#pragma once
#include "contact/friction_law.hpp"

namespace fretwork::contact {

/// K_T tau/C_T above which a damper is none.
inline constexpr double no_damper = 1e8;

struct StickTable {
  double length;  ///< tau, s
  double half;    ///< tau^2/2, s2
  double growing; ///< growing_damping, N s/m
  double rate;    ///< C_T/tau, N/m
};
struct SlipTable {
  double length;   ///< tau, s
  double half;     ///< tau^2/2, s2
  double r;        ///< K_T tau/C_T; from no_damper on there is none
  double share;    ///< s
  double spread;   ///< variance of the share of the piece that F_s stands for
  double relaxed;  ///< 1 - e^-r
  double gradient; ///< s K_T + C_T/tau, N/m
  double rate;     ///< C_T/tau, N/m
};
/// @param mobility  1/kg, about the largest along a tangent
[[nodiscard]] StickTable stick_table(const FrictionLaw& law, double mobility, double length);
[[nodiscard]] SlipTable slip_table(const FrictionLaw& law, double length);
/// Mean of e^(-r t/tau) until the share s. Only slip in the tangent plane needs it.
[[nodiscard]] double mean_decay(const SlipTable& t);

struct PieceTables {
  StickTable stick;
  SlipTable slip;
};
[[nodiscard]] PieceTables piece_tables(const FrictionLaw& law, double mobility, double length);

/// LinearTerms (normal_interval.hpp) along a tangent, or along the directions of a plane.
template <class M> struct StickTerms {
  M stiffness; ///< N/m, K_T'
  M damping;   ///< N s/m, c'
  M end;       ///< A
};
/// @param table_mobility  1/kg, that of the table   @param mobility  1/kg, W
[[nodiscard]] StickTerms<double> stick_terms(const FrictionLaw& law, const StickTable& t,
                                             double table_mobility, double mobility);
[[nodiscard]] StickTerms<Sym2> stick_terms(const FrictionLaw& law, const StickTable& t, double table_mobility,
                                           const Sym2& mobility);

} // namespace fretwork::contact
