// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// What a motion does to the beams of the structure: their frames and radii, and the section forces and stresses that follow from the
/// displacements and rotations of the nodes by the shapes of the elements (fem/beam_element.hpp).
///
/// The displacements are sums over the modes, u = sum phi_i q_i. Where a force F acts on a beam, the part of mode i in u falls as
/// 1/omega_i^2, in the moments EI w'' as 1/omega_i, and in the shear forces not faster than omega_i^(-1/2): moments and shear forces need
/// more modes than displacements.
#pragma once
#include "fem/beam_element.hpp"
#include "results/mode_fields.hpp"

namespace fretwork::results {

/// Unit vectors, a place a column; zero where there is no beam.
struct Frames {
  Field x, y, z;
};

class BeamFields {
public:
  /// @param results  with beams
  explicit BeamFields(const RunResults& results);

  /// Of the sections in the middle of the beams.
  [[nodiscard]] const Frames& of_beams() const { return of_beams_; }
  /// The mean of the beams that meet in a node, orthonormal; of the first of them where they have no common direction (y and z also where
  /// their sections are turned against each other).
  [[nodiscard]] const Frames& of_nodes() const { return of_nodes_; }
  /// m, by nodes: of round sections the outer radius, of others that of a circle of the same area; the largest where beams of different
  /// size meet, 0 without beam.
  [[nodiscard]] const Eigen::RowVectorXd& radius() const { return radius_; }

  struct Forces {
    Eigen::Matrix<double, 6, Eigen::Dynamic> middle; ///< N Vy Vz T My Mz (N, N m) in the middle of each beam
    /// Pa, the largest normal stress at the outer fibre, at the ends and in the middle of each beam (straight uniform beams: the
    /// largest of all); NaN where the outline of the section is not known
    Eigen::RowVectorXd stress;
  };
  [[nodiscard]] Forces forces(const Motion& motion) const;

private:
  void set_nodes();

  const RunResults& results_;
  std::vector<fem::BeamElement> elements_;
  Frames of_beams_, of_nodes_;
  Eigen::RowVectorXd radius_;
};

} // namespace fretwork::results
