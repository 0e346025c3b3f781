// SPDX-License-Identifier: GPL-3.0-or-later
#include "transient/splitting/macro_steps.hpp"
#include <algorithm>

namespace fretwork::transient {

bool allows_macro_steps(const Scene& scene) {
  return scene.system.damping_matrix.size() == 0 && !scene.contacts.empty() &&
         std::all_of(scene.contacts.begin(), scene.contacts.end(), [](const ContactPoint& c) {
           return !(c.support.normal.damping > 0.0) && c.imposed.size() == 0 &&
                  contact::properties_of(c.support.obstacle).gap_bound.radial >= 0.0;
         });
}

} // namespace fretwork::transient
