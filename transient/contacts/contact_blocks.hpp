// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Contacts by the modes that they move: a block is a set of modes, such as those of one tube, that its contacts share with no other. A contact
/// between two tubes is in the blocks of both. The mobility between contacts is the sum over the blocks that they share: dense within a block, none
/// beyond, so that what it takes grows with the number of tubes, not with its square.
#pragma once
#include "transient/scene/scene.hpp"

namespace fretwork::transient {

struct ContactBlocks {
  /// Blocks of ContactPoint::modes, one where a contact names none. All are one where the damping matrix couples two of them.
  explicit ContactBlocks(const Scene& scene);

  /// Where a contact stands in a block: contacts[block][local].
  struct Place {
    int block, local;
  };
  std::vector<std::vector<int>> contacts; ///< of each block, ascending
  std::vector<std::vector<Place>> places; ///< of each contact, blocks ascending
  std::vector<int> block_of_mode;         ///< n; -1: no contact moves it

  [[nodiscard]] std::size_t size() const { return contacts.size(); }
};

} // namespace fretwork::transient
