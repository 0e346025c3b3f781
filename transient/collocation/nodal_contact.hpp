// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The laws of one contact at the nodes 0, 1/2, 1 of a step, and their linearisation by its forces at 1/2 and 1.
///
/// Normal force: contact::normal_force. With C_N it jumps where the contact closes; there the jump is filled: p = 0 bears any force
/// between 0 and C_N p', and f solves the law where f = max(0, min(K_N p + c(p) p', f + rho p)), rho > 0 arbitrary. Where the displacement of the node 1
/// does not answer its own force (all modes slow: the weight of Lobatto IIIA is 0), nothing can hold it at p = 0: the law as it is.
/// Friction: the trial of contact::evaluate with the spring's force T at the node. Over the half step before node j
///     stick          T_j = T_{j-1} - K_T h sum_l a_jl v_l    a_1 = (5/24, 1/3, -1/24), a_2 = (-1/24, 1/3, 5/24): int v dt of the
///                                                            quadratic through the nodes
///     slip and open  T_j = e^-x T_{j-1} + sum_l b_jl F_l     x = K_T h/(2 C_T): T' = -(K_T/C_T)(T - F) exactly, F quadratic through
///                                                            the nodes; `reference` and C_T = 0: T_j = F_j
/// in components along x_loc and t, which turn with the normal; what the opposite face has loaded is lost. `sliding` is that of node
/// j - 1, or where a path has been followed to node j (inner_path.hpp) that of the path; both T then are shifted onto that of the path. Slip is along the trial with the relaxed T; where that is not beyond the bound (T has not followed yet), and with
/// C_T = 0, along the trial of stick, which is exact on a line and of order 1 in the plane.
/// So it is where T falls to less than `slow_fall` of itself in a part of a path, and the contact has not slid from the node 0 on or a path has been
/// followed to the node: there, with x = K_T/C_T times the length of the part, T - F is of the order of F/x, and what the quadratic misses of F would turn the slip x times as far. The parts of a
/// path slip along the trial of stick, too. The slip of `reference` is opposite to v
/// and bears any force within the bound where v = 0.
#pragma once
#include "transient/collocation/contact_node.hpp"
#include "transient/collocation/tangential.hpp"
#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>

