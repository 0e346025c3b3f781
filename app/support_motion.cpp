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

constexpr double perpendicular = 1e-12;

using core::Index;

struct Grounding {
  double stiffness = 0.0; ///< N/m
  double damping = 0.0;   ///< N s/m
};

/// Of all grounded springs at a node along a global axis.
Grounding grounding(const fem::Model& model, Index node, int axis) {
  Grounding sum;
  for (const fem::Spring& spring : model.springs)
    if (spring.node == node && spring.other < 0) {
      sum.stiffness += spring.stiffness[static_cast<std::size_t>(axis)];
      sum.damping += spring.damping[static_cast<std::size_t>(axis)];
    }
  return sum;
}

/// Forces of the dampers on their nodes where these follow psi and the ground of some moves.
Eigen::VectorXd damper_forces(const fem::Model& model, const Eigen::VectorXd& shape,
                              const Eigen::VectorXd& ground) {
  constexpr double moves_alike = 1e-9; // of a support's unit motion: a static solution leaves round-off
  Eigen::VectorXd out = Eigen::VectorXd::Zero(shape.size());
  for (const fem::Spring& spring : model.springs)
    for (int d = 0; d < core::dofs_per_node; ++d) {
      const double damping = spring.damping[static_cast<std::size_t>(d)];
      const Eigen::Index a = static_cast<Eigen::Index>(spring.node) * core::dofs_per_node + d,
                         b = static_cast<Eigen::Index>(spring.other) * core::dofs_per_node + d;
      const double stretch = shape(a) - (spring.other < 0 ? ground(a) : shape(b));
      if (damping == 0.0 || std::abs(stretch) < moves_alike)
        continue;
      out(a) -= damping * stretch;
      if (spring.other >= 0)
        out(b) += damping * stretch;
    }
  return out;
}

/// Part of a field over the model that belongs to a structure is not zero.
bool acts_on(const fem::Structure& structure, const Eigen::VectorXd& field) {
  for (const Index node : structure.nodes)
    if (!field.segment<6>(static_cast<Eigen::Index>(node) * 6).isZero(0.0))
      return true;
  return false;
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

signals::PrescribedMotion prescribed(const study::SupportMotion& motion) {
  if (motion.by_displacement)
    return signals::motion_of_displacement(motion.function);
  return {motion.function, motion.velocity0.value_or(0.0), motion.displacement0.value_or(0.0)};
}

signals::PrescribedMotion prescribed(const study::BaseMotion& motion) {
  return {motion.acceleration, motion.velocity0.value_or(0.0), motion.displacement0.value_or(0.0)};
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
    moved.ground = moved.force = moved.imposed;
    std::vector<bool> given(static_cast<std::size_t>(moved.imposed.size()), false);
    for (const Index node : mesh::group_nodes(mesh, motion.group, what))
      for (int axis = 0; axis < 3; ++axis) {
        const double along = motion.direction(axis);
        if (std::abs(along) < perpendicular) // of a unit vector: cos 90 degrees
          continue;
        const Eigen::Index row = static_cast<Eigen::Index>(node) * core::dofs_per_node + axis;
        const Grounding grounded = grounding(model, node, axis);
        if (model.is_fixed(node, axis))
          moved.imposed(row) = along, given[static_cast<std::size_t>(row)] = true;
        else if (grounded.stiffness > 0.0 || grounded.damping > 0.0)
          moved.ground(row) = along, moved.force(row) = grounded.stiffness * along;
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

std::vector<SupportFields> support_fields(const std::vector<MovedSupport>& supports, const fem::Model& model,
                                          const std::vector<fem::Structure>& structures) {
  std::vector<SupportFields> out;
  for (const MovedSupport& support : supports) {
    const Eigen::VectorXd force = support.force - fem::stiffness_times(model, support.imposed);
    Eigen::VectorXd shape = support.imposed;
    for (const fem::Structure& structure : structures)
      if (acts_on(structure, force))
        shape += static_shape(model, structure, force, support.name);
    Eigen::VectorXd dampers = damper_forces(model, shape, support.ground);
    out.push_back({std::move(shape), std::move(dampers), support.ground});
  }
  return out;
}

} // namespace fretwork::app
