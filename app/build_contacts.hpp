// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Contacts of a study placed on the model: one for each node of each group, or one for each point along the
/// thickness of its support.
#pragma once
#include "app/build_model.hpp"
#include "contact/frame.hpp"
#include "contact/support.hpp"
#include "fem/beam_point.hpp"

namespace fretwork::app {

struct PlacedContact {
  std::string name;      ///< the study's, with [i] where the group has several nodes and @k along a thickness
  std::string support;   ///< the same without @k
  std::size_t entry;     ///< in study.contacts
  std::size_t order = 0; ///< among all contacts of the study
  bool active = true;
  core::Index node;                   ///< of the group
  core::Index other = -1;             ///< the second node, -1: the obstacle is fixed
  std::vector<fem::NodeShare> motion; ///< of the point that meets the obstacle: the node, or one near it
  core::Vec3 place;                   ///< m, of that point
  contact::Frame frame;
  contact::Obstacle obstacle; ///< of two flat bodies with the side on which the first stays
  core::Vec3 rest;            ///< m: the point from the obstacle's centre (from the second node), local axes
  double share = 1.0;         ///< of the stiffnesses and dampers of its support
  double normal_stiffness = 0.0; ///< N/m, of the whole support
};

/// @param warnings  takes what is hardly meant: bodies that start passed through each other
/// @throws core::Error for a point that nothing lets move, for an axis that must be given (a node without
///         beams, or where beams branch), for a tube that is shorter than its support, for the stiffness of a
///         wall where there is no tube, for two flat bodies whose nodes have no side where the study does not
///         give it, for two points of one name
[[nodiscard]] std::vector<PlacedContact> place_contacts(const study::Study& study, const mesh::LineMesh& mesh,
                                                        const fem::Model& model,
                                                        std::vector<std::string>& warnings);

/// m, of a tube at the obstacle's centre; between two nodes as the study places them.
[[nodiscard]] double gap_of(const PlacedContact& placed, const contact::Obstacle& obstacle);

/// @throws core::Error where a name is neither that of a contact nor of one of its supports, and says how many it has
/// @param name  of a contact, or such a name with an index behind it
void check_index(const std::string& what, const std::string& name, const study::Study& study,
                 const std::vector<PlacedContact>& placed);

/// Takes the contacts that the study has made inactive out of all.
[[nodiscard]] std::vector<PlacedContact> take_inactive(std::vector<PlacedContact>& placed);

/// Both, in the order of the study.
[[nodiscard]] std::vector<PlacedContact> together(std::vector<PlacedContact> placed,
                                                  const std::vector<PlacedContact>& inactive);

} // namespace fretwork::app
