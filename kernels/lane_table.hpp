// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Tables of numbers of contacts in vector lanes.
#pragma once
#include "core/state_archive.hpp"
#include "kernels/kernels.hpp"

namespace fretwork::kernels {

/// One number of `lanes` contacts.
using Numbers = double[lanes];
/// Where a contact stands among these.
[[nodiscard]] constexpr int lane(int contact) {
  return static_cast<int>(static_cast<unsigned>(contact) % lanes);
}

/// Numbers of contacts: those of `lanes` contacts lie together, at distances that compilers know.
template <class Pack> class LaneTable {
public:
  LaneTable() = default;
  /// All 0.   @param width  contacts, padded
  explicit LaneTable(int width) : packs_(static_cast<std::size_t>(width / lanes)) {}
  /// The pack in which a contact stands.
  [[nodiscard]] Pack& operator[](int contact) { return packs_[static_cast<unsigned>(contact) / lanes]; }
  [[nodiscard]] const Pack& operator[](int contact) const {
    return packs_[static_cast<unsigned>(contact) / lanes];
  }
  void visit(core::StateArchive& state) { state(packs_); }

private:
  std::vector<Pack, AlignedAllocator<Pack>> packs_;
};

} // namespace fretwork::kernels
