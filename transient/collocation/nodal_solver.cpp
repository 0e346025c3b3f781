// SPDX-License-Identifier: GPL-3.0-or-later
#include "transient/collocation/nodal_solver.hpp"
#include <algorithm>
#include <cmath>

namespace fretwork::transient {
namespace {

using namespace kernels;

/// Sweeps stop when what is still to come is below this share of the force: far below what a step leaves at its finest.
constexpr double sweep_tolerance = 1e-10;
/// What is still to come is at least this share of the last change: the first change of a step falls by 1e-5, what that leaves by 5e-3 (in 60
/// random scenes the ratio of two changes alone stopped up to 1e-6 of the force short, this never more than 1e-9).
constexpr double slowest_end = 0.03;
/// Sweeps after which changes are halved, and after which a step has failed.
constexpr int patient = 20, most_sweeps = 60;
/// The tolerance of a step with contacts that change inside it: their paths are told within 8e-4 of the force (inner_path_test.cpp).
constexpr double kink_tolerance = 1e-7;
/// The tolerance of the motion along which the paths inside a step are followed.
constexpr double path_tolerance = 1e-2;
/// Times that the paths inside a step are followed: a third time changes next to nothing, and without the second errors below 1e-4 grow.
constexpr int paths = 2;

/// Bound of contact::GapBound: false where the node is surely out of its obstacle.
bool may_touch(const ReachLanes& reach, int c, double y, double z) {
  const ReachNumbers& r = reach[c];
  const int l = kernels::lane(c);
  y += r.rest_y[l];
  z += r.rest_z[l];
  const double left = r.limit[l] - r.ly[l] * y - r.lz[l] * z, across = r.wy[l] * y * y + r.wz[l] * z * z;
  const double radial = r.radial[l];
  return radial > 0.0 ? left <= 0.0 || radial * radial * across >= left * left
                      : left <= radial * std::sqrt(across);
}

} // namespace

NodalSolver::NodalSolver(const PackedContacts& contacts) : contacts_(contacts) {
  const auto count = static_cast<std::size_t>(contacts.count);
  swept_.reserve(count);
  for (int c = 0; c < contacts.count; ++c)
    swept_.emplace_back(contacts, c);
  active_.reserve(count);
  alive_.reserve(count);
  row_.reserve(3 * count);
  factor_.reserve(3 * count);
}

void NodalSolver::start(NodalMotion& motion) {
  for (SweptContact& swept : swept_) {
    meet_start(swept, motion);
    const contact::Support& support = *swept.support;
    ContactNode& node = swept.node[0];
    node.normal = contact::normal_force(support.normal, node.penetration, node.rate);
    node.approach = node.rate;
    if (node.penetration > 0.0 || node.normal > 0.0)
      alive_.push_back(swept.contact);
    if (!(node.normal > 0.0))
      continue;
    node.face = node.axes;
    if (!support.friction.active())
      continue;
    const auto friction = swept.in_plane
                              ? contact::evaluate(support.friction, {}, node.normal, {}, node.slip)
                              : contact::evaluate_line(support.friction, {}, node.normal, 0.0, node.slip.t);
    node.friction = friction.force;
    node.slides = friction.slides;
  }
}

bool NodalSolver::solve(const NodalTables& tables, NodalMotion& motion) {
  for (SweptContact* swept : active_)
    swept->takes_part = false;
  active_.clear();
  inner_paths_ = false;
  (void)admit(tables, motion);
  changes_ = {};
  bool solved = settle_all(tables, motion, path_tolerance);
  for (int i = 0; i < paths && solved && follow_paths(motion); ++i) {
    changes_ = {};
    if (i + 1 < paths)
      solved = settle_all(tables, motion, path_tolerance);
  }
  solved = solved && settle_all(tables, motion, inner_paths_ ? kink_tolerance : sweep_tolerance);
  if (solved)
    finish(tables, motion);
  return solved;
}

/// With the contacts that are met on the way.
bool NodalSolver::settle_all(const NodalTables& tables, NodalMotion& motion, double tolerance) {
  while (settle(motion, tolerance)) {
    if (!admit(tables, motion))
      return true;
    changes_ = {};
  }
  return false;
}

/// Finds what the paths of contacts inside the step add to their forces. Returns whether there is any.
bool NodalSolver::follow_paths(NodalMotion& motion) {
  bool any = false;
  for (SweptContact* swept : active_) {
    swept->has_path = swept->has_path || changes_inside(*swept->support, swept->springs(), swept->node);
    if (!swept->has_path)
      continue;
    any = true;
    follow_path(*swept, motion);
  }
  for (const SweptContact* swept : active_) // when all paths are known, whatever their order
    if (swept->has_path)
      add_response(*swept, swept->path_change, motion);
  inner_paths_ = inner_paths_ || any;
  return any;
}

/// Takes in the contacts that penetrate and do not take part yet. Returns whether there are any.
bool NodalSolver::admit(const NodalTables& tables, NodalMotion& motion) {
  const std::size_t before = active_.size();
  const double *u1 = motion.u(1), *u2 = motion.u(2);
  for (SweptContact& swept : swept_) {
    const int c = swept.contact;
    ContactNode* node = swept.node;
    const bool was_closed = node[0].normal > 0.0;
    if (swept.takes_part || !(was_closed || may_touch(contacts_.reach, c, u1[swept.y], u1[swept.z]) ||
                              may_touch(contacts_.reach, c, u2[swept.y], u2[swept.z])))
      continue;
    meet_ends(swept, motion);
    if (!(was_closed || node[1].penetration >= 0.0 || node[2].penetration >= 0.0))
      continue;
    swept.join(tables);
    active_.push_back(&swept);
    if (!was_closed) {
      meet_start(swept, motion);
      continue;
    }
    for (auto& force : swept.force) // as at the start of the step
      std::ranges::copy(force_of_laws(node[0]), force);
    add_response(swept, swept.force, motion);
  }
  return active_.size() > before;
}

/// From where the sweeps of a looser tolerance have stopped.
bool NodalSolver::settle(NodalMotion& motion, double tolerance) {
  for (int k = 0; k < most_sweeps; ++k) {
    if (changes_.within(tolerance))
      return true;
    double largest = 0.0;
    for (SweptContact* swept : active_) {
      const double change = improve(*swept, motion, k < patient ? 1.0 : 0.5);
      if (!std::isfinite(change))
        return false;
      largest = std::max(largest, change);
    }
    changes_ = {true, largest, changes_.largest};
  }
  return changes_.within(tolerance);
}

bool NodalSolver::Changes::within(double tolerance) const {
  if (!known)
    return false;
  // the first changes fall faster than the last ones
  const double ratio = std::max(slowest_end, largest / (last - largest));
  return largest <= tolerance || (largest <= falling * last && largest * ratio <= tolerance);
}

/// The laws at the motion found, and the springs of the contacts that are open.
void NodalSolver::finish(const NodalTables& tables, NodalMotion& motion) {
  alive_.clear();
  for (SweptContact* swept : active_)
    evaluate(*swept, motion);
  for (SweptContact& swept : swept_) {
    ContactNode* node = swept.node;
    if (!swept.takes_part) {
      if (!(contact::dot(node[0].spring, node[0].spring) > 0.0))
        continue;
      leave(swept, tables);
    } else {
      for (int j = 1; j <= 2; ++j)
        node[j].loaded = node[j].normal > 0.0 ? contact::norm(node[j].spring) : node[j - 1].loaded;
    }
    for (int j = 1; j <= 2; ++j)
      node[j].approach = node[j - 1].normal > 0.0 ? node[j].rate : node[j - 1].rate;
    alive_.push_back(swept.contact);
  }
}

/// A contact that stays open: its spring dies out.
void NodalSolver::leave(SweptContact& swept, const NodalTables& tables) {
  ContactNode* node = swept.node;
  const double keep = tables.springs[static_cast<std::size_t>(swept.contact)].keep;
  for (int j = 1; j <= 2; ++j) {
    node[j].penetration = node[j].normal = 0.0;
    node[j].inner = {};
    node[j].friction = {};
    node[j].slides = false;
    node[j].face = node[j - 1].face;
    node[j].spring = keep * node[j - 1].spring;
    node[j].loaded = node[j - 1].loaded;
    if (contact::norm(node[j].spring) < contact::forgotten * node[j].loaded)
      node[j].spring = {};
  }
}

void NodalSolver::accept() {
  for (const int c : alive_)
    swept_[c].node[0] = swept_[c].node[2];
}

void NodalSolver::add_forces(int j, bool inner, double* target) {
  row_.clear();
  factor_.clear();
  const auto add = [&](const double* row, double factor) {
    row_.push_back(row);
    factor_.push_back(factor);
  };
  for (const int c : alive_) {
    const ContactNode& node = swept_[c].node[j];
    const InnerForce more = inner ? node.inner : InnerForce{};
    auto [y, z, x] = force_of_laws(node);
    y += more.y;
    z += more.z;
    x += more.x;
    if (y == 0.0 && z == 0.0 && x == 0.0)
      continue;
    add(contacts_.row(c, 0), y);
    add(contacts_.row(c, 1), z);
    if (contacts_.in_plane[c])
      add(contacts_.row(c, 2), x);
  }
  if (!row_.empty())
    scatter(contacts_.padded_modes, static_cast<int>(row_.size()), row_.data(), factor_.data(), target);
}

double NodalSolver::power(int j, const Array& velocity) const {
  if (velocity.empty())
    return 0.0;
  double sum = 0.0;
  for (const int c : alive_) {
    const SweptContact& swept = swept_[c];
    const ContactNode& node = swept.node[j];
    const InnerForce more = j > 0 ? node.inner : InnerForce{};
    const auto [y, z, x] = force_of_laws(node);
    sum += (y + more.y) * velocity[swept.y] + (z + more.z) * velocity[swept.z];
    if (swept.in_plane)
      sum += (x + more.x) * velocity[swept.x];
  }
  return sum;
}

double NodalSolver::spring_energy(int j) const {
  double sum = 0.0;
  for (const int c : alive_) {
    const ContactNode& node = swept_[c].node[j];
    const contact::Support& support = *swept_[c].support;
    sum += support.normal.spring_energy(node.penetration) + support.friction.spring_energy(node.spring);
  }
  return sum;
}

} // namespace fretwork::transient
