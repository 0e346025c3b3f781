// SPDX-License-Identifier: GPL-3.0-or-later
#include "results/contact_position.hpp"
#include <cmath>

namespace fretwork::results {
namespace {

post::Moments moved(const post::Moments& displacement, double rest) {
  return {displacement.mean + rest, displacement.std, displacement.min + rest, displacement.max + rest};
}

} // namespace

ContactPosition position_of(const ContactFacts& facts, const post::ContactSummary& summary) {
  return {moved(summary.y, facts.rest.y()), moved(summary.z, facts.rest.z())};
}

std::optional<FlatPosition> flat_position_of(const ContactFacts& facts, const post::ContactSummary& summary) {
  const ContactPosition position = position_of(facts, summary);
  if (facts.obstacle.ends_with("_y"))
    return FlatPosition{position.y, position.z};
  if (facts.obstacle.ends_with("_z"))
    return FlatPosition{position.z, position.y};
  return {};
}

std::optional<Clearances> unequal_clearances_of(const ContactFacts& facts) {
  constexpr double equal = 1e-3; // of the gap
  const bool along_y = facts.obstacle.ends_with("_y");
  if (facts.sides.size() != 2 || !(along_y || facts.obstacle.ends_with("_z")))
    return {};
  const double rest = along_y ? facts.rest.y() : facts.rest.z();
  if (std::abs(rest) <= equal * facts.gap)
    return {};
  return Clearances{facts.gap + rest, facts.gap - rest};
}

} // namespace fretwork::results
