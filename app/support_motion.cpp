// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/support_motion.hpp"
#include "core/error.hpp"
#include "fem/fields.hpp"
#include "fem/petsc_assembly.hpp"
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

} // namespace

transient::PrescribedMotion prescribed(const study::SupportMotion& motion) {
  if (motion.by_displacement)
    return transient::motion_of_displacement(motion.function);
  return {motion.function, motion.velocity0, motion.displacement0};
}

std::vector<MovedSupport> moved_supports(const study::Study& study, const mesh::LineMesh& mesh,
                                         const fem::Model& model) {
  std::vector<MovedSupport> out;
  for (std::size_t e = 0; e < study.support_motions.size(); ++e) {
    const study::SupportMotion& motion = study.support_motions[e];
    const std::string what = fmt::format("[[support_motion]] entry {}", e + 1);
    MovedSupport moved;
    moved.imposed.setZero(static_cast<Eigen::Index>(model.nodes.size()) * core::dofs_per_node);
    moved.force = moved.imposed;
    for (const Index node : mesh::group_nodes(mesh, motion.group, what))
      for (int axis = 0; axis < 3; ++axis) {
        const double along = motion.direction(axis);
        if (std::abs(along) < round_off) // of a unit vector: cos 90 degrees
          continue;
        const Eigen::Index row = static_cast<Eigen::Index>(node) * core::dofs_per_node + axis;
        const double stiffness = grounded_stiffness(model, node, axis);
        if (model.is_fixed(node, axis))
          moved.imposed(row) = along;
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
    fem::follow_ties(model, moved.imposed);
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
        shape += fem::static_solution(model, structure, force);
    out.push_back(std::move(shape));
  }
  return out;
}

} // namespace fretwork::app
