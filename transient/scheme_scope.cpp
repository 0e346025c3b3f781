// SPDX-License-Identifier: GPL-3.0-or-later
#include "transient/scheme_scope.hpp"
#include "core/error.hpp"

namespace fretwork::transient {

bool carries_obstacles(SchemeKind kind) { return kind == SchemeKind::splitting || kind == SchemeKind::euler; }

void check_scope(const Scene& scene, SchemeKind kind) {
  if (!scene.motions.empty() && !carries_obstacles(kind))
    throw core::Error("scheme = \"" + name_of(kind) +
                      "\" does not follow obstacles that stay in space while the base moves "
                      "(attached_to = \"ground\"); use scheme = \"splitting\"");
  if (scene.system.damping_matrix.size() > 0 && kind == SchemeKind::collocation)
    throw core::Error("scheme = \"collocation\" takes diagonal modal damping only, and the dampers of this "
                      "study couple the modes; use scheme = \"splitting\"");
}

} // namespace fretwork::transient
