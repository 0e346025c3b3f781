// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/worn_geometry.hpp"
#include "core/error.hpp"
#include "fem/beam_constants.hpp"
#include "wear/obstacle_geometry.hpp"
#include <algorithm>
#include <fmt/format.h>
#include <numbers>

namespace fretwork::app {
namespace {

/// The tube at a node: the largest radius and the thinnest wall of the beams that meet there.
struct TubeAt {
  std::optional<double> radius, wall;
};

TubeAt tube_at(const fem::Model& model, core::Index node) {
  TubeAt out;
  const auto largest = [](std::optional<double>& at, double value) {
    at = std::max(at.value_or(value), value);
  };
  for (const fem::Beam& beam : model.beams) {
    if (beam.a != node && beam.b != node)
      continue;
    const auto here = fem::property_at(model.properties[static_cast<std::size_t>(beam.property)],
                                       beam.along[beam.a == node ? 0 : 1]);
    if (const auto* pipe = std::get_if<fem::Pipe>(&here.section.shape)) {
      largest(out.radius, 0.5 * pipe->outer_diameter);
      out.wall = std::min(out.wall.value_or(pipe->thickness), pipe->thickness);
    } else if (const auto* circle = std::get_if<fem::Circle>(&here.section.shape)) {
      largest(out.radius, 0.5 * circle->diameter);
    }
  }
  return out;
}

/// Sizes of a support, from the study, the contact and the beam.
class Sizes {
public:
  Sizes(const study::Wear& wear, const study::Contact& contact, const PlacedContact& placed, TubeAt tube)
      : wear_(wear), contact_(contact), placed_(placed), tube_(tube) {}

  [[nodiscard]] double radius() const {
    return first({wear_.tube_radius, contact_.tube_radius, tube_.radius}, "no round beam at its node gives",
                 "tube_radius");
  }
  [[nodiscard]] double wall() const {
    return first({wear_.wall, tube_.wall}, "no pipe at its node gives", "wall");
  }
  [[nodiscard]] double length() const {
    const auto thickness = contact_.thickness > 0.0 ? std::optional(contact_.thickness) : std::nullopt;
    return first({wear_.length, thickness}, "the contact has no thickness that gives", "length");
  }
  [[nodiscard]] double clearance() const {
    const auto* circle = std::get_if<contact::Circle>(&placed_.obstacle);
    const auto gap = circle && circle->gap > 0.0 ? std::optional(circle->gap) : std::nullopt;
    return first({wear_.clearance, gap}, "the obstacle is no circle whose gap gives", "clearance");
  }

private:
  [[nodiscard]] static double first(std::initializer_list<std::optional<double>> candidates,
                                    const std::string& why, const std::string& key) {
    for (const auto& candidate : candidates)
      if (candidate)
        return *candidate;
    throw core::Error(fmt::format("{} the {}; give {} (m)", why, key, key));
  }
  const study::Wear& wear_;
  const study::Contact& contact_;
  const PlacedContact& placed_;
  TubeAt tube_;
};

wear::Geometry geometry_of_obstacle(const study::Wear& entry, const study::Contact& contact,
                                    const PlacedContact& placed, const Sizes& sizes) {
  const bool crossing = std::holds_alternative<contact::RoundPair>(placed.obstacle);
  const wear::TubeInSupport tube{sizes.radius(), crossing ? 1.0 : sizes.length(), entry.inclination};
  if (contact.obstacle == study::ObstacleKind::egg_crate) // four flat faces
    return wear::FlatBar{tube.radius, tube.length, tube.inclination};
  return wear::geometry_of(placed.obstacle, tube);
}

wear::Pairing pairing_of(const study::Wear& entry, const study::Contact& contact, const PlacedContact& placed,
                         const Sizes& sizes) {
  using study::WearGeometry;
  const auto shared = [&](const wear::Geometry& geometry) { return wear::SharedScar{geometry, entry.form}; };
  switch (entry.geometry) {
  case WearGeometry::obstacle:
    return shared(geometry_of_obstacle(entry, contact, placed, sizes));
  case WearGeometry::flat_bar:
    return shared(wear::FlatBar{sizes.radius(), sizes.length(), entry.inclination});
  case WearGeometry::drilled_hole:
    return shared(wear::DrilledHole{sizes.radius(), sizes.clearance(), sizes.length(), entry.inclination});
  case WearGeometry::lands:
    return shared(wear::Lands{sizes.radius(), sizes.clearance(), sizes.length(), *entry.half_angle,
                              entry.lands, entry.inclination});
  case WearGeometry::ring:
    return shared(wear::Ring{sizes.radius(), sizes.length()});
  case WearGeometry::tube_on_tube:
    return shared(wear::TubeOnTube{sizes.radius(), entry.inclination});
  case WearGeometry::sectors:
    break;
  }
  const double angle = 2.0 * std::numbers::pi / entry.sectors, radius = sizes.radius();
  return wear::SectorPair{{radius, sizes.length(), angle},
                          {radius + sizes.clearance(), sizes.length(), angle}};
}

} // namespace

WornGeometry worn_geometry(const study::Wear& entry, const study::Contact& contact,
                           const PlacedContact& placed, const fem::Model& model) {
  const Sizes sizes(entry, contact, placed, tube_at(model, placed.node));
  WornGeometry out{pairing_of(entry, contact, placed, sizes), sizes.wall()};
  wear::check(out.pairing);
  return out;
}

void set_geometry(const wear::Pairing& pairing, results::WearOfSupport& facts) {
  if (const auto* sectors = std::get_if<wear::SectorPair>(&pairing)) {
    facts.geometry = "sectors";
    facts.form = "exact";
    facts.radius = sectors->tube.radius;
    facts.length = sectors->tube.length;
    facts.clearance = sectors->support.hole_radius - sectors->tube.radius;
    return;
  }
  const auto& shared = std::get<wear::SharedScar>(pairing);
  facts.geometry = wear::name_of(shared.geometry);
  facts.form = shared.form == wear::Form::exact ? "exact" : "reference";
  std::visit(
      [&](const auto& shape) {
        if constexpr (requires { shape.radius; })
          facts.radius = shape.radius;
        if constexpr (requires { shape.length; })
          facts.length = shape.length;
        if constexpr (requires { shape.clearance; })
          facts.clearance = shape.clearance;
        if constexpr (requires { shape.inclination; })
          facts.inclination = shape.inclination;
        if constexpr (requires { shape.crossing; })
          facts.inclination = shape.crossing;
      },
      shared.geometry);
}

} // namespace fretwork::app
