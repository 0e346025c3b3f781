// SPDX-License-Identifier: GPL-3.0-or-later
#include "transient/conserving_friction.hpp"

namespace fretwork::transient {

using contact::Sym2;
using contact::Vec2;

Rubbing along_trial(contact::FrictionLaw law, Vec2 spring, double coefficient, double normal, Vec2 dx,
                    double h) {
  law.kind = contact::FrictionMemoryKind::return_map;
  law.mu_static = law.mu_dynamic = coefficient;
  const auto s = contact::friction_slopes(law, {spring, false}, normal, 0.5 * dx, (1.0 / h) * dx);
  const auto by = [&](double displacement, double velocity) { return 0.5 * displacement + velocity / h; };
  return {s.friction.force,
          {by(s.by_displacement.xx, s.by_velocity.xx), by(s.by_displacement.xt, s.by_velocity.xt),
           by(s.by_displacement.tt, s.by_velocity.tt)},
          s.by_normal_force,
          {},
          s.friction.slides};
}

Rubbing opposing(const contact::FrictionLaw& law, double rho, double normal, Vec2 dx, Vec2 force) {
  const double bound = law.mu_dynamic * normal;
  const Vec2 z{law.along.x * (force.x - rho * dx.x), law.along.t * (force.t - rho * dx.t)};
  const double size = contact::norm(z);
  if (size <= bound)
    return {z, {-rho * law.along.x, 0.0, -rho * law.along.t}, {}, {law.along.x, 0.0, law.along.t}, true};
  const Vec2 e = (1.0 / size) * z;
  const double s = bound / size, mask = law.along.x * law.along.t;
  const Sym2 across{s * law.along.x * e.t * e.t, -s * mask * e.x * e.t, s * law.along.t * e.x * e.x};
  return {
      bound * e, {-rho * across.xx, -rho * across.xt, -rho * across.tt}, law.mu_dynamic * e, across, true};
}

} // namespace fretwork::transient
