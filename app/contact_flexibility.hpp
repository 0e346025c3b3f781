// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Static flexibility at the contacts of a scene: the structures', what of it their modes have, what they lack
/// (modal/static_flexibility.hpp).
///
/// Between the directions that are loaded (contact_loads.hpp); between two nodes the flexibility is that of the relative motion. Rows and
/// columns of other directions are 0.
/// What the modes lack of the displacement under the loads of the study is theirs by the same solutions: S = U^T f - P^T Phi Omega^-2 Phi^T f.
#pragma once
#include "app/build_contacts.hpp"
#include "app/build_fields.hpp"
#include "app/turbulent_loads.hpp"
#include "modal/basis.hpp"
#include "results/run_results.hpp"
#include <mpi.h>

namespace fretwork::app {

struct ContactFlexibility {
  std::vector<std::size_t>
      contacts; ///< numbers of the scene's contacts among the placed ones: contacts_of (contact_loads.hpp)
  /// m/N, 3 nc x 3 nc over x_loc y_loc z_loc of each; symmetric, missing >= 0. Unless static_modes = "auto" 3 nc x 3: of each contact alone.
  Eigen::MatrixXd exact, basis, missing;
  Eigen::MatrixXd
      under_loads; ///< m, 3 nc x loads of the fields: what the modes lack of the static displacements; 0 unless static_modes = "auto"
  Eigen::VectorXd
      under_turbulence; ///< m, rms, 3 nc: what the modes lack of the displacement under the turbulence, were it as slow as
                        ///< statics; 0 unless static_modes = "auto"
  std::string failure; ///< why there is none of the above; empty: there is

  /// Rows and columns of the k-th contact in one of the above.
  [[nodiscard]] static Eigen::Matrix3d own(const Eigen::MatrixXd& matrix, std::size_t k);
  /// Of the k-th contact in the normal direction in which most is missing.
  [[nodiscard]] results::StaticFlexibility at(std::size_t k, const contact::Obstacle& obstacle) const;
};

/// Collective; needs PETSc. Scenes are shared out over ranks; the same bytes on every rank and for any number of ranks. Equal structures
/// are factorised once a rank.
/// Unless static_modes = "auto" `missing` is that of each contact alone, which is what `at` tells, and `failure` says why there is none.
/// @param scenes  numbers of the structures of each
/// @throws with static_modes = "auto": core::ComputationError where a structure's stiffness is singular to working precision, core::Error
///         where a motion without strain moves no mass
[[nodiscard]] std::vector<ContactFlexibility>
contact_flexibilities(MPI_Comm comm, const study::Study& study, const fem::Model& model,
                      const std::vector<fem::Structure>& structures, const std::vector<modal::Basis>& bases,
                      const std::vector<std::vector<std::size_t>>& scenes,
                      const std::vector<PlacedContact>& placed, const std::vector<Fields::Load>& loads,
                      const std::vector<TurbulentLoad>& turbulence);

} // namespace fretwork::app
