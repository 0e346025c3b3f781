// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The unit forces with which the contacts of a scene load its structures.
///
/// Loaded are the directions that a normal force can take and, with friction, those in which it can act and along which the modes move the contact. Between two
/// nodes the load is a pair of opposite forces, each on its structure.
#pragma once
#include "app/build_contacts.hpp"
#include "modal/basis.hpp"

namespace fretwork::app {

/// Forces on the nodes of a structure, one loaded direction a column.
struct StructureLoads {
  std::vector<Eigen::Index>
      among;              ///< numbers of the columns among the loaded directions of the scene, ascending
  Eigen::MatrixXd forces; ///< N, 6 * basis.nodes.size() rows
};

struct ContactLoads {
  std::vector<Eigen::Index>
      directions; ///< that are loaded, ascending: 3 k + d for the k-th contact along x_loc y_loc z_loc, d = 0 1 2
  std::vector<StructureLoads> on; ///< of each structure of the scene
};

/// Numbers of the contacts of a scene among the placed ones, ascending: one of their nodes belongs to it.
/// @param structures  numbers of those of the scene
[[nodiscard]] std::vector<std::size_t> contacts_of(const std::vector<modal::Basis>& bases,
                                                   const std::vector<std::size_t>& structures,
                                                   const std::vector<PlacedContact>& placed);

/// The unit forces along x_loc y_loc z_loc of contacts that act on a structure, loaded or not.
/// @param contacts  numbers among the placed ones   @return `among`: 3 k + d for the k-th of them
[[nodiscard]] StructureLoads unit_forces(const std::vector<PlacedContact>& placed,
                                         const std::vector<std::size_t>& contacts, const modal::Basis& basis);

/// @param structures, contacts  numbers of those of the scene
[[nodiscard]] ContactLoads contact_loads(const study::Study& study, const std::vector<modal::Basis>& bases,
                                         const std::vector<std::size_t>& structures,
                                         const std::vector<PlacedContact>& placed,
                                         const std::vector<std::size_t>& contacts);

} // namespace fretwork::app
