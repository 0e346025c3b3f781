// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Static flexibility at the contacts of a scene: the structures', what of it their modes have, what they lack
/// (modal/static_flexibility.hpp).
///
/// Of each contact alone, between its directions that are loaded (contact_loads.hpp); between two nodes the flexibility is that of the relative
/// motion. Rows and columns of other directions are 0.
#pragma once
#include "app/build_contacts.hpp"
#include "modal/basis.hpp"
#include "results/run_results.hpp"
#include <mpi.h>

namespace fretwork::app {

struct ContactFlexibility {
  std::vector<std::size_t>
      contacts; ///< numbers of the scene's contacts among the placed ones: contacts_of (contact_loads.hpp)
  /// m/N, 3 nc x 3: of each contact alone, over its x_loc y_loc z_loc; symmetric, missing >= 0.
  Eigen::MatrixXd exact, basis, missing;
  std::string failure; ///< why there is none of the above; empty: there is

  /// Of the k-th contact, in one of the above.
  [[nodiscard]] static Eigen::Matrix3d own(const Eigen::MatrixXd& matrix, std::size_t k);
  /// Of the k-th contact in the normal direction in which most is missing.
  [[nodiscard]] results::StaticFlexibility at(std::size_t k, const contact::Obstacle& obstacle) const;
};

/// Collective; needs PETSc. Scenes are shared out over ranks; the same bytes on every rank and for any number of ranks. Equal structures
/// are factorised once a rank.
/// Where there is none, `failure` says why.
/// @param scenes  numbers of the structures of each
[[nodiscard]] std::vector<ContactFlexibility>
contact_flexibilities(MPI_Comm comm, const study::Study& study, const fem::Model& model,
                      const std::vector<fem::Structure>& structures, const std::vector<modal::Basis>& bases,
                      const std::vector<std::vector<std::size_t>>& scenes,
                      const std::vector<PlacedContact>& placed);

} // namespace fretwork::app
