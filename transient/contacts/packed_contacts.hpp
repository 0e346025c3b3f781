// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The contacts of a scene as the step needs them: contiguous, padded, contact by contact in vector lanes.
#pragma once
#include "transient/contacts/reach_lanes.hpp"
#include "transient/scene/scene.hpp"

namespace fretwork::transient {

/// Velocities and displacements of all contacts are arrays of `components` blocks of `width` lanes: y of all
/// contacts, then z, then x (x_loc only where friction acts on a contact that modes or obstacles move along it).
struct PackedContacts {
  /// @param full  rows have few zeros: up to 4 contacts are taken row by row, not only up to 2
  PackedContacts(const std::vector<ContactPoint>& contacts, Eigen::Index modes, bool full = false);

  int count = 0;      ///< contacts
  int width = 0;      ///< lanes: count, padded
  int components = 2; ///< 2: y z; 3: y z x
  int modes = 0, padded_modes = 0;
  [[nodiscard]] int stride() const { return components * width; }
  [[nodiscard]] kernels::LaneCount lane_count() const { return {count, width}; }

  std::vector<contact::Support> supports;
  std::vector<char>
      in_plane; ///< contact by contact: friction acts along x_loc too and something moves it along it
  kernels::GatherTable gather; ///< from modes to `stride()` lanes
  /// Modes that a contact moves, whole packs of `lanes`.
  struct Span {
    int first, size;
    bool operator==(const Span&) const = default;
  };
  std::vector<std::vector<Span>>
      spans; ///< contact by contact, ascending; all padded modes where the contact names none
  ReachLanes reach;
  std::vector<int> located;    ///< contacts whose gap the lanes of `reach` only bound: `locate` gives it
  std::vector<char> has_parts; ///< contact by contact: contact::ObstacleProperties::has_parts

  /// Position of a contact without displacement, m.
  [[nodiscard]] double rest_y(int c) const { return reach[c].rest_y[kernels::lane(c)]; }
  [[nodiscard]] double rest_z(int c) const { return reach[c].rest_z[kernels::lane(c)]; }
  std::vector<int>
      layout; ///< contact by contact: equal for contacts of the same spans that follow each other
  /// Row y, z or x of a contact over its spans, one after the other: over all padded modes where it names no modes.
  [[nodiscard]] const double* row(int contact, int component) const {
    const auto c = static_cast<std::size_t>(contact);
    return &rows_[row_begin_[c] + static_cast<std::size_t>(component) * row_size_[c]];
  }

private:
  void add_rows(const ContactPoint& point);
  void add_pack(int lane);

  std::vector<std::size_t> row_begin_, row_size_; ///< contact by contact
  kernels::Array rows_;                           ///< contact by contact: rows y, z, x
  bool apart_ = false;                            ///< rows are gathered one by one
};

} // namespace fretwork::transient
