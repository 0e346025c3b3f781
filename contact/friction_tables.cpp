// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/friction_tables.hpp"
#include "contact/normal_interval.hpp"
#include <cmath>

namespace fretwork::contact {
namespace {

/// K_T tau/C_T below which e^-r is a series.
constexpr double slow_damper = 1e-2;
/// So much of the mobility that a table is of that its c' holds.
constexpr double same_mobility = 0.01;

/// Function of a tensor by its values at the eigenvalues.
Sym2 with_values(const Sym2& a, double middle, double radius, double low, double high) {
  const double mean = 0.5 * (low + high), slope = radius > 0.0 ? 0.5 * (high - low) / radius : 0.0;
  return {mean + slope * (a.xx - middle), slope * a.xt, mean + slope * (a.tt - middle)};
}

} // namespace

StickTable stick_table(const FrictionLaw& law, double mobility, double length) {
  StickTable t;
  t.length = length;
  t.half = 0.5 * length * length;
  t.growing = growing_damping(law.damping, law.damping * mobility * length);
  t.rate = law.damping / length;
  return t;
}
SlipTable slip_table(const FrictionLaw& law, double length) {
  SlipTable t;
  const double c = law.damping / length, r = law.damping > 0.0 ? law.stiffness / c : no_damper;
  t.length = length;
  t.half = 0.5 * length * length;
  t.r = r;
  t.relaxed = r < no_damper ? -std::expm1(-r) : 1.0;
  t.share = r < slow_damper ? 0.5 + r / 12.0 : 1.0 / t.relaxed - (r < no_damper ? 1.0 / r : 0.0);
  t.spread = r < slow_damper
                 ? 1.0 / 12.0
                 : (r < no_damper ? 1.0 / (r * r) : 0.0) - (1.0 - t.relaxed) / (t.relaxed * t.relaxed);
  t.gradient = t.share * law.stiffness + c;
  t.rate = c;
  return t;
}
double mean_decay(const SlipTable& t) {
  return t.r < no_damper ? -std::expm1(-t.r * t.share) / (t.r * t.share) : 0.0;
}

PieceTables piece_tables(const FrictionLaw& law, double mobility, double length) {
  return {stick_table(law, mobility, length), slip_table(law, length)};
}

StickTerms<double> stick_terms(const FrictionLaw& law, const StickTable& t, double table_mobility,
                               double mobility) {
  const double z = law.damping * mobility * t.length;
  const double growing = std::abs(mobility - table_mobility) <= same_mobility * table_mobility
                             ? t.growing
                             : growing_damping(law.damping, z);
  const LinearTerms of = linear_terms(law.stiffness, mobility, t.half / 6.0, z, growing);
  return {of.stiffness, of.damping, of.end};
}
StickTerms<Sym2> stick_terms(const FrictionLaw& law, const StickTable& t, double table_mobility,
                             const Sym2& a) {
  const double middle = 0.5 * (a.xx + a.tt), radius = std::hypot(0.5 * (a.xx - a.tt), a.xt);
  const StickTerms<double> low = stick_terms(law, t, table_mobility, middle - radius),
                           high = stick_terms(law, t, table_mobility, middle + radius);
  return {with_values(a, middle, radius, low.stiffness, high.stiffness),
          with_values(a, middle, radius, low.damping, high.damping),
          with_values(a, middle, radius, low.end, high.end)};
}

} // namespace fretwork::contact
