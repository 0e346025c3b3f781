// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// What a transient counts for wear, by contact.
#pragma once
#include "wear/kwu_epri.hpp"
#include <optional>
#include <vector>

namespace fretwork::app {

/// Empty lists where no contact wears.
struct WatchedWear {
  std::vector<int> sectors;                           ///< of the work by angle; 0: the contact does not wear
  std::vector<std::optional<wear::KwuMaxima>> maxima; ///< of contacts under the law kwu_epri

  bool by_place =
      false; ///< sectors are those of the places of contacts, not of their normals: holes that wear has opened by angle

  /// Of some of the contacts.
  [[nodiscard]] WatchedWear at(const std::vector<std::size_t>& contacts) const {
    WatchedWear out;
    out.by_place = by_place;
    if (sectors.empty())
      return out;
    for (const std::size_t c : contacts) {
      out.sectors.push_back(sectors[c]);
      out.maxima.push_back(maxima[c]);
    }
    return out;
  }
  [[nodiscard]] bool counts_forces() const {
    for (const auto& of_contact : maxima)
      if (of_contact)
        return true;
    return false;
  }
};

} // namespace fretwork::app
