// SPDX-License-Identifier: GPL-3.0-or-later
#include "transient/scheme_scope.hpp"
#include "core/error.hpp"

namespace fretwork::transient {

namespace {

/// Below this share of the largest, how modes move a contact is the eigensolver's round-off.
constexpr double round_off_of_shapes = 1e-11;

/// Slip of `reference` along x_loc that the friction cannot change: opposite to it, which implicit equations solved by forces do not find.
bool slips_unmoved(const ContactPoint& point) {
  const contact::FrictionLaw& law = point.support.friction;
  return law.active() && law.kind == contact::FrictionMemoryKind::reference && law.along.x != 0.0 &&
         point.imposed.size() > 0 && !point.imposed.row(0).isZero(0.0) &&
         point.b.row(0).cwiseAbs().maxCoeff() <= round_off_of_shapes * point.b.cwiseAbs().maxCoeff();
}

} // namespace

std::string out_of_scope(const Scene& scene, SchemeKind kind) {
  if (!scene.system.motion.empty() && kind != SchemeKind::splitting && kind != SchemeKind::runge_kutta_54)
    return "does not take forces that depend on the motion (flow.law)";
  if (kind != SchemeKind::collocation && kind != SchemeKind::energy_conserving)
    return {};
  for (const ContactPoint& point : scene.contacts)
    if (slips_unmoved(point))
      return "does not take friction_memory = \"reference\" of contact \"" + point.name +
             "\", which an obstacle carries along x_loc where no mode moves its node (it does take "
             "\"return_map\")";
  return {};
}

void check_scope(const Scene& scene, SchemeKind kind) {
  if (const std::string why = out_of_scope(scene, kind); !why.empty())
    throw core::Error("scheme = \"" + name_of(kind) + "\" " + why + "; use scheme = \"splitting\"");
}

} // namespace fretwork::transient
