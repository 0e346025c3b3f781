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
  contact::Frame frame;
  core::Vec3 rest; ///< m: the node from the obstacle's centre, local axes
};

/// @throws core::Error for a node whose three displacements are restrained, for an axis that must be given (a
/// node without beams, or where
///         beams branch)
[[nodiscard]] std::vector<PlacedContact> place_contacts(const study::Study& study, const mesh::LineMesh& mesh,
                                                        const fem::Model& model);

/// Obstacle, laws and automatic tangential damping not yet filled in.
[[nodiscard]] contact::Obstacle obstacle_of(const study::Contact& contact);
[[nodiscard]] std::string name_of(study::ObstacleKind kind);

} // namespace fretwork::app
