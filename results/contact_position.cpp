// SPDX-License-Identifier: GPL-3.0-or-later
#include "results/contact_position.hpp"

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

} // namespace fretwork::results
