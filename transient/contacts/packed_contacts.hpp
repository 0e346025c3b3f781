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
  explicit PackedContacts(const std::vector<ContactPoint>& contacts, Eigen::Index modes);

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
  kernels::Array rows;         ///< contact by contact: rows y, z, x over the padded modes
  kernels::Array mobility; ///< contact by contact: what a unit force along y, z, x does to `stride()` lanes
                           ///< (W = B B^T, 1/kg)
  kernels::ReachLanes reach;
  std::vector<int> located;    ///< contacts whose gap the lanes of `reach` only bound: `locate` gives it
  std::vector<char> has_parts; ///< contact by contact: contact::ObstacleProperties::has_parts

  /// Position of a contact without displacement, m.
  [[nodiscard]] double rest_y(int c) const { return reach[c].rest_y[kernels::lane(c)]; }
  [[nodiscard]] double rest_z(int c) const { return reach[c].rest_z[kernels::lane(c)]; }
  [[nodiscard]] const double* row(int contact, int component) const {
    return &rows[(static_cast<std::size_t>(contact) * 3 + component) * padded_modes];
  }
  /// The 3 columns of contact `c`, `stride()` apart (the third is there with 2 components too, unused).
  [[nodiscard]] const double* column(int c) const {
    return &mobility[static_cast<std::size_t>(c) * 3 * stride()];
  }
  /// Velocity along component `to` of contact `c` by a unit force along `from` of the same contact, 1/kg.
  [[nodiscard]] double own_mobility(int c, int to, int from) const {
    return to < components && from < components ? column(c)[from * stride() + to * width + c] : 0.0;
  }
};

} // namespace fretwork::transient
