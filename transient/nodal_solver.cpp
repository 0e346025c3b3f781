// SPDX-License-Identifier: GPL-3.0-or-later
#include "transient/nodal_solver.hpp"
#include "transient/contact_lanes.hpp"
#include "transient/vector_lanes.hpp"
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

namespace fretwork::transient {
namespace {

using namespace kernels;

/// Sweeps stop when what is still to come is below this share of the force: far below what a step leaves at its finest.
constexpr double sweep_tolerance = 1e-9;
/// Of K_N times the distance of the node from its obstacle's centre: round-off of the penetration.
constexpr double round_off = 1e-15;
/// A node at the end of a step that answers its force by less than this share of the node 1/2 does not.
constexpr double no_answer = 1e-9;
/// The ratio of the changes of two sweeps foretells the next ones, and a kept matrix is good, where they fall clearly.
constexpr double falling = 0.3;
constexpr int patient = 20, most_sweeps = 60;
/// The same of a step with contacts that change inside it, whose paths are not told better.
constexpr double kink_tolerance = 1e-7;
/// The same of the motion along which the paths inside a step are followed.
constexpr double path_tolerance = 1e-2;
/// Times that the paths inside a step are followed: a third time changes next to nothing.
constexpr int most_paths = 2;
/// Of a matrix that is inverted in the fastest way.
constexpr double most_condition = 1e4;

/// Returns false where it is singular.
template <int n> bool invert(const std::array<std::array<double, n>, n>& a, double* inverse) {
  using Matrix = Eigen::Matrix<double, n, n, Eigen::RowMajor>;
  Eigen::Map<Matrix> out(inverse);
  const Eigen::Map<const Matrix> matrix(a[0].data());
  out = matrix.inverse();
  // by cofactors where there are 4 rows, which lose the digits of the condition (of stiff dampers) twice, pivots lose them once
  if (!(matrix.squaredNorm() * out.squaredNorm() < most_condition * most_condition))
    out = Eigen::PartialPivLU<Matrix>(matrix).inverse();
  return out.allFinite();
}

/// z += columns of both nodes times forces f along y, z and, with three directions, x. No array overlaps z: the forces stay in registers.
template <class V>
FRETWORK_INLINE void add_columns_on(std::size_t length, int directions, const double* first,
                                    const double* second, const double (*f)[3], double* __restrict z) {
  for (std::size_t i = 0; i < length; i += size_of<V>) {
    V s = f[0][0] * at<V>(first + i) + f[0][1] * at<V>(first + length + i);
    if (directions == 3)
      s += f[0][2] * at<V>(first + 2 * length + i);
    s += f[1][0] * at<V>(second + i);
    s += f[1][1] * at<V>(second + length + i);
    if (directions == 3)
      s += f[1][2] * at<V>(second + 2 * length + i);
    at<V>(z + i) += s;
  }
}
FRETWORK_KERNEL(void, add_columns,
                (std::size_t length, int directions, const double* first, const double* second,
                 const double (*f)[3], double* z),
                (length, directions, first, second, f, z))

/// Bound of contact::Reach: false where the node is surely out of its obstacle.
bool may_touch(const ReachLanes& r, std::size_t c, double y, double z) {
  y += r.rest_y[c];
  z += r.rest_z[c];
  const double left = r.limit[c] - r.ly[c] * y - r.lz[c] * z, across = r.wy[c] * y * y + r.wz[c] * z * z;
  const double radial = r.radial[c];
  return radial > 0.0 ? left <= 0.0 || radial * radial * across >= left * left
                      : left <= radial * std::sqrt(across);
}

} // namespace

NodalSolver::NodalSolver(const PackedContacts& contacts) : contacts_(contacts) {
  const auto count = static_cast<std::size_t>(contacts.count);
  nodes_.resize(3 * count);
  active_.reserve(count);
  taking_part_.assign(count, 0);
  changes_inside_.assign(count, 0);
  inner_losses_.resize(2 * count);
  alive_.reserve(count);
  row_.reserve(3 * count);
  factor_.reserve(3 * count);
}

void NodalSolver::start(NodalMotion& motion) {
  for (int c = 0; c < contacts_.count; ++c) {
    meet(c, 0, motion);
    const contact::Support& support = contacts_.supports[c];
    ContactNode& node = nodes_[3 * static_cast<std::size_t>(c)];
    node.normal = contact::normal_force(support.normal, node.penetration, node.rate);
    node.approach = node.rate;
    if (node.penetration > 0.0 || node.normal > 0.0)
      alive_.push_back(c);
    if (!(node.normal > 0.0))
      continue;
    node.face_y = node.ny;
    node.face_z = node.nz;
    if (!support.friction.active())
      continue;
    const auto friction = contacts_.in_plane[c]
                              ? contact::evaluate(support.friction, {}, node.normal, {}, node.slip)
                              : contact::evaluate_line(support.friction, {}, node.normal, 0.0, node.slip.t);
    node.friction = friction.force;
    node.slides = friction.slides;
  }
}

/// Kinematics of a contact at a node.
void NodalSolver::meet(int c, int node, NodalMotion& motion) {
  const auto i = static_cast<std::size_t>(c), z = static_cast<std::size_t>(contacts_.width) + i;
  const double *u = motion.u(node), *v = motion.v(node);
  const double y_at = u[i] + contacts_.reach.rest_y[i], z_at = u[z] + contacts_.reach.rest_z[i];
  const contact::Support& support = contacts_.supports[i];
  const auto at = contact::locate(support.obstacle, y_at, z_at);
  ContactNode& n = nodes_[3 * i + static_cast<std::size_t>(node)];
  n.ny = at.ny;
  n.nz = at.nz;
  n.penetration = -at.gap;
  n.rate = -(at.ny * v[i] + at.nz * v[z]);
  n.across = at.nz * v[i] - at.ny * v[z];
  const contact::Vec2 along = support.friction.along;
  n.slip = {contacts_.in_plane[i] ? along.x * v[static_cast<std::size_t>(contacts_.width) + z] : 0.0,
            along.t * n.across};
}

bool NodalSolver::solve(const NodalTables& tables, NodalMotion& motion) {
  active_.clear();
  std::fill(taking_part_.begin(), taking_part_.end(), 0);
  std::fill(changes_inside_.begin(), changes_inside_.end(), 0);
  inner_paths_ = false;
  (void)admit(tables, motion);
  changes_ = {};
  bool solved = settle_all(tables, motion, path_tolerance);
  for (int i = 0; i < most_paths && solved && follow_paths(tables, motion); ++i) {
    changes_ = {};
    if (i + 1 < most_paths)
      solved = settle_all(tables, motion, path_tolerance);
  }
  solved = solved && settle_all(tables, motion, inner_paths_ ? kink_tolerance : sweep_tolerance);
  if (solved)
    finish(tables, motion);
  return solved;
}

/// With the contacts that are met on the way.
bool NodalSolver::settle_all(const NodalTables& tables, NodalMotion& motion, double tolerance) {
  while (settle(tables, motion, tolerance)) {
    if (!admit(tables, motion))
      return true;
    changes_ = {};
  }
  return false;
}

/// Finds what the paths of contacts inside the step add to their forces; all lanes answer. Returns whether there is any.
bool NodalSolver::follow_paths(const NodalTables& tables, NodalMotion& motion) {
  bool any = false;
  for (Active& active : active_) {
    const auto c = static_cast<std::size_t>(active.contact);
    const contact::Support& support = contacts_.supports[c];
    ContactNode* node = &nodes_[3 * c];
    changes_inside_[c] = changes_inside_[c] || changes_inside(support, node);
    if (!changes_inside_[c])
      continue;
    any = true;
    evaluate(active, tables, motion); // the laws of the last sweep are those before its change
    active.last_change = 0.0;
    const InnerPath path = inner_path(support, tables.springs[c], node, tables.step);
    for (int j = 0; j < 2; ++j) {
      ContactNode& at = node[j + 1];
      const PathForce& by = path.force[j];
      inner_losses_[2 * c + static_cast<std::size_t>(j)] = path.loss[j];
      const InnerForce now{at.ny * by.normal + at.nz * by.friction.t,
                           at.nz * by.normal - at.ny * by.friction.t, by.friction.x,
                           at.inner.spring + by.spring};
      active.change[j][0] = now.y - at.inner.y;
      active.change[j][1] = now.z - at.inner.z;
      active.change[j][2] = now.x - at.inner.x;
      at.inner = now;
    }
  }
  for (const Active& active : active_) // when all paths are known, whatever their order
    if (const auto c = static_cast<std::size_t>(active.contact); changes_inside_[c])
      add_columns(tables.length, contacts_.in_plane[c] ? 3 : 2, tables.columns(active.contact, 1),
                  tables.columns(active.contact, 2), active.change, motion.ends.data());
  inner_paths_ = inner_paths_ || any;
  return any;
}

/// Takes in the contacts that penetrate and do not take part yet. Returns whether there are any.
bool NodalSolver::admit(const NodalTables& tables, NodalMotion& motion) {
  const std::size_t before = active_.size();
  const auto width = static_cast<std::size_t>(contacts_.width);
  const double *u1 = motion.u(1), *u2 = motion.u(2);
  for (int c = 0; c < contacts_.count; ++c) {
    const auto i = static_cast<std::size_t>(c);
    ContactNode* node = &nodes_[3 * i];
    const bool was_closed = node[0].normal > 0.0;
    if (taking_part_[i] || !(was_closed || may_touch(contacts_.reach, i, u1[i], u1[width + i]) ||
                             may_touch(contacts_.reach, i, u2[i], u2[width + i])))
      continue;
    meet(c, 1, motion);
    meet(c, 2, motion);
    if (!(was_closed || node[1].penetration >= 0.0 || node[2].penetration >= 0.0))
      continue;
    taking_part_[i] = 1;
    node[1].inner = node[2].inner = {};
    Active& active = active_.emplace_back();
    active.contact = c;
    set_scales(active, tables);
    if (!was_closed) {
      meet(c, 0, motion);
      continue;
    }
    for (auto& force : active.force) { // as at the start of the step
      force[0] = node[0].normal * node[0].ny + node[0].friction.t * node[0].nz;
      force[1] = node[0].normal * node[0].nz - node[0].friction.t * node[0].ny;
      force[2] = node[0].friction.x;
    }
    add_columns(tables.length, contacts_.in_plane[i] ? 3 : 2, tables.columns(c, 1), tables.columns(c, 2),
                active.force, motion.ends.data());
  }
  return active_.size() > before;
}

/// The answers of the nodes to their own forces set the scales of the jumps.
void NodalSolver::set_scales(Active& active, const NodalTables& tables) const {
  const auto c = static_cast<std::size_t>(active.contact), width = static_cast<std::size_t>(contacts_.width);
  const double* u = tables.columns(active.contact, 1) + c;
  const double* v = u + 2 * static_cast<std::size_t>(contacts_.stride());
  const double by_u = u[0] + u[tables.length + width], by_v = v[0] + v[tables.length + width];
  const double* at_end = tables.columns(active.contact, 2) + static_cast<std::size_t>(contacts_.stride()) + c;
  const double end_by_u = at_end[0] + at_end[tables.length + width];
  active.rho[0] = by_u > 0.0 ? 1.0 / by_u : contacts_.supports[c].normal.stiffness;
  active.rho[1] = end_by_u > no_answer * by_u ? active.rho[0] : 0.0;
  active.rho_slip = by_v > 0.0 ? 1.0 / by_v : 0.0;
}

/// From where the sweeps of a looser tolerance have stopped.
bool NodalSolver::settle(const NodalTables& tables, NodalMotion& motion, double tolerance) {
  for (int k = 0; k < most_sweeps; ++k) {
    if (changes_.within(tolerance))
      return true;
    double largest = 0.0;
    for (Active& active : active_) {
      const double change = improve(active, tables, motion, k < patient ? 1.0 : 0.5);
      if (!(change < 1e6)) // not a number, or running away
        return false;
      largest = std::max(largest, change);
    }
    changes_ = {true, largest, changes_.largest};
  }
  return changes_.within(tolerance);
}

bool NodalSolver::Changes::within(double tolerance) const {
  const bool foretold = largest <= falling * last;
  return known && (largest <= tolerance || (foretold && largest * largest <= tolerance * (last - largest)));
}

double NodalSolver::improve(Active& active, const NodalTables& tables, NodalMotion& motion, double share) {
  return contacts_.in_plane[static_cast<std::size_t>(active.contact)]
             ? improve<3>(active, tables, motion, share)
             : improve<2>(active, tables, motion, share);
}

/// The laws of a contact at the motion and with the forces tried.
template <int D>
NodalContact<D> NodalSolver::evaluate(const Active& active, const NodalTables& tables, NodalMotion& motion) {
  const auto c = static_cast<std::size_t>(active.contact);
  ContactNode* node = &nodes_[3 * c];
  std::array<double, 2 * D> local;
  for (int j = 0; j < 2; ++j) {
    meet(active.contact, j + 1, motion);
    const ContactNode& at = node[j + 1];
    const double* f = active.force[j];
    local[j * D] = at.ny * f[0] + at.nz * f[1];
    local[j * D + 1] = at.nz * f[0] - at.ny * f[1];
    if constexpr (D == 3)
      local[j * D + 2] = f[2];
  }
  return {contacts_.supports[c], tables.springs[c], node, local, active.rho, active.rho_slip};
}

void NodalSolver::evaluate(const Active& active, const NodalTables& tables, NodalMotion& motion) {
  if (contacts_.in_plane[static_cast<std::size_t>(active.contact)])
    (void)evaluate<3>(active, tables, motion);
  else
    (void)evaluate<2>(active, tables, motion);
}

/// One Newton step of one contact. Returns the largest change of its forces, relative to them.
template <int D>
double NodalSolver::improve(Active& active, const NodalTables& tables, NodalMotion& motion, double share) {
  constexpr int size = 2 * D;
  const auto c = static_cast<std::size_t>(active.contact);
  const contact::Support& support = contacts_.supports[c];
  ContactNode* node = &nodes_[3 * c];
  const NodalContact<D> laws = evaluate<D>(active, tables, motion);
  const auto& residual = laws.residual();
  if (const int branches = laws.branches(); branches != active.branches) {
    for (int j = 1; j <= 2; ++j)
      node[j].curvature = contact::curvature(support.obstacle, motion.u(j)[c] + contacts_.reach.rest_y[c],
                                             motion.u(j)[static_cast<std::size_t>(contacts_.width) + c] +
                                                 contacts_.reach.rest_z[c]);
    const auto jacobian = laws.jacobian(tables.answer<D>(active.contact, node));
    if (!invert<size>(jacobian, active.inverse))
      return std::numeric_limits<double>::infinity();
    active.branches = branches;
    active.last_change = 0.0;
  }
  double step[size], largest = 0.0, force = 0.0, sum = 0.0;
  for (int i = 0; i < size; ++i) {
    step[i] = 0.0;
    for (int k = 0; k < size; ++k)
      step[i] -= share * active.inverse[i * size + k] * residual[static_cast<std::size_t>(k)];
    largest = std::max(largest, std::abs(step[i]));
    sum += step[i];
    force = std::max(force, std::abs(laws.forces()[static_cast<std::size_t>(i)]) + std::abs(step[i]));
  }
  if (!std::isfinite(sum))
    return std::numeric_limits<double>::infinity();
  double change[2][3]{};
  for (int j = 0; j < 2; ++j) {
    const ContactNode& at = node[j + 1];
    change[j][0] = at.ny * step[j * D] + at.nz * step[j * D + 1];
    change[j][1] = at.nz * step[j * D] - at.ny * step[j * D + 1];
    if constexpr (D == 3)
      change[j][2] = step[j * D + 2];
    for (int k = 0; k < 3; ++k)
      active.force[j][k] += change[j][k];
  }
  add_columns(tables.length, D, tables.columns(active.contact, 1), tables.columns(active.contact, 2), change,
              motion.ends.data());
  if (active.last_change > 0.0 && !(largest < falling * active.last_change))
    active.branches = -1; // a new matrix next time
  active.last_change = largest;
  const double still =
      round_off * support.normal.stiffness *
      (std::abs(motion.u(1)[c] + contacts_.reach.rest_y[c]) +
       std::abs(motion.u(1)[static_cast<std::size_t>(contacts_.width) + c] + contacts_.reach.rest_z[c]));
  return largest > still ? largest / force : 0.0;
}

/// The laws at the motion found, and the springs of the contacts that are open.
void NodalSolver::finish(const NodalTables& tables, NodalMotion& motion) {
  alive_.clear();
  for (const Active& active : active_)
    evaluate(active, tables, motion);
  for (int c = 0; c < contacts_.count; ++c) {
    const auto i = static_cast<std::size_t>(c);
    ContactNode* node = &nodes_[3 * i];
    if (!taking_part_[i]) {
      if (!(contact::dot(node[0].spring, node[0].spring) > 0.0))
        continue;
      leave(c, tables);
    }
    if (taking_part_[i])
      for (int j = 1; j <= 2; ++j)
        node[j].loaded = node[j].normal > 0.0 ? contact::norm(node[j].spring) : node[j - 1].loaded;
    for (int j = 1; j <= 2; ++j)
      node[j].approach = node[j - 1].normal > 0.0 ? node[j].rate : node[j - 1].rate;
    alive_.push_back(c);
  }
}

/// A contact that stays open: its spring dies out.
void NodalSolver::leave(int c, const NodalTables& tables) {
  const auto i = static_cast<std::size_t>(c);
  ContactNode* node = &nodes_[3 * i];
  const SpringTable& table = tables.springs[i];
  for (int j = 1; j <= 2; ++j) {
    node[j].penetration = node[j].normal = 0.0;
    node[j].inner = {};
    node[j].friction = {};
    node[j].slides = false;
    node[j].face_y = node[j - 1].face_y;
    node[j].face_z = node[j - 1].face_z;
    node[j].spring = table.keep * node[j - 1].spring;
    node[j].loaded = node[j - 1].loaded;
    if (contact::norm(node[j].spring) < forgotten * node[j].loaded)
      node[j].spring = {};
  }
}

void NodalSolver::accept() {
  for (const int c : alive_)
    nodes_[3 * static_cast<std::size_t>(c)] = nodes_[3 * static_cast<std::size_t>(c) + 2];
}

void NodalSolver::add_forces(int j, bool inner, double* target) {
  row_.clear();
  factor_.clear();
  const auto add = [&](const double* row, double factor) {
    row_.push_back(row);
    factor_.push_back(factor);
  };
  for (const int c : alive_) {
    const ContactNode& node = nodes_[3 * static_cast<std::size_t>(c) + static_cast<std::size_t>(j)];
    const InnerForce more = inner ? node.inner : InnerForce{};
    const double y = node.normal * node.ny + node.friction.t * node.nz + more.y,
                 z = node.normal * node.nz - node.friction.t * node.ny + more.z, x = node.friction.x + more.x;
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
  const auto width = static_cast<std::size_t>(contacts_.width);
  double sum = 0.0;
  for (const int c : alive_) {
    const auto i = static_cast<std::size_t>(c);
    const ContactNode& node = nodes_[3 * i + static_cast<std::size_t>(j)];
    const InnerForce more = j > 0 ? node.inner : InnerForce{};
    sum += (node.normal * node.ny + node.friction.t * node.nz + more.y) * velocity[i] +
           (node.normal * node.nz - node.friction.t * node.ny + more.z) * velocity[width + i];
    if (contacts_.in_plane[i])
      sum += (node.friction.x + more.x) * velocity[2 * width + i];
  }
  return sum;
}

double NodalSolver::spring_energy(int j) const {
  double sum = 0.0;
  for (const int c : alive_) {
    const auto i = static_cast<std::size_t>(c);
    const ContactNode& node = nodes_[3 * i + static_cast<std::size_t>(j)];
    const contact::Support& support = contacts_.supports[i];
    if (node.penetration > 0.0)
      sum += 0.5 * support.normal.stiffness * node.penetration * node.penetration;
    sum += contact::spring_energy(support.friction, {node.spring, false});
  }
  return sum;
}

} // namespace fretwork::transient
