// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// How far contacts are from their obstacles, all contacts in vector lanes. Arrays of a vector quantity have blocks of `width` lanes: y of
/// all contacts, then z.
#pragma once
#include "transient/contacts/lane_table.hpp"

namespace fretwork::transient::kernels {

/// Contacts by their contact::GapBound.
struct alignas(alignment) ReachNumbers {
  Numbers rest_y, rest_z; ///< m: position = displacement + rest
  Numbers wy, wz, radial, ly, lz, limit;
};
using ReachLanes = LaneTable<ReachNumbers>;

/// How contacts move, and where those near their obstacles are. Lanes of all contacts; the first two blocks of lanes, as above.
struct MotionLanes {
  explicit MotionLanes(const LaneCount& contacts, int blocks);
  Array u, w;                     ///< displacement, m, and velocity, m/s
  Array gaps, normal_y, normal_z; ///< m, and unit normal, of near contacts
  Array marks;                    ///< 1: near, or 0
  Places places;                  ///< in which some contact is near
};

/// Gap and its gradient, contact::locate of the obstacles whose gap bound is their gap, with e = (wy y, wz z)/r, r = sqrt(wy y^2 + wz z^2),
///     gap = limit - (radial r + ly y + lz z),   n = -(radial e + (ly, lz)).
/// For the others it is a lower bound. A contact is near where gap <= half_window |w|; without a window
/// velocities are not looked at. Normals are found in the places in which some contact is near, the others keep theirs.
extern const Kernel<void(const ReachLanes& reach, double half_window, MotionLanes& motion)> place_contacts;
/// The same of few contacts.
extern const Kernel<void(const ReachLanes& reach, double half_window, MotionLanes& motion)> place_few;

/// Whether no contact moves by more than its `limit` within `time` seconds at its speed `v`.
extern const Kernel<bool(const ReachLanes& reach, const LaneCount& contacts, const double* v, double time)>
    move_less;
} // namespace fretwork::transient::kernels
