// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// How far contacts are from their obstacles, all contacts in vector lanes. Arrays of a vector quantity have blocks of `width` lanes: y of
/// all contacts, then z.
#pragma once
#include "kernels/kernels.hpp"

namespace fretwork::transient {

/// Contacts by their contact::GapBound.
struct alignas(kernels::alignment) ReachNumbers {
  kernels::Numbers rest_y, rest_z; ///< m: position = displacement + rest
  kernels::Numbers wy, wz, radial, ly, lz, limit;
};
using ReachLanes = kernels::LaneTable<ReachNumbers>;

/// How contacts move, and where those near their obstacles are. Lanes of all contacts; the first two blocks of lanes, as above.
struct MotionLanes {
  explicit MotionLanes(const kernels::LaneCount& contacts, int blocks);
  kernels::Array u, w;                     ///< displacement, m, and velocity, m/s
  kernels::Array gaps, normal_y, normal_z; ///< m, and unit normal, of near contacts
  kernels::Array marks;                    ///< 1: near, or 0
  kernels::Places places;                  ///< in which some contact is near
};

/// Gap and its gradient, contact::locate of the obstacles whose gap bound is their gap, with e = (wy y, wz z)/r, r = sqrt(wy y^2 + wz z^2),
///     gap = limit - (radial r + ly y + lz z),   n = -(radial e + (ly, lz)).
/// For the others it is a lower bound. A contact is near where gap <= half_window |w|; without a window
/// velocities are not looked at. Normals are found in the places in which some contact is near, the others keep theirs.
extern const kernels::Kernel<void(const ReachLanes& reach, double half_window, MotionLanes& motion)>
    place_contacts;
/// The same of few contacts.
extern const kernels::Kernel<void(const ReachLanes& reach, double half_window, MotionLanes& motion)>
    place_few;

/// Whether no contact moves by more than its `limit` within `time` seconds at its speed `v`.
extern const kernels::Kernel<bool(const ReachLanes& reach, const kernels::LaneCount& contacts,
                                  const double* v, double time)>
    move_less;
} // namespace fretwork::transient
