// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The supports of a study that wear: which contacts make each, its law and its geometry, before anything is computed.
///
/// A support is a node of a contact with all points of its thickness; with `one_support` all contacts of the entry. An entry of `[[wear]]`
/// names contacts, supports (`support[3]`) or patterns of them (* any characters, ? one); one entry without names holds for all that no other
/// names. Sizes that the study does not give are those of the contact and of the beam at its node.
#pragma once
#include "app/build_contacts.hpp"
#include "app/watched_wear.hpp"
#include "results/wear_results.hpp"
#include "wear/life.hpp"

namespace fretwork::app {

/// A side of a support (contact/sides.hpp), named as of its first contact.
struct WornSide {
  struct Part {
    std::size_t contact;             ///< among the placed ones
    std::optional<std::size_t> side; ///< number among the sides of this contact; nothing: its only one
  };
  std::string name;
  std::vector<Part> parts;    ///< whose work rates are summed
  double initial_depth = 0.0; ///< m, of the tube
};

struct WornPlace {
  std::string name;
  std::size_t entry;                 ///< in study.wear
  std::vector<std::size_t> contacts; ///< numbers among the placed ones
  wear::WornSupport worn;
  std::vector<WornSide> sides;  ///< each with a scar of its own; empty: one scar
  std::string source;           ///< of the tube's coefficient
  results::WearOfSupport facts; ///< name, contacts, law, geometry and sizes, ready for the results
  std::vector<std::size_t> turns =
      {}; ///< quarter turns of each contact about x_loc from the axes of the first, 0 to 3
};

/// @throws core::Error for a name that fits no contact, a contact that two entries name, a size that nothing gives, an obstacle without a
///         geometry of wear, a coefficient that the bank does not have, initial wear of a side that there is not, contacts of one support with different local axes, but for bars on several sides
[[nodiscard]] std::vector<WornPlace> worn_places(const study::Study& study, const fem::Model& model,
                                                 const std::vector<PlacedContact>& placed);

/// What the transient counts. @param contacts  number of all contacts
[[nodiscard]] WatchedWear watched_wear(const study::Study& study, const std::vector<WornPlace>& places,
                                       std::size_t contacts);

} // namespace fretwork::app
