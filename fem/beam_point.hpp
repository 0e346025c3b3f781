// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Points of beams between nodes: how the nodes move them, by the shapes of the element (flexible_beam.hpp).
#pragma once
#include "fem/model.hpp"
#include <Eigen/Core>

namespace fretwork::fem {

/// What a node gives to the displacement of a point: weights times its ux uy uz rx ry rz, global axes.
struct NodeShare {
  Index node;
  Eigen::Matrix<double, 3, 6> weights;
};

struct BeamPoint {
  Vec3 place;                    ///< m
  std::vector<NodeShare> motion; ///< of one node, or of the two ends of a beam
};

[[nodiscard]] BeamPoint point_at(const Model& model, Index node);

/// The direction of a beam, from its a to its b, at one of its nodes (unit vector).
[[nodiscard]] Vec3 tangent_at(const Model& model, const Beam& beam, Index node);

/// The point at the share s (0 to 1) of a beam.
[[nodiscard]] BeamPoint point_on(const Model& model, const Beam& beam, double s);

/// The point that is `distance` (m, >= 0) away from a node, walking along the beams; the first beam is the
/// one that leaves the node most along `direction`. A point closer to a node than 1e-9 of the beam there is
/// the node: that much rounding leaves of lengths that should be equal.
/// @throws core::Error where no beam leaves along `direction`, where the beams end before, or several go on;
///         `what` names the object
[[nodiscard]] BeamPoint point_along(const Model& model, Index node, const Vec3& direction, double distance,
                                    const std::string& what);

} // namespace fretwork::fem
