// SPDX-License-Identifier: GPL-3.0-or-later
#include "transient/collocation/swept_contact.hpp"
#include "kernels/vector_lanes.hpp"
#include "transient/collocation/nodal_contact.hpp"
#include <Eigen/LU>
#include <limits>

namespace fretwork::transient {
namespace {

using namespace kernels;
using Forces = SweptContact::Forces;

/// Of K_N times the distance of the node from its obstacle's centre: round-off of the penetration.
constexpr double round_off = 1e-15;
/// Of a matrix that is inverted in the fastest way.
constexpr double most_condition = 1e4;

/// Returns false where it is singular.
template <class Matrix> bool invert(const Matrix& matrix, double* inverse) {
  Eigen::Map<Matrix> out(inverse);
  out = matrix.inverse();
  // by cofactors where there are 4 rows, which lose the digits of the condition (of stiff dampers) twice, pivots lose them once
  if (!(matrix.squaredNorm() * out.squaredNorm() < most_condition * most_condition))
    out = Eigen::PartialPivLU<Matrix>(matrix).inverse();
  return out.allFinite();
}

/// z += columns of both nodes times forces f along y, z and, with three directions, x. No array overlaps z: the forces stay in registers.
template <class V, int D>
FRETWORK_INLINE void add_columns(std::size_t length, const double* first, const double* second,
                                 const Forces& f, double* __restrict z) {
  for (std::size_t i = 0; i < length; i += size_of<V>) {
    V s = f[0][0] * at<V>(first + i) + f[0][1] * at<V>(first + length + i);
    if constexpr (D == 3)
      s += f[0][2] * at<V>(first + 2 * length + i);
    s += f[1][0] * at<V>(second + i);
    s += f[1][1] * at<V>(second + length + i);
    if constexpr (D == 3)
      s += f[1][2] * at<V>(second + 2 * length + i);
    at<V>(z + i) += s;
  }
}
template <class V, int D>
FRETWORK_INLINE void add_response_by(const SweptContact& a, const Forces& change, NodalMotion& motion) {
  const NodalTables& tables = *a.tables;
  add_columns<V, D>(tables.length, tables.columns(a.contact, 1), tables.columns(a.contact, 2), change,
                    motion.ends.data());
}

/// At the nodes from `first` on. @param u, v  lanes at the node `first`, `stride` on at the next ones
template <int D, int nodes>
FRETWORK_INLINE void meet_by(SweptContact& a, const double* u, const double* v, std::size_t stride,
                             ContactNode* node) {
  double y[nodes], z[nodes];
#pragma GCC unroll 2
  for (int j = 0; j < nodes; ++j) {
    y[j] = u[j * stride + a.y] + a.rest_y;
    z[j] = u[j * stride + a.z] + a.rest_z;
  }
  contact::Location at[nodes];
  std::visit( // once for all
      [&](const auto& obstacle) {
#pragma GCC unroll 2
        for (int j = 0; j < nodes; ++j)
          at[j] = contact::locate(obstacle, y[j], z[j]);
      },
      a.support->obstacle);
  const contact::Vec2 along = a.support->friction.along;
#pragma GCC unroll 2
  for (int j = 0; j < nodes; ++j) {
    const double vy = v[j * stride + a.y], vz = v[j * stride + a.z];
    ContactNode& n = node[j];
    n.axes = at[j].axes();
    n.penetration = -at[j].gap;
    n.rate = -n.axes.normal(vy, vz);
    n.across = n.axes.tangent(vy, vz);
    n.slip.t = along.t * n.across;
    if constexpr (D == 3)
      n.slip.x = along.x * v[j * stride + a.x];
  }
}

template <int D> FRETWORK_INLINE NodalContact<D> laws_of(SweptContact& a, NodalMotion& motion) {
  meet_by<D, 2>(a, motion.u(1), motion.v(1), motion.stride, a.node + 1);
  typename NodalContact<D>::Row local;
  for (int j = 0; j < 2; ++j) {
    const contact::ContactAxes& axes = a.node[j + 1].axes;
    const double* f = a.force[j];
    local[j * D] = axes.normal(f[0], f[1]);
    local[j * D + 1] = axes.tangent(f[0], f[1]);
    if constexpr (D == 3)
      local[j * D + 2] = f[2];
  }
  return {*a.support, a.springs(), a.node, local, a.tables->scales[static_cast<std::size_t>(a.contact)]};
}

/// A new matrix. Returns false where it is singular.
template <int D>
[[gnu::noinline]] bool renew(SweptContact& a, const NodalContact<D>& laws, NodalMotion& motion) {
  for (int j = 1; j <= 2; ++j)
    a.node[j].curvature =
        contact::curvature(a.support->obstacle, motion.u(j)[a.y] + a.rest_y, motion.u(j)[a.z] + a.rest_z);
  a.last_change = 0.0;
  const bool regular = invert(laws.jacobian(a.tables->answer<D>(a.contact, a.node)), a.inverse);
  a.branches = regular ? laws.branches() : -1;
  return regular;
}

template <class V, int D>
FRETWORK_INLINE double improve_by(SweptContact& a, NodalMotion& motion, double share) {
  constexpr double none = std::numeric_limits<double>::infinity();
  const NodalContact<D> laws = laws_of<D>(a, motion);
  if (laws.branches() != a.branches && !renew(a, laws, motion))
    return none;
  using Matrix = typename NodalContact<D>::Jacobian;
  const typename NodalContact<D>::Row step =
      -share * (Eigen::Map<const Matrix>(a.inverse) * laws.residual().matrix()).array();
  if (!std::isfinite(step.sum())) {
    a.branches = -1;
    return none;
  }
  const double largest = step.abs().maxCoeff(), force = (laws.forces().abs() + step.abs()).maxCoeff();
  Forces change;
  for (int j = 0; j < 2; ++j) {
    const contact::ContactAxes& axes = a.node[j + 1].axes;
    change[j][0] = axes.y(step[j * D], step[j * D + 1]);
    change[j][1] = axes.z(step[j * D], step[j * D + 1]);
    change[j][2] = D == 3 ? step[j * D + D - 1] : 0.0;
    for (int k = 0; k < D; ++k)
      a.force[j][k] += change[j][k];
  }
  const double still = round_off * a.support->normal.stiffness *
                       (std::abs(motion.u(1)[a.y] + a.rest_y) + std::abs(motion.u(1)[a.z] + a.rest_z));
  add_response_by<V, D>(a, change, motion);
  if (a.last_change > 0.0 && !(largest < falling * a.last_change))
    a.branches = -1; // a new matrix next time
  a.last_change = largest;
  return largest > still ? largest / force : 0.0;
}

template <class V>
FRETWORK_INLINE double improve_line_on(SweptContact& a, NodalMotion& motion, double share) {
  return improve_by<V, 2>(a, motion, share);
}
FRETWORK_KERNEL(double, improve_line, (SweptContact & a, NodalMotion& motion, double share),
                (a, motion, share))
template <class V>
FRETWORK_INLINE double improve_plane_on(SweptContact& a, NodalMotion& motion, double share) {
  return improve_by<V, 3>(a, motion, share);
}
FRETWORK_KERNEL(double, improve_plane, (SweptContact & a, NodalMotion& motion, double share),
                (a, motion, share))
template <class V>
FRETWORK_INLINE void add_response_of_on(const SweptContact& a, const Forces& change, NodalMotion& motion) {
  if (a.in_plane)
    add_response_by<V, 3>(a, change, motion);
  else
    add_response_by<V, 2>(a, change, motion);
}
FRETWORK_KERNEL(void, add_response_of, (const SweptContact& a, const Forces& change, NodalMotion& motion),
                (a, change, motion))

template <int D> void follow_path_of(SweptContact& a, NodalMotion& motion) {
  const NodalContact<D> laws = laws_of<D>(a, motion); // those of the last sweep are before its change
  const SpringTable& table = a.springs();
  const InnerPath path = inner_path<D>(*a.support, table, a.node, a.tables->step);
  Tangential<D> handed{}; // what the spring of the node before gains
  for (int j = 0; j < 2; ++j) {
    ContactNode& at = a.node[j + 1];
    const PathForce& by = path.force[j];
    const PathEnd& end = path.end[j];
    if (at.face.opposite(a.node[j].face))
      handed = {};
    const Tangential<D> spring = tangential<D>(end.spring),
                        stuck = tangential<D>(end.stuck) - laws.stuck(j) - handed,
                        relaxed = spring - laws.relaxed(j) - table.keep * handed;
    handed = spring - tangential<D>(at.spring);
    const InnerForce now{at.axes.y(by.normal, by.friction.t),
                         at.axes.z(by.normal, by.friction.t),
                         by.friction.x,
                         at.inner.stuck + in_plane(stuck),
                         at.inner.relaxed + in_plane(relaxed),
                         true,
                         end.slides};
    a.path_change[j][0] = now.y - at.inner.y;
    a.path_change[j][1] = now.z - at.inner.z;
    a.path_change[j][2] = now.x - at.inner.x;
    at.inner = now;
  }
  a.losses = {path.loss[0], path.loss[1]};
}

} // namespace

SweptContact::SweptContact(const PackedContacts& contacts, int c)
    : contact(c), in_plane(contacts.in_plane[c]), y(c), z(y + contacts.width), x(z + contacts.width),
      rest_y(contacts.rest_y(c)), rest_z(contacts.rest_z(c)), support(&contacts.supports[c]) {}

void SweptContact::join(const NodalTables& of_step) {
  takes_part = true;
  tables = &of_step;
  std::fill_n(force[0], 6, 0.0);
  has_path = false;
  node[1].inner = node[2].inner = {};
  last_change = 0.0;
}

void meet_start(SweptContact& a, NodalMotion& motion) {
  (a.in_plane ? meet_by<3, 1> : meet_by<2, 1>)(a, motion.u(0), motion.v(0), 0, a.node);
}

void meet_ends(SweptContact& a, NodalMotion& motion) {
  (a.in_plane ? meet_by<3, 2> : meet_by<2, 2>)(a, motion.u(1), motion.v(1), motion.stride, a.node + 1);
}

void add_response(const SweptContact& a, const Forces& change, NodalMotion& motion) {
  add_response_of(a, change, motion);
}

double improve(SweptContact& a, NodalMotion& motion, double share) {
  return (a.in_plane ? improve_plane : improve_line)(a, motion, share);
}

void evaluate(SweptContact& a, NodalMotion& motion) {
  if (a.in_plane)
    (void)laws_of<3>(a, motion);
  else
    (void)laws_of<2>(a, motion);
}

void follow_path(SweptContact& a, NodalMotion& motion) {
  a.last_change = 0.0;
  if (a.in_plane)
    follow_path_of<3>(a, motion);
  else
    follow_path_of<2>(a, motion);
}

} // namespace fretwork::transient
