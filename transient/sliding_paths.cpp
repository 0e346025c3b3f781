// SPDX-License-Identifier: GPL-3.0-or-later
#include "transient/sliding_paths.hpp"
#include <algorithm>
#include <cmath>

namespace fretwork::transient {

using contact::Vec2;

namespace {

/// C_T W h: dampers that bring contacts to rest within a step or two. Weaker ones let springs end slides.
constexpr double least_damped = 1.0;

} // namespace

SlidingPaths::SlidingPaths(const PackedContacts& contacts, double step, bool moves_by_flow)
    : contacts_(contacts), h_(step) {
  const auto count = static_cast<std::size_t>(contacts.count);
  last_.resize(count);
  pushed_.reserve(count);
  ended_.reserve(count);
  for (int c = 0; c < contacts.count; ++c) {
    const contact::FrictionLaw& law = contacts.supports[c].friction;
    Own& own = own_.emplace_back();
    own.yy = contacts.own_mobility(c, 0, 0);
    own.yz = contacts.own_mobility(c, 0, 1);
    own.zz = contacts.own_mobility(c, 1, 1);
    const double most = own.yy + own.zz + (contacts.in_plane[c] != 0 ? contacts.own_mobility(c, 2, 2) : 0.0);
    own.ends = moves_by_flow && law.active() && law.kind == contact::FrictionMemoryKind::return_map &&
               law.damping * most * h_ >= least_damped;
    if (!own.ends)
      continue;
    own.per_damping = 1.0 / law.damping;
    own.least = least_damped / (law.damping * h_);
  }
}

/// @param speed  and `given`, the speed that the flow has given, along the slide, m/s   @param spring  N, along the slide, asked for last
template <class Spring>
void SlidingPaths::end_along(int c, const ContactState& s, double speed, double given, double mobility,
                             const Spring& spring) {
  const contact::FrictionLaw& law = contacts_.supports[c].friction;
  const double bound = law.mu_dynamic * s.normal_force, loss = bound * mobility * h_ - given,
               at_start = speed - 0.5 * given;
  if (!(at_start < loss + bound * own_[c].per_damping) || !(mobility >= own_[c].least))
    return; // it slides on
  const double hold = std::max(0.0, bound + spring()) * own_[c].per_damping;
  if (const contact::EndedSlide slide(at_start, hold, loss, h_); slide.ends)
    ended_.push_back({c, slide, s.damper_work});
}

void SlidingPaths::correct(const ContactMotion& motion, const ContactMemory& memory, ContactTrial& trial) {
  for (const int c : pushed_)
    if (!(trial.states[c].normal_force > 0.0))
      last_[c] = {};
  pushed_.assign(trial.active.begin(), trial.active.end());
  ended_.clear();
  const double scale = h_ * h_ / 6.0;
  for (const int c : trial.active) {
    ContactState& s = trial.states[c];
    const Own& own = own_[c];
    const double push_y = s.normal_force * s.ny, push_z = s.normal_force * s.nz;
    Last& last = last_[c];
    if (own.ends) {
      const bool goes_on = last.y * s.ny + last.z * s.nz > 0.0; // on the same face
      const Vec2 before = motion.slip(c, s.ny, s.nz);
      if (memory.slides(c)) {
        const Vec2 gained = goes_on ? before - last.left : Vec2{};
        if (contacts_.in_plane[c] != 0)
          find_end_in_plane(c, s, before, gained, memory);
        else
          find_end(c, s, before.t, gained.t, memory);
      }
      last.left = (2.0 / h_) * s.displacement - before;
    }
    const double y = scale * (push_y - last.y), z = scale * (push_z - last.z);
    const bool closes = last.y == 0.0 && last.z == 0.0; // no rate is known
    last.y = push_y;
    last.z = push_z;
    if (!s.slides || closes)
      continue;
    const Vec2 along = contacts_.supports[c].friction.along;
    s.displacement.t -= along.t * (s.nz * (own.yy * y + own.yz * z) - s.ny * (own.yz * y + own.zz * z));
    if (contacts_.in_plane[c] != 0)
      s.displacement.x -=
          along.x * (contacts_.own_mobility(c, 2, 0) * y + contacts_.own_mobility(c, 2, 1) * z);
    if (trial.found_in_lanes)
      trial.lanes.displacement[c] = s.displacement.t;
  }
}

void SlidingPaths::find_end(int c, const ContactState& s, double before, double gained,
                            const ContactMemory& memory) {
  const Own& own = own_[c];
  // t = (n_z, -n_y)
  const double mobility = s.nz * (s.nz * own.yy - 2.0 * s.ny * own.yz) + s.ny * s.ny * own.zz;
  const double sign = before < 0.0 ? -1.0 : 1.0;
  end_along(c, s, std::abs(before), sign * gained, mobility,
            [&] { return sign * memory.at(c, s.ny, s.nz).spring.t; });
}

void SlidingPaths::find_end_in_plane(int c, const ContactState& s, Vec2 before, Vec2 gained,
                                     const ContactMemory& memory) {
  const Own& own = own_[c];
  const double speed = norm(before);
  const Vec2 e = speed > 0.0 ? (1.0 / speed) * before : Vec2{0.0, 1.0};
  const double y = e.t * s.nz, z = -e.t * s.ny; // e along y and z
  const double mobility =
      y * y * own.yy + 2.0 * y * z * own.yz + z * z * own.zz +
      e.x * (e.x * contacts_.own_mobility(c, 2, 2) +
             2.0 * (y * contacts_.own_mobility(c, 2, 0) + z * contacts_.own_mobility(c, 2, 1)));
  end_along(c, s, speed, dot(e, gained), mobility, [&] { return dot(e, memory.at(c, s.ny, s.nz).spring); });
}

void SlidingPaths::end_slides(ContactTrial& trial, ContactLosses& losses) const {
  for (const auto& [c, slide, normal_loss] : ended_) {
    ContactState& s = trial.states[c];
    s.slid = slide.path;
    const double all = s.friction_work + s.damper_work - normal_loss, // by slider, spring and damper
        bound = contacts_.supports[c].friction.mu_dynamic * s.normal_force,
                 slider = std::min(bound * slide.slider, std::max(0.0, all)), more = slider - s.friction_work;
    s.friction_work += more;
    s.damper_work -= more;
    losses.friction += more;
    losses.damping -= more;
  }
}

} // namespace fretwork::transient
