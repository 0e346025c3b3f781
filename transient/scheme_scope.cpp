// SPDX-License-Identifier: GPL-3.0-or-later
#include "transient/scheme_scope.hpp"
#include "core/error.hpp"

namespace fretwork::transient {

bool takes_residual(SchemeKind kind) { return kind == SchemeKind::splitting; }

std::string out_of_scope(const Scene& scene, SchemeKind kind) {
  if (scene.residual.size() > 0 && !takes_residual(kind))
    return "does not take the residual flexibility of the modes at the contacts (modes.static_modes = "
           "\"auto\")";
  return {};
}

void check_scope(const Scene& scene, SchemeKind kind) {
  if (const std::string why = out_of_scope(scene, kind); !why.empty())
    throw core::Error("scheme = \"" + name_of(kind) + "\" " + why + "; use scheme = \"splitting\"");
}

} // namespace fretwork::transient
