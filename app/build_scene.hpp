// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The transient of one structure, or of several that meet in contacts between two nodes, in modal coordinates.
#pragma once
#include "app/build_contacts.hpp"
#include "app/build_fields.hpp"
#include "app/contact_flexibility.hpp"
#include "app/watched_wear.hpp"
#include "modal/basis.hpp"
#include "post/force_statistics.hpp"
#include "post/recorder.hpp"
#include "transient/scene/scene.hpp"

namespace fretwork::app {

struct BuiltScene {
  transient::Scene scene;               ///< its modes that something moves
  std::vector<Eigen::Index> moving;     ///< their numbers among those of its structures, ascending
  std::vector<Eigen::Index> true_modes; ///< numbers of those of the scene's modes that are no static modes
  Eigen::Index modes = 0;               ///< of its structures
  std::vector<std::size_t>
      structures;                    ///< numbers of its structures, ascending; their modes follow each other
  std::vector<std::size_t> contacts; ///< numbers of its contacts among the placed ones
  WatchedWear watched_wear;          ///< of its contacts
  std::vector<post::ObservedNode> nodes;   ///< observed nodes of these structures
  std::vector<std::size_t> node_numbers;   ///< their numbers among all observed nodes
  std::vector<post::FollowedForce> forces; ///< of these structures (force_sites.hpp)
  std::vector<std::size_t> force_numbers;  ///< their numbers among all force sites
  double lacking = 0.0;   ///< largest missing flexibility times stiffness (missing_flexibility.hpp)
  std::string lacking_at; ///< name of the contact
  std::vector<std::string> truncated; ///< names of the contacts where it is much (modal_truncation.hpp)
  std::vector<std::string> notes;     ///< to be told the user (the projection, the equilibrium)
  std::vector<std::string> warnings;  ///< (a lost share of the initial field)
};

/// Numbers of a scene's true modes among the columns of a contact, and in the scene.
struct TrueModes {
  std::vector<Eigen::Index> columns, modes;
};
/// @param true_modes  of the scene, ascending
[[nodiscard]] TrueModes true_modes_of(const transient::ContactPoint& point,
                                      const std::vector<Eigen::Index>& true_modes);

/// A node of `[output] nodes` and its name: the group's, with [i] where it has several nodes.
struct NamedNode {
  std::string name;
  core::Index node;
};
[[nodiscard]] std::vector<NamedNode> observed_nodes(const study::Study& study, const mesh::LineMesh& mesh);

/// Of 6 values a node of the model those of the nodes of a structure.
[[nodiscard]] Eigen::VectorXd restricted(const modal::Basis& basis, const Eigen::VectorXd& field);

/// Groups of structures that contacts between two nodes, or a fluid, join, by their lowest member; a structure that meets
/// no other is a group by itself. A second node that belongs to no structure is fixed.
[[nodiscard]] std::vector<std::vector<std::size_t>>
joined_structures(const std::vector<modal::Basis>& bases, const std::vector<PlacedContact>& contacts,
                  const std::vector<FluidForces>& fluid);

/// Structures that move together: those of one scene.
struct CoupledStructures {
  const std::vector<std::size_t>& structures;   ///< one group of joined_structures()
  const ContactFlexibility& flexibility;        ///< of their contacts
  std::vector<signals::SampledLoad> turbulence; ///< on their modes (sampled_loads)
};

/// @param bases, contacts, nodes  of the whole model: those of the scene are taken from them
[[nodiscard]] BuiltScene build_scene(const study::Study& study, const std::vector<modal::Basis>& bases,
                                     const std::vector<PlacedContact>& contacts,
                                     const std::vector<NamedNode>& nodes, const Fields& fields,
                                     CoupledStructures coupled);

} // namespace fretwork::app
