// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// How far contacts are from their obstacles, all contacts in vector lanes. Arrays of a vector quantity have blocks of `width` lanes: y of
/// all contacts, then z.
#pragma once
#include "transient/kernels.hpp"

namespace fretwork::transient::kernels {

/// Contacts by their contact::Reach.
struct ReachLanes {
  Array rest_y, rest_z; ///< m: position = displacement + rest
  Array wy, wz, radial, ly, lz, limit;
};

/// Gap and its gradient: contact::locate of every obstacle that is one formula, with e = (wy y, wz z)/r, r = sqrt(wy y^2 + wz z^2),
///     gap = limit - (radial r + ly y + lz z),   n = -(radial e + (ly, lz)).
/// For a profile it is a lower bound of the gap (its inscribed circle). near[i] = 1 where gap <= half_window |v|, else 0; without a window
/// velocities are not looked at. Normals are found in the `places` in which some contact is near, the others keep theirs.
extern const Kernel<void(const ReachLanes& reach, const double* u, const double* v, double half_window,
                         double* gap, double* ny, double* nz, double* near, Places& places)>
    place_contacts;

/// Whether no contact moves by more than its `limit` within `time` seconds at its speed `v`.
extern const Kernel<bool(const ReachLanes& reach, const LaneCount& contacts, const double* v, double time)>
    move_less;
/// Whether all gaps are > 0 after `time` seconds (of either sign) at the speeds `v`.
extern const Kernel<bool(const ReachLanes& reach, const LaneCount& contacts, const double* u, const double* v,
                         double time)>
    open_after;

} // namespace fretwork::transient::kernels
