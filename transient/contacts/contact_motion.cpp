// SPDX-License-Identifier: GPL-3.0-or-later
#include "transient/contacts/contact_motion.hpp"

namespace fretwork::transient {

ContactMotion::ContactMotion(const PackedContacts& contacts)
    : MotionLanes(contacts.lane_count(), contacts.components), contacts_(contacts) {}

void ContactMotion::gather(const double* q, const double* v) {
  kernels::gather_two(contacts_.gather, q, v, u.data(), w.data());
}

void ContactMotion::locate_bounded() {
  for (const int c : contacts_.located)
    if (near(c)) {
      const auto at = locate(c);
      gaps[c] = at.gap;
      normal_y[c] = at.ny;
      normal_z[c] = at.nz;
    }
}

bool ContactMotion::moves_less(double time, double share) const {
  return move_less(contacts_.reach, places.all, w.data(), time / share);
}

double ContactMotion::spring_energy() const {
  double sum = 0.0;
  for (int c = 0; c < contacts_.count; ++c)
    sum += contacts_.supports[c].normal.spring_energy(-locate(c).gap);
  return sum;
}

} // namespace fretwork::transient
