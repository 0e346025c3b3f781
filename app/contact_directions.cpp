// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/contact_directions.hpp"
#include "core/names.hpp"
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace fretwork::app {
namespace {

using core::Vec3;

constexpr std::size_t most_named_contacts = 6, most_directions = 8; ///< of a line; further ones are counted
constexpr double straight_sine = 1e-3; ///< sine of the angle of two beams, above which they bend
constexpr double near_axis = 0.866, far_from_axis = 0.5; ///< cosines of 30 and 60 degrees
constexpr double equal_directions = 1e-3;
constexpr double shown_component = 1e-3; ///< of a unit vector; smaller ones are shown as 0

/// The direction in which an obstacle limits the motion; none where there are several.
std::optional<Vec3> direction_of(study::ObstacleKind kind, const contact::Frame& frame) {
  using enum study::ObstacleKind;
  switch (kind) {
  case plane_y:
  case stop_y:
  case bars_y:
    return frame.y;
  case plane_z:
  case stop_z:
  case bars_z:
    return frame.z;
  case circle:
  case circle_inside:
  case profile:
  case ellipse:
  case drilled:
  case broached:
  case egg_crate:
    return std::nullopt;
  }
  return std::nullopt;
}

bool is_one_sided(study::ObstacleKind kind) {
  return kind == study::ObstacleKind::stop_y || kind == study::ObstacleKind::stop_z;
}

/// Of a direction without a sense: the first component that is not 0 is positive.
Vec3 without_sense(const Vec3& direction) {
  for (const double component : direction)
    if (std::abs(component) > shown_component)
      return component < 0.0 ? Vec3(-direction) : direction;
  return direction;
}

/// A point of a beam beyond its node: the middle of an arc, else the other end.
Vec3 point_beyond(const fem::Model& model, const fem::Beam& beam, core::Index node) {
  return beam.middle ? *beam.middle : model.node(beam.a == node ? beam.b : beam.a);
}

/// How a direction lies to the beams at a node; empty where none or more than two meet.
std::string relation(const fem::Model& model, core::Index node, const Vec3& direction) {
  std::vector<Vec3> to;
  for (const fem::Beam& beam : model.beams)
    if (beam.a == node || beam.b == node)
      to.push_back((point_beyond(model, beam, node) - model.node(node)).normalized());
  if (to.empty() || to.size() > 2)
    return {};
  const Vec3 tangent = to.size() == 1 ? to[0] : Vec3(to[1] - to[0]).normalized();
  if (std::abs(direction.dot(tangent)) > far_from_axis)
    return ", along the tube";
  const Vec3 normal = to.size() == 1 ? Vec3(Vec3::Zero()) : to[0].cross(to[1]);
  if (normal.norm() < straight_sine)
    return ", across the tube";
  const double out = std::abs(direction.dot(normal.normalized()));
  return out > near_axis       ? ", out of the plane of the bend"
         : out < far_from_axis ? ", in the plane of the bend"
                               : ", oblique to the plane of the bend";
}

std::string vector_text(const Vec3& direction) {
  std::vector<std::string> parts;
  for (const double component : direction)
    parts.push_back(fmt::format("{:.3g}", std::abs(component) < shown_component ? 0.0 : component));
  return fmt::format("({})", fmt::join(parts, ", "));
}

/// What holds of all supports of an entry; `turns`: of different directions.
struct Direction {
  Vec3 along;
  std::string relation;
  bool turns = false, mixed = false;
};

std::string text_of(const Direction& found, bool one_sided) {
  return fmt::format("{}{}",
                     found.turns ? std::string("directions that turn with the tube")
                                 : (one_sided ? "towards " : "along ") + vector_text(found.along),
                     found.mixed ? "" : found.relation);
}

} // namespace

std::string directions_text(const study::Study& study, const fem::Model& model,
                            const std::vector<PlacedContact>& placed) {
  std::vector<std::optional<Direction>> of_entry(study.contacts.size());
  for (const PlacedContact& contact : placed) {
    const study::ObstacleKind kind = study.contacts[contact.entry].obstacle;
    const auto direction = direction_of(kind, contact.frame);
    if (!direction)
      continue;
    const Vec3 along = is_one_sided(kind) ? *direction : without_sense(*direction);
    std::string how = relation(model, contact.node, along);
    auto& found = of_entry[contact.entry];
    if (!found)
      found = Direction{along, std::move(how)};
    else {
      found->turns = found->turns || (found->along - along).norm() > equal_directions;
      found->mixed = found->mixed || found->relation != how;
    }
  }
  std::vector<std::pair<std::string, std::vector<std::string>>> lines; // text, names of entries
  for (std::size_t e = 0; e < of_entry.size(); ++e)
    if (of_entry[e]) {
      const std::string text = text_of(*of_entry[e], is_one_sided(study.contacts[e].obstacle));
      const auto same =
          std::find_if(lines.begin(), lines.end(), [&](const auto& line) { return line.first == text; });
      if (same == lines.end())
        lines.push_back({text, {study.contacts[e].name}});
      else
        same->second.push_back(study.contacts[e].name);
    }
  if (lines.empty())
    return {};
  std::vector<std::string> parts;
  for (std::size_t k = 0; k < std::min(most_directions, lines.size()); ++k)
    parts.push_back(
        fmt::format("{} ({})", lines[k].first, core::list_names(lines[k].second, most_named_contacts)));
  if (lines.size() > most_directions)
    parts.push_back(fmt::format("{} more directions", lines.size() - most_directions));
  return fmt::format("flat obstacles limit the motion {}", fmt::join(parts, "; "));
}

} // namespace fretwork::app
