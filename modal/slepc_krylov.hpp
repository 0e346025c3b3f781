// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The lowest modes of a large structure: Krylov-Schur on (K - sigma M)^-1 M, certified by the inertia of K -
/// s M (Sylvester: as many negative pivots as there are eigenvalues below s).
#pragma once
#include "fem/petsc_assembly.hpp"
#include "modal/dense_modes.hpp"

namespace fretwork::modal {

class KrylovModes {
public:
  /// Collective over `comm`. Motions without strain (`rigid`, fields over the structure) are deflated, and
  /// counted by below().
  KrylovModes(MPI_Comm comm, const fem::Model& model, const fem::Structure& structure,
              const Eigen::MatrixXd& rigid);

  /// Number of dofs with mass.
  [[nodiscard]] int massive() const { return massive_; }

  /// Number of modes (rigid ones included) with lambda < s, s > 0. Collective.
  [[nodiscard]] int below(double s) const;

  /// Up to which lambda modes are needed where those up to `lambda` are wanted: the motion inside the beams
  /// (fem/inner_motion.hpp), which comes later, may change their order.
  [[nodiscard]] double reach(double lambda) const;

  /// At least the `count` lowest elastic modes, and so many more that the cluster of the last wanted one is
  /// complete, and all up to `reach` of its lambda; none is missing among them. None at all where that takes so many
  /// that a dense solve must serve. Collective; the same on every rank.
  /// @throws core::ComputationError where they do not converge or one stays missing
  [[nodiscard]] Pairs lowest(int count) const;

private:
  [[nodiscard]] Pairs solve(int count, const Eigen::MatrixXd& deflated, int start) const;
  [[nodiscard]] Pairs slice(int count) const;
  [[nodiscard]] Pairs complete(Pairs pairs, int count) const;
  [[nodiscard]] std::string what() const;

  MPI_Comm comm_;
  const fem::Model& model_;
  const fem::Structure& structure_;
  Eigen::MatrixXd rigid_; ///< free dofs
  fem::SystemMatrices system_;
  fem::Elimination elimination_;
  double inner_scale_; ///< s2, fem::inner_motion_scale
  int massive_ = 0;
  double shift_ = 0.0; ///< 0 for a held structure, else negative: K - shift M is definite
};

/// Whether no mode has lambda < 0: compressed beams may buckle. Collective.
/// @param rigid  motions without strain, fields over the structure
[[nodiscard]] bool is_stable(MPI_Comm comm, const fem::Model& model, const fem::Structure& structure,
                             const Eigen::MatrixXd& rigid);

} // namespace fretwork::modal
