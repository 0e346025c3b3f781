// SPDX-License-Identifier: GPL-3.0-or-later
#include "transient/sliding_paths.hpp"
#include <utility>

namespace fretwork::transient {

SlidingPaths::SlidingPaths(const PackedContacts& contacts, double step)
    : contacts_(contacts), scale_(step * step / 6.0) {
  push_.resize(static_cast<std::size_t>(contacts.count));
  pushed_.reserve(static_cast<std::size_t>(contacts.count));
}

void SlidingPaths::correct(ContactTrial& trial) {
  for (const int c : pushed_)
    if (!(trial.states[c].normal_force > 0.0))
      push_[c] = {};
  pushed_.assign(trial.active.begin(), trial.active.end());
  for (const int c : trial.active) {
    ContactState& s = trial.states[c];
    const Push now{s.normal_force * s.ny, s.normal_force * s.nz}, last = std::exchange(push_[c], now);
    if (!s.slides || (last.y == 0.0 && last.z == 0.0)) // it has only closed: no rate is known
      continue;
    const double y = scale_ * (now.y - last.y), z = scale_ * (now.z - last.z);
    const auto moved = [&](int to) {
      return contacts_.own_mobility(c, to, 0) * y + contacts_.own_mobility(c, to, 1) * z;
    };
    const contact::Vec2 along = contacts_.supports[c].friction.along;
    s.displacement.t -= along.t * (s.nz * moved(0) - s.ny * moved(1)); // t = (n_z, -n_y)
    if (contacts_.in_plane[c] != 0)
      s.displacement.x -= along.x * moved(2);
    if (trial.found_in_lanes)
      trial.lanes.displacement[c] = s.displacement.t;
  }
}

} // namespace fretwork::transient
