// SPDX-License-Identifier: GPL-3.0-or-later
#include "transient/sliding_paths.hpp"
#include <algorithm>
#include <cmath>

namespace fretwork::transient {

using contact::Vec2;

namespace {

/// C_T W h: dampers that bring contacts to rest within a step or two. Weaker ones let springs end slides.
constexpr double least_damped = 1.0;
/// Steps since a contact that has closed touched, at its speed before the action: 1 in free flight.
constexpr double since_touch = 1.05;

} // namespace

SlidingPaths::SlidingPaths(const PackedContacts& contacts, double step, bool moves_by_flow)
    : contacts_(contacts), h_(step) {
  const auto count = static_cast<std::size_t>(contacts.count);
  last_.resize(count);
  ended_.reserve(count);
  for (int c = 0; c < contacts.count; ++c) {
    const contact::FrictionLaw& law = contacts.supports[c].friction;
    Own& own = own_.emplace_back();
    own.yy = contacts.own_mobility(c, 0, 0);
    own.yz = contacts.own_mobility(c, 0, 1);
    own.zz = contacts.own_mobility(c, 1, 1);
    const double most = own.yy + own.zz + (contacts.in_plane[c] != 0 ? contacts.own_mobility(c, 2, 2) : 0.0);
    own.ends = moves_by_flow && law.mu_dynamic > 0.0 && law.kind == contact::FrictionMemoryKind::return_map &&
               law.damping * most * h_ >= least_damped;
    own.per_damping = own.ends ? 1.0 / law.damping : 0.0;
  }
}

void SlidingPaths::correct(const ContactMotion& motion, const ContactMemory& memory, ContactTrial& trial) {
  ended_.clear();
  for (const int c : memory.closed())
    if (!(trial.states[c].normal_force > 0.0))
      last_[c] = {};
  const double scale = h_ * h_ / 6.0;
  for (const int c : trial.active) {
    ContactState& s = trial.states[c];
    const Own& own = own_[c];
    kernels::NormalPush& push = last_[c].push;
    const kernels::NormalPush now{s.normal_force * s.ny, s.normal_force * s.nz};
    const double y = scale * (now.y - push.y), z = scale * (now.z - push.z);
    const bool closes = push.y == 0.0 && push.z == 0.0; // no rate is known
    if (own.ends)
      find_ends(c, closes, {memory.at(c, s.ny, s.nz), (1.0 / h_) * s.displacement, s.damper_work}, s, motion);
    push = now;
    if (!s.slides || closes)
      continue;
    const Vec2 along = contacts_.supports[c].friction.along;
    s.displacement.t -= along.t * (s.nz * (own.yy * y + own.yz * z) - s.ny * (own.yz * y + own.zz * z));
    if (contacts_.in_plane[c] != 0)
      s.displacement.x -=
          along.x * (contacts_.own_mobility(c, 2, 0) * y + contacts_.own_mobility(c, 2, 1) * z);
    if (trial.found_in_lanes)
      trial.lanes[c].displacement[kernels::lane(c)] = s.displacement.t;
  }
}

void SlidingPaths::end_alone(int c, bool closes, const kernels::LoneStep& step, const ContactMotion& motion,
                             const ContactState& s) {
  ended_.clear();
  if (!(s.normal_force > 0.0))
    last_[c] = {};
  else if (own_[c].ends)
    find_ends(c, closes, {{{0.0, step.held}, step.slid}, {0.0, step.mean_slip}, step.normal_damping}, s,
              motion);
}

void SlidingPaths::find_ends(int c, bool closes, const Before& past, const ContactState& s,
                             const ContactMotion& motion) {
  Last& last = last_[c];
  const Vec2 before = motion.slip(c, s.ny, s.nz), after = 2.0 * past.mean_slip - before;
  if (past.memory.sliding)
    find_end(c, s, {last.left, before, after}, past);
  last.left = after;
  if (closes)
    find_begun(c, s, motion, past);
}

void SlidingPaths::find_end(int c, const ContactState& s, const Speeds& speeds, const Before& past) {
  if (contacts_.in_plane[c] == 0 && !ends_along_line(c, s, speeds, past.memory.spring.t))
    return;
  const contact::FrictionLaw& law = contacts_.supports[c].friction;
  const auto [left, before, after] = speeds;
  const double per_damping = own_[c].per_damping, bound = law.mu_dynamic * s.normal_force;
  const Vec2 speed = 0.5 * (left + before), held = per_damping * past.memory.spring, trial = held - speed;
  const double size = norm(trial);
  const Vec2 along = size > 0.0 ? (1.0 / size) * trial : Vec2{}; // of the friction when the step begins
  const contact::Mobility mobility = tangent_mobility(c, s.ny, s.nz);
  if (!(law.damping * dot(along, mobility * along) * h_ >= least_damped))
    return;
  if (s.slides && dot(along, s.friction) < 0.0) // back again within the step, a path of its own
    return;
  const Vec2 missing = bound * along - s.friction, loss = left - after - h_ * (mobility * missing);
  const contact::EndedSlide slide(speed, held, per_damping * bound, loss, h_);
  if (slide.ends)
    ended_.push_back({c, slide.path, s.normal_force * slide.path, bound * slide.slider, past.normal_loss});
}

void SlidingPaths::find_begun(int c, const ContactState& s, const ContactMotion& motion, const Before& past) {
  const contact::Support& support = contacts_.supports[c];
  const double depth = -motion.gaps[c];
  const Vec2 held = own_[c].per_damping * past.memory.spring, excess = motion.slip(c, s.ny, s.nz) - held;
  const double speed2 = dot(excess, excess);
  // touched since the last action, so that the force grows from nothing: no normal damper, nor pressed before
  if (support.normal.damps() || !(depth > 0.0 && depth < since_touch * h_ * s.approach && speed2 > 0.0))
    return;
  const contact::FrictionLaw& law = support.friction;
  const double growth = support.normal.stiffness * s.approach,
               mobility = dot(excess, tangent_mobility(c, s.ny, s.nz) * excess) / speed2;
  if (!(law.damping * mobility * h_ >= least_damped))
    return;
  // most go on after what this action stands for, from the touch to half a step after the action
  const double rest = depth / s.approach + 0.5 * h_,
               ends_from =
                   law.mu_dynamic * growth * rest * (own_[c].per_damping + 0.5 * mobility * rest); // m/s
  if (s.slides && speed2 > ends_from * ends_from)
    return;
  const contact::BegunSlide slide(std::sqrt(speed2), growth, law.mu_dynamic, law.damping, mobility);
  ended_.push_back({c, slide.path, slide.pressed_path, slide.slider_work, past.normal_loss});
}

/// What `find_end` and EndedSlide find along one tangent, without roots and divisions: most slides go on.
bool SlidingPaths::ends_along_line(int c, const ContactState& s, const Speeds& speeds, double spring) const {
  const Own& own = own_[c];
  const double bound = contacts_.supports[c].friction.mu_dynamic * s.normal_force,
               spread = bound * own.per_damping;
  const double trial = spring * own.per_damping - 0.5 * (speeds.left.t + speeds.before.t),
               excess = std::abs(trial), sign = trial < 0.0 ? -1.0 : 1.0;
  const double loss = speeds.left.t - speeds.after.t -
                      h_ * tangent_mobility(c, s.ny, s.nz).tt * (sign * bound - s.friction.t);
  return excess > spread && excess < spread - sign * loss;
}

/// Of the contact itself, where friction acts; t = (n_z, -n_y).
contact::Mobility SlidingPaths::tangent_mobility(int c, double ny, double nz) const {
  const Own& own = own_[c];
  const Vec2 along = contacts_.supports[c].friction.along;
  contact::Mobility out;
  out.tt = along.t * (nz * nz * own.yy - 2.0 * nz * ny * own.yz + ny * ny * own.zz);
  if (contacts_.in_plane[c] != 0) {
    out.xx = along.x * contacts_.own_mobility(c, 2, 2);
    out.xt =
        along.x * along.t * (nz * contacts_.own_mobility(c, 2, 0) - ny * contacts_.own_mobility(c, 2, 1));
  }
  return out;
}

void SlidingPaths::end_slides(ContactTrial& trial, ContactLosses& losses) const {
  for (const auto& [c, path, pressed_path, work, normal_loss] : ended_) {
    ContactState& s = trial.states[c];
    s.slid = path;
    s.pressing_share = path > 0.0 ? pressed_path / (s.normal_force * path) : 1.0;
    const double all = s.friction_work + s.damper_work - normal_loss, // by slider, spring and damper
        slider = std::min(work, std::max(0.0, all)), more = slider - s.friction_work;
    s.friction_work += more;
    s.damper_work -= more;
    losses.friction += more;
    losses.damping -= more;
  }
}

} // namespace fretwork::transient
