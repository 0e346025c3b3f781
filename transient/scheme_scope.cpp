// SPDX-License-Identifier: GPL-3.0-or-later
#include "transient/scheme_scope.hpp"
#include "core/error.hpp"
#include <algorithm>

namespace fretwork::transient {

bool carries_obstacles(SchemeKind kind) { return kind == SchemeKind::splitting || kind == SchemeKind::euler; }

bool takes_residual(SchemeKind kind) { return kind == SchemeKind::splitting; }

void check_scope(const Scene& scene, SchemeKind kind) {
  const bool carried = std::any_of(scene.contacts.begin(), scene.contacts.end(),
                                   [](const ContactPoint& point) { return point.carried.size() > 0; });
  if (carried && !carries_obstacles(kind))
    throw core::Error(
        "scheme = \"" + name_of(kind) +
        "\" does not follow obstacles that move from the supports of the structure (attached_to "
        "= \"ground\", [[support_motion]]); use scheme = \"splitting\"");
  if (scene.residual.size() > 0 && !takes_residual(kind))
    throw core::Error("scheme = \"" + name_of(kind) +
                      "\" does not take the residual flexibility of the modes at the contacts; use scheme = "
                      "\"splitting\", or leave the residual flexibility out");
  if (scene.system.damping_matrix.size() > 0 && kind == SchemeKind::collocation)
    throw core::Error("scheme = \"collocation\" takes diagonal modal damping only, and the dampers of this "
                      "study couple the modes; use scheme = \"splitting\"");
}

} // namespace fretwork::transient
