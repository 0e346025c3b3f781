// SPDX-License-Identifier: GPL-3.0-or-later
#include "transient/contact_motion.hpp"

namespace fretwork::transient {

ContactMotion::ContactMotion(const PackedContacts& contacts)
    : contacts_(contacts), places_(contacts.lane_count()), moving_(contacts.lane_count()) {
  u.assign(static_cast<std::size_t>(contacts.stride()), 0.0);
  w = u;
  for (kernels::Array* a : {&near_, &gaps, &normal_y, &normal_z})
    a->assign(static_cast<std::size_t>(contacts.width), 0.0);
}

void ContactMotion::gather(const double* q, const double* v) {
  kernels::gather_two(contacts_.gather, q, v, u.data(), w.data());
}

void ContactMotion::gather_near(const double* q, const double* v, const std::vector<int>& closed) {
  kernels::gather(contacts_.gather, q, u.data());
  find_near(0.0);
  const int together = places_.all.together();
  moving_.first.clear();
  auto place = places_.first.begin();
  for (const int c : closed) {
    for (; place != places_.first.end() && *place < c - c % together; ++place)
      moving_.add_contact(*place);
    moving_.add_contact(c);
  }
  for (; place != places_.first.end(); ++place)
    moving_.add_contact(*place);
  kernels::gather_at(contacts_.gather, moving_, v, w.data());
}

void ContactMotion::gather_velocities(const double* v) { kernels::gather(contacts_.gather, v, w.data()); }

bool ContactMotion::find_near(double half_window) {
  kernels::place_contacts(contacts_.reach, u.data(), w.data(), half_window, gaps.data(), normal_y.data(),
                          normal_z.data(), near_.data(), places_);
  const bool any = !places_.first.empty();
  if (any)
    for (const int c : contacts_.profiles)
      if (near(c)) {
        const auto at = locate(c);
        gaps[c] = at.gap;
        normal_y[c] = at.ny;
        normal_z[c] = at.nz;
      }
  return any;
}

bool ContactMotion::moves_less(double time, double share) const {
  return kernels::move_less(contacts_.reach, places_.all, w.data(), time / share);
}

bool ContactMotion::opens_after(double time) const {
  return kernels::open_after(contacts_.reach, places_.all, u.data(), w.data(), time);
}

double ContactMotion::spring_energy() const {
  double sum = 0.0;
  for (int c = 0; c < contacts_.count; ++c)
    if (const double gap = locate(c).gap; gap < 0.0)
      sum += 0.5 * contacts_.supports[c].normal.stiffness * gap * gap;
  return sum;
}

} // namespace fretwork::transient
