// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/numbering.hpp"
#include "app/flow_damping.hpp"
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace fretwork::app {
namespace {

constexpr std::size_t most_groups = 6; ///< named one by one

/// `"bars[0]" at s = 8.9 m to "bars[3]" at s = 11 m`
std::string ends_text(const PlacedContact& first, const PlacedContact& last, const fem::Model& model,
                      const std::vector<flow::Tube>& tubes) {
  for (const flow::Tube& tube : tubes) {
    const auto from = abscissa_of(tube, first.node), to = abscissa_of(tube, last.node);
    if (from && to)
      return fmt::format("\"{}\" at s = {:.4g} m to \"{}\" at s = {:.4g} m", first.support, *from,
                         last.support, *to);
  }
  const auto place = [&](const PlacedContact& contact) {
    return fem::place(model.nodes[static_cast<std::size_t>(contact.node)]);
  };
  return fmt::format("\"{}\" at {} to \"{}\" at {}", first.support, place(first), last.support, place(last));
}

} // namespace

std::string numbering_text(const study::Study& study, const fem::Model& model,
                           const std::vector<PlacedContact>& placed, const std::vector<PlacedFlow>& flows) {
  std::vector<flow::Tube> tubes;
  for (const PlacedFlow& flow : flows)
    tubes.push_back(tube_of(study, flow, model));
  std::vector<std::string> groups;
  for (std::size_t i = 0, end = 0; i < placed.size(); i = end) {
    while (end < placed.size() && placed[end].entry == placed[i].entry)
      ++end;
    if (placed[i].support != placed[end - 1].support)
      groups.push_back(ends_text(placed[i], placed[end - 1], model, tubes));
  }
  if (groups.empty())
    return {};
  const std::size_t more = groups.size() > most_groups ? groups.size() - most_groups : 0;
  groups.resize(groups.size() - more);
  return fmt::format("supports of groups are numbered along them: {}{}", fmt::join(groups, ", "),
                     more > 0 ? fmt::format(" and {} more groups", more) : "");
}

} // namespace fretwork::app
