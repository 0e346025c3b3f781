// SPDX-License-Identifier: GPL-3.0-or-later
#include "fem/rigid_motions.hpp"
#include "core/error.hpp"
#include "core/pivoted_columns.hpp"
#include "core/symmetric.hpp"
#include "fem/beam_constants.hpp"
#include "fem/disjoint_sets.hpp"
#include "fem/fields.hpp"
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace fretwork::fem {
namespace {

using Matrix6 = Eigen::Matrix<double, 6, 6>;

/// Rows are of order 1. A mesh generator places nodes to about 1e-11 of the size: a restraint line as
/// straight as that is straight.
constexpr double geometry_tolerance = 1e-8;
/// Modal mass (relative to the heaviest motion, each column scaled by its own) below which a motion is
/// without mass: round-off leaves 1e-16; a wire a million times as long as thick that spins has 1e-12.
constexpr double massless = 1e-14;

Eigen::MatrixXd null_space(const Eigen::MatrixXd& rows) {
  if (rows.rows() == 0 || rows.cols() == 0)
    return Eigen::MatrixXd::Identity(rows.cols(), rows.cols());
  const core::PivotedColumns independent = core::pivoted_columns(rows.transpose());
  const Eigen::VectorXd& pivots = independent.pivots;
  Eigen::Index rank = 0;
  while (rank < pivots.size() && std::abs(pivots[rank]) > geometry_tolerance)
    ++rank;
  return independent.q.rightCols(rows.cols() - rank);
}

/// A set of nodes that beams make rigid, when nothing is strained.
struct RigidPart {
  std::vector<Index> positions; ///< in structure.nodes
  Vec3 centre = Vec3::Zero();
  double radius = 0.0;
  Eigen::MatrixXd free;    ///< 6 x k: motions that its restraints allow
  Eigen::Index column = 0; ///< of its first motion among those of all parts
};

/// Displacement (6 values) of a point of the part in each of its six motions.
Matrix6 point_motions(const RigidPart& part, const Vec3& point) {
  Matrix6 motion = Matrix6::Zero();
  motion.topLeftCorner<3, 3>().setIdentity();
  for (int axis = 0; axis < 3; ++axis) {
    motion.block<3, 1>(0, 3 + axis) = Vec3::Unit(axis).cross(point - part.centre) / part.radius;
    motion(3 + axis, 3 + axis) = 1.0 / part.radius;
  }
  return motion;
}

class Parts {
public:
  Parts(const Model& model, const Structure& structure) : model_(model), structure_(structure) {
    find_parts();
    for (RigidPart& part : parts_) {
      place_part(part);
      restrain(part);
      part.column = columns_;
      columns_ += part.free.cols();
    }
  }

  /// Fields over the structure of the motions that nothing resists and that keep the ties.
  [[nodiscard]] Eigen::MatrixXd motions() const {
    const Eigen::MatrixXd combinations = null_space(resisted_rows());
    Eigen::MatrixXd fields =
        Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(structure_.nodes.size()) * 6, combinations.cols());
    for (const RigidPart& part : parts_)
      for (const Index position : part.positions) {
        const Vec3& point = model_.nodes[node(position)];
        for (int d = 0; d < dofs_per_node; ++d)
          if (!model_.is_fixed(structure_.nodes[static_cast<std::size_t>(position)], d))
            fields.row(Eigen::Index{position} * 6 + d) =
                (point_motions(part, point).row(d) * part.free) *
                combinations.middleRows(part.column, part.free.cols());
      }
    return fields;
  }

private:
  [[nodiscard]] std::size_t node(Index position) const {
    return static_cast<std::size_t>(structure_.nodes[static_cast<std::size_t>(position)]);
  }

  void find_parts() {
    DisjointSets sets(structure_.nodes.size());
    for (const Index number : structure_.beams) {
      const Beam& beam = model_.beams[static_cast<std::size_t>(number)];
      sets.join(position_of(structure_, beam.a), position_of(structure_, beam.b));
    }
    std::size_t count = 0;
    part_of_ = sets.labels(count);
    parts_.resize(count);
    for (std::size_t i = 0; i < part_of_.size(); ++i)
      parts_[part_of_[i]].positions.push_back(static_cast<Index>(i));
  }

  void place_part(RigidPart& part) const {
    for (const Index position : part.positions)
      part.centre += model_.nodes[node(position)] / static_cast<double>(part.positions.size());
    for (const Index position : part.positions)
      part.radius = std::max(part.radius, (model_.nodes[node(position)] - part.centre).norm());
    if (part.radius == 0.0) // a single node: any length serves
      part.radius = 1.0;
  }

  void restrain(RigidPart& part) const {
    std::vector<Eigen::Matrix<double, 1, 6>> rows;
    for (const Index position : part.positions) {
      const Matrix6 motion = point_motions(part, model_.nodes[node(position)]);
      for (int d = 0; d < dofs_per_node; ++d)
        if (model_.is_fixed(structure_.nodes[static_cast<std::size_t>(position)], d))
          rows.emplace_back(motion.row(d) * (d < 3 ? 1.0 : part.radius));
    }
    Eigen::MatrixXd stacked(rows.size(), 6);
    for (std::size_t i = 0; i < rows.size(); ++i)
      stacked.row(static_cast<Eigen::Index>(i)) = rows[i];
    part.free = null_space(stacked);
  }

  /// Stretch of every spring direction that has a stiffness, and of every component tied; pulls of axial forces.
  [[nodiscard]] Eigen::MatrixXd resisted_rows() const {
    std::vector<Eigen::RowVectorXd> rows;
    for (const Index number : structure_.springs) {
      const Spring& spring = model_.springs[static_cast<std::size_t>(number)];
      for (int d = 0; d < dofs_per_node && columns_ > 0; ++d)
        if (spring.stiffness[static_cast<std::size_t>(d)] > 0.0)
          rows.push_back(stretch(spring.node, spring.other, d));
    }
    for (const Index number : structure_.ties) {
      const Tie& tie = model_.ties[static_cast<std::size_t>(number)];
      for (int d = 0; d < dofs_per_node && columns_ > 0; ++d)
        if ((tie.dofs >> d) & 1u)
          rows.push_back(stretch(tie.node, tie.other, d));
    }
    const Eigen::MatrixXd pulled = pulls();
    const auto stretched = static_cast<Eigen::Index>(rows.size());
    Eigen::MatrixXd stacked(stretched + pulled.rows(), columns_);
    for (Eigen::Index i = 0; i < stretched; ++i)
      stacked.row(i) = rows[static_cast<std::size_t>(i)];
    stacked.bottomRows(pulled.rows()) = pulled;
    return stacked;
  }

  /// Of component d between two nodes, or a node and the ground (other < 0).
  [[nodiscard]] Eigen::RowVectorXd stretch(Index model_node, Index other, int d) const {
    Eigen::RowVectorXd row = Eigen::RowVectorXd::Zero(columns_);
    const double scale = d < 3 ? 1.0 : part_at(model_node).radius;
    add_motion(row, model_node, d, scale);
    if (other >= 0)
      add_motion(row, other, d, -scale);
    return row;
  }

  /// Forces on the equations of the axial forces of beams that a motion turns, as shares of the largest: each pulls
  /// its ends back by N times the turn across it. Where they balance (a structure stressed in itself) the motion
  /// stays a rigid one.
  [[nodiscard]] Eigen::MatrixXd pulls() const {
    double largest = 0.0;
    for (const Index number : structure_.beams)
      largest = std::max(largest, std::abs(axial_force(number)));
    if (largest == 0.0 || columns_ == 0)
      return {0, columns_};
    Eigen::MatrixXd forces = Eigen::MatrixXd::Zero(structure_.equations, columns_);
    for (const Index number : structure_.beams) {
      const Beam& beam = model_.beams[static_cast<std::size_t>(number)];
      const Vec3 &a = model_.nodes[static_cast<std::size_t>(beam.a)],
                 &b = model_.nodes[static_cast<std::size_t>(beam.b)];
      const RigidPart& part = part_at(beam.a);
      const Eigen::Matrix<double, 3, Eigen::Dynamic> turn =
          part.radius * point_motions(part, a).bottomRows<3>() * part.free;
      for (Eigen::Index j = 0; j < turn.cols(); ++j) {
        const Vec3 pull = axial_force(number) / largest * Vec3(turn.col(j)).cross((b - a).normalized());
        add_force(forces, part.column + j, beam.b, pull);
        add_force(forces, part.column + j, beam.a, -pull);
      }
    }
    return forces;
  }

  void add_force(Eigen::MatrixXd& forces, Eigen::Index column, Index model_node, const Vec3& force) const {
    for (int d = 0; d < 3; ++d)
      if (const Index row = structure_.equation[static_cast<std::size_t>(
              position_of(structure_, model_node) * dofs_per_node + d)];
          row >= 0)
        forces(row, column) += force[d];
  }

  [[nodiscard]] double axial_force(Index number) const {
    const Beam& beam = model_.beams[static_cast<std::size_t>(number)];
    return fem::axial_force(model_.properties[static_cast<std::size_t>(beam.property)], beam.along);
  }

  [[nodiscard]] const RigidPart& part_at(Index model_node) const {
    return parts_[part_of_[static_cast<std::size_t>(position_of(structure_, model_node))]];
  }

  void add_motion(Eigen::RowVectorXd& row, Index model_node, int d, double scale) const {
    const RigidPart& part = part_at(model_node);
    const Matrix6 motion = point_motions(part, model_.nodes[static_cast<std::size_t>(model_node)]);
    row.segment(part.column, part.free.cols()) += scale * motion.row(d) * part.free;
  }

  const Model& model_;
  const Structure& structure_;
  std::vector<RigidPart> parts_;
  std::vector<std::size_t> part_of_;
  Eigen::Index columns_ = 0;
};

} // namespace

Eigen::MatrixXd rigid_motions(const Model& model, const Structure& structure) {
  Eigen::MatrixXd fields = Parts(model, structure).motions();
  if (fields.cols() == 0)
    return fields;
  for (int pass = 0; pass < 2; ++pass) { // the second removes what round-off left of the first
    const Eigen::MatrixXd gram = fields.transpose() * mass_times(model, structure, fields);
    if (pass == 0) {
      const Eigen::VectorXd masses = core::symmetric_eigenvalues(gram);
      if (!(masses[0] > massless * masses[gram.cols() - 1]))
        throw core::Error("the structure that starts at node " +
                          place(model.nodes[static_cast<std::size_t>(structure.nodes.front())]) +
                          " has a motion with neither stiffness nor mass (a beam without polar_inertia that "
                          "spins about its "
                          "axis?); restrain it or give it mass");
    }
    core::Cholesky(gram).orthonormalise(fields);
  }
  return fields;
}

} // namespace fretwork::fem
