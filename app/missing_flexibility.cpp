// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/missing_flexibility.hpp"
#include "app/modal_truncation.hpp"
#include <algorithm>
#include <fmt/format.h>

namespace fretwork::app {
namespace {

/// Missing flexibility times stiffness that makes impacts wrong by half of it: a percent.
constexpr double reported = 0.02;

} // namespace

double missing_times_stiffness(const ContactFlexibility& flexibility, std::size_t k,
                               const contact::Support& support) {
  const auto [y, z] = contact::normal_directions(support.obstacle);
  const bool normal[] = {false, y, z};
  const auto tangential = contact::friction_directions(support.obstacle, support.friction.along);
  double largest = 0.0;
  for (int d = 0; d < 3; ++d) {
    const auto axis = static_cast<std::size_t>(d);
    const double stiffness =
        std::max(normal[d] ? support.normal.stiffness : 0.0,
                 support.friction.active() && tangential[axis] ? support.friction.stiffness : 0.0);
    largest = std::max(largest, stiffness * ContactFlexibility::own(flexibility.missing, k)(d, d));
  }
  return largest;
}

void find_missing(const ContactFlexibility& flexibility, BuiltScene& built) {
  for (std::size_t k = 0; k < built.scene.contacts.size(); ++k) {
    const transient::ContactPoint& point = built.scene.contacts[k];
    const double product = missing_times_stiffness(flexibility, k, point.support);
    if (product > much_missing)
      built.truncated.push_back(point.name);
    if (product > built.lacking || built.lacking_at.empty()) {
      built.lacking = product;
      built.lacking_at = point.name;
    }
  }
}

std::string flexibility_note(const std::vector<BuiltScene>& scenes) {
  const auto worst =
      std::max_element(scenes.begin(), scenes.end(),
                       [](const BuiltScene& a, const BuiltScene& b) { return a.lacking < b.lacking; });
  if (worst == scenes.end() || !(worst->lacking > reported) ||
      worst->lacking > much_missing) // a warning then
    return {};
  return fmt::format("the static flexibility that the modes lack at a contact times its stiffness is up to "
                     "{:.2g} (\"{}\"): contact forces are overestimated by up to half of that; set "
                     "modes.static_modes = \"all\", or ask for more modes",
                     worst->lacking, worst->lacking_at);
}

} // namespace fretwork::app
