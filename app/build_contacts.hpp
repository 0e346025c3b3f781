// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Contacts of a study placed on the model: one for each node of each group, with its frame.
#pragma once
#include "app/build_model.hpp"
#include "contact/frame.hpp"
#include "contact/support.hpp"

namespace fretwork::app {

struct PlacedContact {
  std::string name;  ///< the study's, with [i] where the group has several nodes
  std::size_t entry; ///< in study.contacts
  core::Index node;
  core::Index other = -1; ///< the second node, -1: the obstacle is fixed
  contact::Frame frame;
  core::Vec3 rest; ///< m: the node from the obstacle's centre (from the second node), local axes
};

/// @throws core::Error for a node whose three displacements are restrained, for an axis that must be given (a
/// node without beams, or where
///         beams branch)
[[nodiscard]] std::vector<PlacedContact> place_contacts(const study::Study& study, const mesh::LineMesh& mesh,
                                                        const fem::Model& model);

/// `rest` tells the side on which two flat bodies start.
/// @throws core::Error for two flat bodies whose nodes coincide where the study does not give the side
[[nodiscard]] contact::Obstacle obstacle_of(const study::Contact& contact, const PlacedContact& placed);
[[nodiscard]] std::string name_of(study::ObstacleKind kind);

} // namespace fretwork::app
