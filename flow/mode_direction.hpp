// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Along which direction each mode moves a tube across its axis.
///
/// Share of mode i along a unit vector e: S_i(e) = int m (phi_n . e)^2 ds / int m |phi_n|^2 ds, phi_n the shape across the tube.
/// Tube in a plane of normal n: out of plane S(n), in plane 1 - S(n). Any other tube (straight, or curved in space): the global axis of the largest
/// share. A tube is straight, or in a plane, where its places deviate from a line, or a plane, by less than 1e-3 of their spread (rms).
/// Limits: modes of equal frequency have arbitrary directions; so have those of a straight tube along no global axis.
#pragma once
#include "flow/sampling.hpp"
#include <string>

namespace fretwork::flow {

struct ModeDirection {
  enum class Kind { none, in_plane, out_of_plane, x, y, z }; ///< none: it does not move this tube across
  Kind kind = Kind::none;
  double share = 0.0; ///< of the mass-weighted mean square of the motion across the tube, 0 of none
};

/// One for each mode.
[[nodiscard]] std::vector<ModeDirection> mode_directions(const Sampling& sampling);

/// "in_plane", "out_of_plane", "x", "y", "z"; null of none.
[[nodiscard]] const char* key_of(ModeDirection::Kind kind);
/// For tables: "out of plane", "in plane", "y"; below a share of 95 % as "71% out", "80% in", "71% y"; "-" of none. At most 12 characters.
[[nodiscard]] std::string short_text(const ModeDirection& direction);

} // namespace fretwork::flow
