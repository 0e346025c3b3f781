// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/static_start.hpp"
#include "core/error.hpp"
#include "transient/statics/static_start.hpp"
#include <cmath>
#include <fmt/format.h>

namespace fretwork::app {
namespace {

/// A motion whose mean displacement is below this share of its largest is told as a turn.
constexpr double turning = 0.6;
/// Components of a direction below this share are round-off.
constexpr double negligible_component = 1e-6;

std::string text(core::Vec3 direction) {
  direction.normalize();
  for (double& component : direction)
    component = std::abs(component) < negligible_component ? 0.0 : component;
  return fmt::format("({:.3g}, {:.3g}, {:.3g})", direction.x(), direction.y(), direction.z());
}

/// Words for a modal motion: of the structure that moves most, the mean of its nodes.
std::string words_for(const Eigen::VectorXd& motion, const std::vector<const modal::Basis*>& bases) {
  core::Vec3 along = core::Vec3::Zero(), about = core::Vec3::Zero();
  double largest = 0.0;
  Eigen::Index first = 0;
  for (const modal::Basis* basis : bases) {
    const Eigen::VectorXd field = basis->shapes * motion.segment(first, basis->size());
    first += basis->size();
    core::Vec3 translation = core::Vec3::Zero(), rotation = core::Vec3::Zero();
    double most = 0.0;
    const auto nodes = static_cast<double>(basis->nodes.size());
    for (Eigen::Index row = 0; row < field.size(); row += core::dofs_per_node) {
      translation += field.segment<3>(row) / nodes;
      rotation += field.segment<3>(row + 3) / nodes;
      most = std::max(most, field.segment<3>(row).norm());
    }
    if (most > largest || largest == 0.0) {
      largest = most;
      along = translation;
      about = rotation;
    }
  }
  const bool turns = about.norm() > 0.0 && along.norm() < turning * largest;
  return turns || largest == 0.0 ? "turn about " + text(about) : "move along " + text(along);
}

/// Where a contact overlaps its obstacle before anything has moved, the deepest: `contact "card" overlaps ...; `.
/// @param numbers  of the scene's contacts among `contacts`
std::string deepest_overlap(const transient::Scene& scene, const std::vector<std::size_t>& numbers,
                            const std::vector<PlacedContact>& contacts) {
  double least = 0.0;
  std::size_t deepest = 0;
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    if (const double gap = scene.location_undeformed(scene.contacts[k]).gap; gap < least) {
      least = gap;
      deepest = k;
    }
  }
  return least < 0.0
             ? fmt::format(
                   "contact \"{}\" overlaps its obstacle most, by {:.4g} m: look at its origin, offset "
                   "and stiffness; or ",
                   contacts[numbers[deepest]].name, -least)
             : std::string();
}

} // namespace

void start_in_equilibrium(const std::vector<const modal::Basis*>& bases,
                          const std::vector<PlacedContact>& contacts, BuiltScene& built) {
  transient::Scene& scene = built.scene;
  transient::Scene at_start = scene;
  for (transient::ContactPoint& point : at_start.contacts)
    point.rest = scene.place_at_start(point);
  const transient::Equilibrium e = transient::static_equilibrium(at_start);
  switch (e.balance) {
  case transient::Balance::found:
    break;
  case transient::Balance::not_held:
    throw core::Error(
        fmt::format("transient.start = \"static\": nothing holds a structure against its loads at t = 0: it "
                    "would {}; add "
                    "a restraint, a spring or a contact that stops it (friction, unloaded at the start, does "
                    "not), or take "
                    "start = \"rest\"",
                    words_for(e.motion, bases)));
  case transient::Balance::not_converged:
    throw core::ComputationError(
        fmt::format("transient.start = \"static\": no equilibrium found in {} iterations, its residual is "
                    "{:.2g} of the forces; {}"
                    "take start = \"rest\" with damping until the structure has settled",
                    e.iterations, e.residual, deepest_overlap(scene, built.contacts, contacts)));
  }
  scene.q0 = e.q;
  const auto closed = (e.normal_force.array() > 0.0).count();
  built.notes.push_back(
      closed > 0
          ? fmt::format(
                "static start: {} of {} contacts closed, largest force {:.6g} N, equilibrium residual {:.1e}",
                closed, e.normal_force.size(), e.normal_force.maxCoeff(), e.residual)
          : fmt::format("static start: no contact closed, equilibrium residual {:.1e}", e.residual));
}

} // namespace fretwork::app
