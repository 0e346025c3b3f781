// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The directions of a contact across x_loc: the normal n = (ny, nz) of the obstacle's surface, towards the tube, and the tangent
/// t = n x x_loc = (nz, -ny). Components along y, z become components along n, t, and back.
#pragma once

namespace fretwork::contact {

struct ContactAxes {
  double ny = 0.0, nz = 0.0; ///< of length 1; both 0: none

  /// Components along n and t of a vector along y, z.
  [[nodiscard]] constexpr double normal(double y, double z) const { return ny * y + nz * z; }
  [[nodiscard]] constexpr double tangent(double y, double z) const { return nz * y - ny * z; }
  /// Components along y and z of a vector along n, t.
  [[nodiscard]] constexpr double y(double normal, double tangent) const { return normal * ny + tangent * nz; }
  [[nodiscard]] constexpr double z(double normal, double tangent) const { return normal * nz - tangent * ny; }
  /// Whether the other normal is that of the opposite face: another surface.
  [[nodiscard]] constexpr bool opposite(const ContactAxes& other) const {
    return ny * other.ny + nz * other.nz < 0.0;
  }
};

} // namespace fretwork::contact
