// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Where all contacts are and how they move at one instant: the first stage of an evaluation.
#pragma once
#include "core/state_archive.hpp"
#include "transient/contacts/packed_contacts.hpp"

namespace fretwork::transient {

/// Kinematics of the contacts of a scene. Normals are those of contact::Location; the tangent directions are x_loc and t = n x x_loc,
/// and what a friction law bars (FrictionLaw::along) counts as no motion.
class ContactMotion : public MotionLanes {
public:
  /// @param contacts  must live longer
  explicit ContactMotion(const PackedContacts& contacts);

  /// Displacements and velocities of all contacts from those of the modes (padded arrays). No allocation.
  void gather(const double* q, const double* v);
  /// Marks the contacts that may have penetration > 0 now, or within `half_window` seconds at their present speed (>= 0), and finds
  /// `gaps`, `normal_y` and `normal_z` of these. Returns whether there is any.
  bool find_near(double half_window) {
    (places.all.few() ? place_few : place_contacts)(contacts_.reach, half_window, *this);
    return any_near();
  }
  /// Whether no contact moves by more than `share` of its clearance within `time` seconds at its present speed.
  [[nodiscard]] bool moves_less(double time, double share) const;
  [[nodiscard]] bool near(int c) const { return marks[c] != 0.0; }

  [[nodiscard]] contact::Location locate(int c) const {
    return contact::locate(contacts_.supports[c].obstacle, u[c] + contacts_.rest_y(c),
                           u[contacts_.width + c] + contacts_.rest_z(c));
  }
  /// Rate of the penetration along these axes, m/s.
  [[nodiscard]] double penetration_rate(int c, const contact::ContactAxes& axes) const {
    return -axes.normal(w[c], w[contacts_.width + c]);
  }
  /// Tangential velocity, m/s.
  [[nodiscard]] contact::Vec2 slip(int c, const contact::ContactAxes& axes) const {
    return tangential(c, axes, w);
  }
  /// Tangential part of any vector given in lanes.
  [[nodiscard]] contact::Vec2 tangential(int c, const contact::ContactAxes& axes,
                                         const kernels::Array& lanes) const {
    const contact::Vec2 along = contacts_.supports[c].friction.along;
    const int width = contacts_.width;
    return {contacts_.in_plane[c] ? along.x * lanes[2 * width + c] : 0.0,
            along.t * axes.tangent(lanes[c], lanes[width + c])};
  }
  /// Energy of the normal springs, J.
  [[nodiscard]] double spring_energy() const;
  void visit(core::StateArchive& state) {
    state(u, w, gaps, normal_y, normal_z, marks, places.first, places.near);
  }

private:
  bool any_near() {
    if (places.first.empty())
      return false;
    if (!contacts_.located.empty())
      locate_bounded();
    return true;
  }
  void locate_bounded();

  const PackedContacts& contacts_;
};

} // namespace fretwork::transient
