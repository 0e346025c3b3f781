// SPDX-License-Identifier: GPL-3.0-or-later
/// The sweeps of FlexibleContacts: its contacts solved in turn.
#include "contact/instant_spring.hpp"
#include "transient/splitting/flexible_contacts.hpp"
#include <algorithm>
#include <cmath>

namespace fretwork::transient {
namespace {

/// Largest change of a sweep, relative to the largest force there is.
constexpr double sweep_tolerance = 1e-9;
/// Contacts beside each other share most of their flexibility (0.9 of it: a factor 0.8 a sweep): after some sweeps their forces are mixed.
constexpr int plain_sweeps = 4, most_sweeps = 300;
/// Sweeps in which normals turn, impacts may be taken for beginning or ending, and contacts that have slid may stick by the static coefficient again: what
/// all these do to the forces jumps.
constexpr int most_turns = 20;
/// Angle below which they do not: less than what the step leaves by some digits.
constexpr double turn_tolerance = 1e-7;
/// Share of a depth by which the gap falls, below which another part of a profile is nearest there.
constexpr double same_part = 1.0 - 1e-6;

} // namespace

/// Along y, z, x_loc.
Eigen::Vector3d FlexibleContacts::force(const ActiveContact& s) {
  return {s.axes.y(s.force[0], s.force[1]), s.axes.z(s.force[0], s.force[1]), s.force[2]};
}

/// Adds to the force on a contact; all velocities and displacements answer.
void FlexibleContacts::add_force(int from, const Eigen::Vector3d& by) {
  for (int l = 0; l < 3; ++l) {
    if (by(l) == 0.0)
      continue;
    const auto a = a_.col(3 * from + l), r = r_.col(3 * from + l);
    for (std::size_t i = 0; i < active_.size(); ++i)
      for (std::size_t k = 0; k < 3; ++k) {
        const Eigen::Index row = 3 * active_[i].contact + static_cast<Eigen::Index>(k);
        speed_[3 * i + k] += a(row) * by(l);
        active_deflection_[3 * i + k] += r(row) * by(l);
      }
  }
}

void FlexibleContacts::change(std::size_t i, int component, double by) {
  if (by == 0.0)
    return;
  ActiveContact& s = active_[i];
  s.force[component] += by;
  add_force(s.contact, component == 0   ? Eigen::Vector3d(s.axes.y(by, 0.0), s.axes.z(by, 0.0), 0.0)
                       : component == 1 ? Eigen::Vector3d(s.axes.y(0.0, by), s.axes.z(0.0, by), 0.0)
                                        : Eigen::Vector3d(0.0, 0.0, by));
}

/// A component along n, t, x_loc of what `speed_` or `active_deflection_` hold.
double FlexibleContacts::component(const std::vector<double>& of, std::size_t i, int k) const {
  const ActiveContact& s = active_[i];
  const double y = of[3 * i], z = of[3 * i + 1];
  return k == 0 ? s.axes.normal(y, z) : k == 1 ? s.axes.tangent(y, z) : of[3 * i + 2];
}

bool FlexibleContacts::sweep(const ContactMemory* memory, ContactMotion& motion) {
  mixing_.restart(static_cast<Eigen::Index>(3 * active_.size()));
  for (int k = 0; k < most_sweeps; ++k) {
    double changed = 0.0, largest = 0.0;
    for (std::size_t i = 0; i < active_.size(); ++i) {
      if (k < most_turns)
        changed = std::max(changed, turn_normal(i, motion));
      changed = std::max(changed, solve_contact(i, memory, k >= most_turns));
      largest = std::max(largest, active_[i].force[0]);
    }
    if (changed <= sweep_tolerance * largest)
      return true;
    take_forces(k < plain_sweeps ? mixed_ : swept_);
    if (k < plain_sweeps)
      continue;
    mixing_.next(mixed_, swept_);
    set_forces(mixed_);
  }
  return false;
}

void FlexibleContacts::take_forces(Eigen::VectorXd& to) const {
  for (std::size_t i = 0; i < active_.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k)
      to(static_cast<Eigen::Index>(3 * i + k)) = active_[i].force[k];
}

/// Contacts pull in no combination of forces.
void FlexibleContacts::set_forces(const Eigen::VectorXd& forces) {
  for (std::size_t i = 0; i < active_.size(); ++i) {
    const auto first = static_cast<Eigen::Index>(3 * i);
    const bool presses = forces(first) > 0.0;
    for (int k = 0; k < 3; ++k)
      change(i, k, (presses ? forces(first + k) : 0.0) - active_[i].force[k]);
  }
}

/// p' at the instant of the action.
double FlexibleContacts::normal_rate(std::size_t i) const {
  const ActiveContact& s = active_[i];
  return -(component(speed_, i, 0) + rate_.now * component(active_deflection_, i, 0) +
           rate_.last * s.last[0] + rate_.before * s.before[0]);
}

/// One contact solved with all others held. Returns the largest change of its forces, N.
double FlexibleContacts::solve_contact(std::size_t i, const ContactMemory* memory, bool holds) {
  ActiveContact& s = active_[i];
  const double own = s.residual(0, 0), mobility = s.mobility(0, 0) + rate_.now * own;
  const double p0 = s.modal_penetration - (component(active_deflection_, i, 0) - own * s.force[0]);
  if (!holds)
    find_instant(s, p0);
  s.alone = std::max(0.0, p0 + s.instant_more);
  const double normal =
      s.acts()
          ? contact::series_force(s.normal, s.alone, normal_rate(i) + mobility * s.force[0], mobility, own)
          : 0.0;
  double changed = std::abs(normal - s.force[0]);
  change(i, 0, normal - s.force[0]);
  if (!s.friction || !memory)
    return changed;
  const contact::Friction found = normal > 0.0 ? friction(i, *memory) : contact::Friction{{}, false};
  s.slides = found.slides;
  s.has_slid = s.has_slid || (holds && found.slides);
  const double by_t = found.force.t - s.force[1], by_x = found.force.x - s.force[2];
  change(i, 1, by_t);
  change(i, 2, by_x);
  return std::max({changed, std::abs(by_t), std::abs(by_x)});
}

contact::Friction FlexibleContacts::friction(std::size_t i, const ContactMemory& memory) const {
  const ActiveContact& s = active_[i];
  constexpr int t = 1, x = 2;
  const auto mobility = [&](int row, int column) {
    return s.mobility(row, column) + s.rate.now * s.residual(row, column);
  };
  const auto velocity = [&](int k) {
    return component(speed_, i, k) + s.rate.now * component(active_deflection_, i, k) +
           s.rate.last * s.last[k] + s.rate.before * s.before[k];
  };
  const contact::FrictionLaw& law = contacts_.supports[s.contact].friction;
  const auto& table = memory.table(s.contact);
  auto past = memory.friction().at(s.contact, s.axes);
  past.sliding = past.sliding || s.has_slid;
  const double tt = mobility(t, t);
  if (!s.in_plane)
    return contact::step_friction_line(law, table, past, s.force[0], velocity(t) - tt * s.force[1], tt);
  const double xx = mobility(x, x), xt = mobility(x, t);
  const contact::Vec2 free{velocity(x) - xx * s.force[2] - xt * s.force[1],
                           velocity(t) - xt * s.force[2] - tt * s.force[1]};
  return contact::step_friction_plane(law, table, past, s.force[0], free, {xx, xt, tt});
}

/// What the spring of a contact, in series with its residual flexibility, bears at an instant for a whole step: contact::InstantSpring.
void FlexibleContacts::find_instant(ActiveContact& s, double p0) const {
  s.instant_share = 1.0;
  s.instant_more = 0.0;
  if (static_ || !(p0 > 0.0))
    return;
  const double flexibility = 1.0 / s.normal.stiffness + s.residual(0, 0);
  const auto push =
      contact::InstantSpring(1.0 / flexibility, s.mobility(0, 0), h_).push(p0, s.mean_rate, -s.velocity[0]);
  s.instant_share = push.instant / push.force;
  s.instant_more = flexibility * push.force - p0;
}

/// Turns a contact to the normal of where it stands. Returns the change of its force, N.
double FlexibleContacts::turn_normal(std::size_t i, ContactMotion& motion) {
  ActiveContact& s = active_[i];
  const int y = s.contact, z = y + contacts_.width;
  const auto locate = [&](double depth, const contact::ContactAxes& axes) {
    motion.u[y] = modal_u_[y] + active_deflection_[3 * i] - axes.y(depth, 0.0);
    motion.u[z] = modal_u_[z] + active_deflection_[3 * i + 1] - axes.z(depth, 0.0);
    return motion.locate(s.contact);
  };
  double depth = s.compliance * s.force[0];
  if (contacts_.has_parts[s.contact]) {
    const auto here = locate(0.0, {});
    if (here.gap - locate(depth, here.axes()).gap < same_part * depth)
      depth = 0.0;
  }
  const auto at = locate(depth, s.axes);
  const double by_y = active_deflection_[3 * i] - s.axes.y(depth, 0.0),
               by_z = active_deflection_[3 * i + 1] - s.axes.z(depth, 0.0);
  const double turned = std::hypot(at.ny - s.axes.ny, at.nz - s.axes.nz);
  if (turned > turn_tolerance) {
    const Eigen::Vector3d before = force(s);
    s.axes = at.axes();
    rotate_axes(s, motion);
    add_force(s.contact, force(s) - before);
  }
  s.modal_penetration = -at.gap + s.axes.normal(by_y, by_z);
  return turned > turn_tolerance ? turned * s.force[0] : 0.0;
}

} // namespace fretwork::transient
