// SPDX-License-Identifier: GPL-3.0-or-later
#include "wear/obstacle_geometry.hpp"
#include "core/error.hpp"
#include <fmt/format.h>

namespace fretwork::wear {

namespace {

struct OfObstacle {
  const TubeInSupport& tube;
  Geometry operator()(const contact::Circle& circle) const {
    if (circle.gap == 0.0)
      return Ring{tube.radius, tube.length};
    return DrilledHole{tube.radius, circle.gap, tube.length, tube.inclination};
  }
  Geometry operator()(const contact::PlanePair&) const { return bar(); }
  Geometry operator()(const contact::Stop&) const { return bar(); }
  Geometry operator()(const contact::RoundPair&) const { return TubeOnTube{tube.radius, tube.inclination}; }
  Geometry operator()(const contact::FacingPlanes&) const {
    throw core::Error(
        "facing planes have no geometry of wear: neither body is a tube; give the geometry (flat_bar, "
        "drilled_hole, lands, ring, tube_on_tube) or leave the contact out of the wear");
  }
  Geometry operator()(const contact::Ellipse&) const {
    throw core::Error("an elliptic hole has no geometry of wear of its own; give the geometry: drilled_hole "
                      "with the clearance where "
                      "the tube wears, flat_bar, or sectors");
  }
  Geometry operator()(const contact::BroachedSpace& space) const {
    const contact::BroachedHole& hole = space.hole();
    if (!(hole.land_radius >= tube.radius))
      throw core::Error(
          fmt::format("lands of radius {:g} m do not hold a tube of radius {:g} m; give a larger "
                      "land_radius",
                      hole.land_radius, tube.radius));
    return Lands{tube.radius, hole.land_radius - tube.radius,
                 tube.length, 0.5 * hole.land_angle,
                 hole.lands,  tube.inclination};
  }
  Geometry operator()(const contact::Profile& profile) const {
    throw core::Error(
        fmt::format("a profile of {} points has no geometry of wear of its own; give the geometry: "
                    "lands with their half-angle and the clearance there, flat_bar "
                    "(egg crate), drilled_hole, or sectors",
                    profile.vertices().size()));
  }
  [[nodiscard]] Geometry bar() const { return FlatBar{tube.radius, tube.length, tube.inclination}; }
};

} // namespace

Geometry geometry_of(const contact::Obstacle& obstacle, const TubeInSupport& tube) {
  Geometry out = std::visit(OfObstacle{tube}, obstacle);
  check(out);
  return out;
}

} // namespace fretwork::wear
