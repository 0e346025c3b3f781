// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/contact_axes.hpp"
#include "core/error.hpp"
#include "fem/beam_point.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace fretwork::app {
namespace {

using core::Index;
using core::Vec3;

/// A component of the default axis below this share of it counts as 0 when the axis is oriented.
constexpr double negligible = 1e-8;
/// Tangents of two beams that meet at a node give a mean this long at least; shorter: they turn back.
constexpr double shortest_mean = 0.1;

/// Beams are walked along their chain, so that the tangents before and after a node point the same way.
Vec3 mean_tangent(const fem::Model& model, Index node, const std::string& name) {
  Vec3 sum = Vec3::Zero();
  int beams = 0;
  for (const auto& beam : model.beams)
    if (beam.a == node || beam.b == node) {
      sum += fem::tangent_at(model, beam, node);
      ++beams;
    }
  if (beams == 0)
    throw core::Error(fmt::format("contact \"{}\": {}, or, for a mass by itself, give axis = [x, y, z]", name,
                                  without_beam(model, node)));
  if (beams > 2 || sum.norm() < shortest_mean)
    throw core::Error(
        fmt::format("contact \"{}\": {} beams meet at its node in no common direction; give axis = [x, y, z]",
                    name, beams));
  return sum.normalized();
}

/// First component that is not negligible in the order z, x, y is made positive.
Vec3 oriented(const Vec3& axis) {
  for (const int d : {2, 0, 1})
    if (std::abs(axis(d)) > negligible)
      return axis(d) < 0.0 ? Vec3(-axis) : axis;
  return axis;
}

} // namespace

std::string without_beam(const fem::Model& model, Index node) {
  return fmt::format(
      "no beam meets its node at {}; name the curves there in a physical curve of the mesh (gmsh "
      "leaves out those that are in none)",
      fem::place(model.nodes[static_cast<std::size_t>(node)]));
}

bool has_beam(const fem::Model& model, Index node) {
  return std::any_of(model.beams.begin(), model.beams.end(),
                     [node](const fem::Beam& beam) { return beam.a == node || beam.b == node; });
}

contact::Frame frame_of(const study::Contact& contact, const fem::Model& model, Index node,
                        const std::string& name) {
  const Vec3 axis = contact.axis ? *contact.axis : oriented(mean_tangent(model, node, name));
  if (contact.y_axis) {
    try {
      return contact::frame_from_y(axis, *contact.y_axis);
    } catch (const core::Error& e) {
      throw core::Error(fmt::format("contact \"{}\": {}", name, e.what()));
    }
  }
  return contact::nautical_frame(axis, contact.angle * std::numbers::pi / 180.0);
}

std::string axis_warning(const study::Contact& contact, const fem::Model& model, Index node,
                         const std::string& name) {
  constexpr double widest = 30.0; // degrees
  using enum study::ObstacleKind;
  const study::ObstacleKind kind = contact.obstacle;
  if (!contact.axis || kind == plane_y || kind == plane_z || kind == stop_y || kind == stop_z)
    return {};
  double least = 90.0;
  for (const fem::Beam& beam : model.beams)
    if (beam.a == node || beam.b == node)
      least =
          std::min(least, std::acos(std::min(1.0, std::abs(contact.axis->normalized().dot(
                                                      fem::tangent_at(model, beam, node).normalized())))) *
                              180.0 / std::numbers::pi);
  return has_beam(model, node) && least > widest
             ? fmt::format(
                   "contact \"{}\": its axis is {:.0f} degrees off the beam at its node, and holds it "
                   "in the plane across the axis only; give the direction of the tube, or leave axis out",
                   name, least)
             : std::string();
}

} // namespace fretwork::app