namespace fretwork::transient {

/// How displacement and velocity at the nodes answer the forces: along n, t, x_loc of the nodes, D of them.
template <int D> struct Answer {
  static constexpr int size = 2 * D;
  using Row = Eigen::Array<double, size, 1>;
  Row u[2][D], v[2][D];
};

/// What springs keep in a part of a path where their fall is slow beside it: K_T h/C_T up to 16 ln 2 = 11, h/16 being a part.
inline constexpr double slow_fall = 0.5;

/// Which law holds.
enum class NormalBranch { open, closed, limited };
enum class TangentBranch { none, stick, line, relaxed, trial, opposed, rest };

/// One contact with forces tried at the nodes 1/2 and 1.
template <int D> class NodalContact {
public:
  static constexpr int size = 2 * D;
  using Row = Eigen::Array<double, size, 1>;
  using Jacobian = Eigen::Matrix<double, size, size>;
  /// Sets normal, friction, spring, slides of the nodes 1/2 and 1.
  /// @param nodes  the three nodes, their kinematics set   @param forces  at the nodes 1/2 and 1 along n, t, x_loc
  NodalContact(const contact::Support& support, const SpringTable& table, ContactNode* nodes,
               const Row& forces, const JumpScales& scales);

  [[nodiscard]] const Row& forces() const { return force_; }
  /// Forces - laws.
  [[nodiscard]] const Row& residual() const { return residual_; }
  /// Which branches of the laws `residual` took.
  [[nodiscard]] int branches() const;
  /// At the node j + 1.
  [[nodiscard]] NormalBranch normal(int j) const { return law_[j].normal; }
  [[nodiscard]] TangentBranch tangent(int j) const { return law_[j].tangent; }
  /// T at the node j + 1 in components along x_loc and t, N: in stick, and in slip and open.
  [[nodiscard]] Tangential<D> stuck(int j) const;
  [[nodiscard]] Tangential<D> relaxed(int j) const;
  /// d residual / d forces.
  [[nodiscard]] Jacobian jacobian(const Answer<D>& answer) const;

private:
  using Vector = Tangential<D>;
  struct Law {
    NormalBranch normal;
    TangentBranch tangent;
    double by_penetration, by_rate;
    Vector e; ///< direction of slip
    double share;
    bool carries; ///< the spring of the node before
  };
  void press(int j);
  void rub(int j);
  [[nodiscard]] Vector slide(int j, Vector relaxed, Vector trial, double bound);
  [[nodiscard]] Vector tried(int j) const;
  [[nodiscard]] Vector carried(int j) const;       ///< T of the node before
  [[nodiscard]] Vector masked(Vector force) const; ///< in the directions of friction

  const contact::Support& support_;
  const SpringTable& table_;
  ContactNode* node_;
  Row force_, residual_;
  JumpScales scales_;
  Vector slip_[3]; ///< of the nodes
  Law law_[2];
};

template <int D>
[[gnu::always_inline]] inline NodalContact<D>::NodalContact(const contact::Support& support,
                                                            const SpringTable& table, ContactNode* nodes,
                                                            const Row& forces, const JumpScales& scales)
    : support_(support), table_(table), node_(nodes), force_(forces), scales_(scales) {
  const bool with_friction = support_.friction.active();
  for (int j = 0; j < 3; ++j)
    slip_[j] = tangential<D>(node_[j].slip);
#pragma GCC unroll 2
  for (int j = 0; j < 2; ++j) {
    press(j);
    law_[j].tangent = TangentBranch::none;
    law_[j].carries = false;
    if (with_friction)
      rub(j);
    const ContactNode& node = node_[j + 1];
    residual_[j * D] = force_[j * D] - node.normal;
    residual_[j * D + 1] = force_[j * D + 1] - node.friction.t;
    if constexpr (D == 3)
      residual_[j * D + 2] = force_[j * D + 2] - node.friction.x;
  }
}

template <int D>
[[gnu::always_inline]] inline typename NodalContact<D>::Vector NodalContact<D>::tried(int j) const {
  if constexpr (D == 2)
    return force_[j * D + 1];
  else
    return {force_[j * D + 2], force_[j * D + 1]};
}

template <int D>
[[gnu::always_inline]] inline typename NodalContact<D>::Vector NodalContact<D>::masked(Vector force) const {
  if constexpr (D == 2)
    return support_.friction.along.t * force;
  else
    return support_.friction.masked(force);
}

template <int D> [[gnu::always_inline]] inline void NodalContact<D>::press(int j) {
  const contact::NormalLaw& law = support_.normal;
  ContactNode& node = node_[j + 1];
  Law& out = law_[j];
  const double p = node.penetration;
  if (!(law.damping > 0.0)) {
    const auto slopes = contact::normal_slopes(law, p, node.rate);
    node.normal = slopes.force;
    out.normal = slopes.force > 0.0 ? NormalBranch::closed : NormalBranch::open;
    out.by_penetration = slopes.by_penetration;
    out.by_rate = slopes.by_rate;
  } else {
    const double c = law.damping_at(p), by_law = law.spring_and_damper(p, node.rate),
                 limit = scales_.rho[j] > 0.0 ? force_[j * D] + scales_.rho[j] * p
                         : p > 0.0            ? by_law
                                              : 0.0;
    node.normal = std::max(0.0, std::min(by_law, limit));
    out.normal = !(node.normal > 0.0) ? NormalBranch::open
                 : by_law <= limit    ? NormalBranch::closed
                                      : NormalBranch::limited;
    out.by_penetration = law.stiffness * (1.0 + law.dissipation * node.rate);
    out.by_rate = c;
  }
  const ContactNode& before = node_[j];
  node.face = node.normal > 0.0 ? node.axes : before.face;
}

template <int D>
[[gnu::always_inline]] inline typename NodalContact<D>::Vector NodalContact<D>::carried(int j) const {
  return law_[j].carries ? tangential<D>(node_[j].spring) : Vector{};
}

template <int D> [[gnu::always_inline]] inline Tangential<D> NodalContact<D>::stuck(int j) const {
  const double* s = table_.by_slip[j];
  return carried(j) + s[0] * slip_[0] + s[1] * slip_[1] + s[2] * slip_[2] +
         tangential<D>(node_[j + 1].inner.stuck);
}

template <int D> [[gnu::always_inline]] inline Tangential<D> NodalContact<D>::relaxed(int j) const {
  const double* f = table_.by_force[j];
  return table_.keep * carried(j) + f[0] * tangential<D>(node_[0].friction) + f[1] * tried(0) +
         f[2] * tried(1) + tangential<D>(node_[j + 1].inner.relaxed);
}

template <int D> [[gnu::always_inline]] inline void NodalContact<D>::rub(int j) {
  const contact::FrictionLaw& law = support_.friction;
  const ContactNode& before = node_[j];
  ContactNode& node = node_[j + 1];
  Law& out = law_[j];
  out.carries = !before.face.opposite(node.face);
  const Vector stuck = this->stuck(j), trial = law.trial(stuck, slip_[j + 1]);
  const bool closed = node.normal > 0.0, slid = node.inner.followed ? node.inner.slides : before.slides;
  node.slides = false;
  if (closed && norm(trial) <= law.coefficient(slid) * node.normal) {
    out.tangent = TangentBranch::stick;
    node.friction = in_plane(trial);
    node.spring = in_plane(stuck);
    return;
  }
  const Vector relaxed = this->relaxed(j);
  node.spring = in_plane(relaxed);
  node.friction = {};
  if (!closed)
    return;
  node.slides = true;
  node.friction = in_plane(slide(j, relaxed, trial, law.mu_dynamic * node.normal));
}

template <int D>
[[gnu::always_inline]] inline typename NodalContact<D>::Vector
NodalContact<D>::slide(int j, Vector relaxed, Vector trial, double bound) {
  const contact::FrictionLaw& law = support_.friction;
  Law& out = law_[j];
  if (law.kind == contact::FrictionMemoryKind::reference) {
    trial = masked(tried(j)) - scales_.rho_slip * slip_[j + 1];
    out.tangent = norm(trial) <= bound ? TangentBranch::rest : TangentBranch::opposed;
    if (out.tangent == TangentBranch::rest)
      return trial;
  } else if constexpr (D == 2) {
    out.tangent = TangentBranch::line;
    out.e = std::copysign(1.0, trial);
    out.share = 0.0;
    return bound * out.e; // the law does not feel how long the trial is
  } else {
    out.tangent = TangentBranch::trial;
    const Vector candidate = law.trial(relaxed, slip_[j + 1]);
    const bool slid = node_[0].slides && node_[1].slides && !node_[j + 1].inner.followed;
    if (table_.keep > 0.0 && (slid || table_.keep_part > slow_fall) && norm(candidate) > bound &&
        dot(candidate, trial) > 0.0) {
      trial = candidate;
      out.tangent = TangentBranch::relaxed;
    }
  }
  const double length = norm(trial);
  out.e = (1.0 / length) * trial;
  out.share = bound / length;
  return bound * out.e;
}

template <int D> [[gnu::always_inline]] inline int NodalContact<D>::branches() const {
  int code = 0;
  for (const Law& law : law_)
    code = (code * 3 + static_cast<int>(law.normal)) * 7 + static_cast<int>(law.tangent);
  return code;
}

} // namespace fretwork::transient
