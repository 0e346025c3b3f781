// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/support_motion.hpp"
#include "core/error.hpp"
#include "fem/fields.hpp"
#include "fem/petsc_static.hpp"
#include "fem/ties.hpp"
#include <cmath>
#include <fmt/format.h>

namespace fretwork::app {
namespace {

constexpr double round_off = 1e-12;

using core::Index;

/// N/m, of all grounded springs at a node along a global axis.
double grounded_stiffness(const fem::Model& model, Index node, int axis) {
  double sum = 0.0;
  for (const fem::Spring& spring : model.springs)
    if (spring.node == node && spring.other < 0)
      sum += spring.stiffness[static_cast<std::size_t>(axis)];
  return sum;
}

/// Part of a field over the model that belongs to a structure is not zero.
bool acts_on(const fem::Structure& structure, const Eigen::VectorXd& field) {
  for (const Index node : structure.nodes)
    if (!field.segment<6>(static_cast<Eigen::Index>(node) * 6).isZero(0.0))
      return true;
  return false;
}

/// From rest at 0 where nothing is given, but for a random acceleration, which would carry it away.
transient::PrescribedMotion accelerated(const transient::TimeFunction& acceleration,
                                        std::optional<double> velocity0, std::optional<double> displacement0,
                                        double duration) {
  const auto* random = std::get_if<transient::Random>(&acceleration);
  if (random && !velocity0 && !displacement0)
    return transient::without_drift(*random, duration);
  return {acceleration, velocity0.value_or(0.0), displacement0.value_or(0.0)};
}

Eigen::VectorXd static_shape(const fem::Model& model, const fem::Structure& structure,
                             const Eigen::VectorXd& force, const std::string& name) {
  try {
    return fem::static_solution(model, structure, force);
  } catch (const core::ComputationError& error) {
    throw core::ComputationError(name + ": " + error.what());
  }
}

} // namespace

transient::PrescribedMotion prescribed(const study::SupportMotion& motion, double duration) {
  return motion.by_displacement
             ? transient::motion_of_displacement(motion.function)
             : accelerated(motion.function, motion.velocity0, motion.displacement0, duration);
}

transient::PrescribedMotion prescribed(const study::BaseMotion& motion, double duration) {
  return accelerated(motion.acceleration, motion.velocity0, motion.displacement0, duration);
}

std::vector<MovedSupport> moved_supports(const study::Study& study, const mesh::LineMesh& mesh,
                                         const fem::Model& model) {
  std::vector<MovedSupport> out;
  for (std::size_t e = 0; e < study.support_motions.size(); ++e) {
    const study::SupportMotion& motion = study.support_motions[e];
    const std::string what = fmt::format("[[support_motion]] entry {}", e + 1);
    MovedSupport moved;
    moved.name = fmt::format("{} of \"{}\"", what, motion.group);
    moved.imposed.setZero(static_cast<Eigen::Index>(model.nodes.size()) * core::dofs_per_node);
    moved.force = moved.imposed;
    std::vector<bool> given(static_cast<std::size_t>(moved.imposed.size()), false);
    for (const Index node : mesh::group_nodes(mesh, motion.group, what))
      for (int axis = 0; axis < 3; ++axis) {
        const double along = motion.direction(axis);
        if (std::abs(along) < round_off) // of a unit vector: cos 90 degrees
          continue;
        const Eigen::Index row = static_cast<Eigen::Index>(node) * core::dofs_per_node + axis;
        const double stiffness = grounded_stiffness(model, node, axis);
        if (model.is_fixed(node, axis))
          moved.imposed(row) = along, given[static_cast<std::size_t>(row)] = true;
        else if (stiffness > 0.0)
          moved.force(row) = stiffness * along;
        else
          throw core::Error(fmt::format(
              "{}: a node of \"{}\" at {} is neither restrained nor held by a grounded spring along {}, so "
              "that "
              "nothing moves it; add \"u{}\" to its [[restraints]], a spring, or change the direction",
              what, motion.group, fem::place(model.nodes[static_cast<std::size_t>(node)]), "xyz"[axis],
              "xyz"[axis]));
      }
    fem::follow_ties(model, given, moved.imposed); // one direction: tied dofs are given alike
    out.push_back(std::move(moved));
  }
  return out;
}

std::vector<Eigen::VectorXd> support_shapes(const std::vector<MovedSupport>& supports,
                                            const fem::Model& model,
                                            const std::vector<fem::Structure>& structures) {
  std::vector<Eigen::VectorXd> out;
  for (const MovedSupport& support : supports) {
    const Eigen::VectorXd force = support.force - fem::stiffness_times(model, support.imposed);
    Eigen::VectorXd shape = support.imposed;
    for (const fem::Structure& structure : structures)
      if (acts_on(structure, force))
        shape += static_shape(model, structure, force, support.name);
    out.push_back(std::move(shape));
  }
  return out;
}

} // namespace fretwork::app
