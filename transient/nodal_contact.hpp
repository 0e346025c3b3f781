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
/// in components along x_loc and t, which turn with the normal; what the opposite face has loaded is lost. `sliding` is that of node 0
/// in the whole step. Slip is along the trial with the relaxed T; where that is not beyond the bound (T has not followed yet), and with
/// C_T = 0, along the trial of stick, which is exact on a line and of order 1 in the plane. The slip of `reference` is opposite to v
/// and bears any force within the bound where v = 0.
#pragma once
#include "contact/support.hpp"
#include <array>
#include <cmath>

namespace fretwork::transient {

/// What the path of a contact inside a step adds at a node to its laws there (inner_path.hpp).
struct InnerForce {
  double y = 0.0, z = 0.0, x = 0.0; ///< N, on the node beside `normal` and `friction`, along the local axes
  contact::Vec2 spring;             ///< N, of T
};

/// One contact at one node.
struct ContactNode {
  double ny = 0.0, nz = 0.0;         ///< normal
  double penetration = 0.0;          ///< m
  double rate = 0.0;                 ///< p', m/s
  double across = 0.0;               ///< velocity along t, m/s
  double curvature = 0.0;            ///< of the obstacle, 1/m
  double normal = 0.0;               ///< F_N, N
  contact::Vec2 slip;                ///< tangential velocity in the directions of friction, m/s
  contact::Vec2 friction, spring;    ///< F and T, N
  double face_y = 0.0, face_z = 0.0; ///< normal where the contact was closed last; 0: never
  double approach = 0.0;             ///< m/s, p' of the node before where that was open
  double loaded = 0.0;               ///< |T| where the contact was closed last, N
  bool slides = false;
  InnerForce inner;
};

/// Coefficients of a friction spring over the half steps before the nodes 1/2 and 1.
struct SpringTable {
  static constexpr int parts = 8;                 ///< of a half step (inner_path.hpp)
  double keep = 0.0;                              ///< e^-x
  double keep_part = 0.0;                         ///< over a part
  double part_by_last = 0.0, part_by_force = 0.0; ///< of F, linear over a part, at its begin and end
  double by_slip[2][3];                           ///< -K_T h a_jl, N s/m
  double by_force[2][3];                          ///< b_jl
};
[[nodiscard]] SpringTable spring_table(const contact::FrictionLaw& law, double h);

/// How displacement and velocity at the nodes answer the forces: along n, t, x_loc of the nodes, D of them.
template <int D> struct Answer {
  static constexpr int size = 2 * D;
  using Row = std::array<double, size>;
  Row u[2][D], v[2][D];
};

/// One contact with forces tried at the nodes 1/2 and 1.
template <int D> class NodalContact {
public:
  static constexpr int size = 2 * D;
  using Row = std::array<double, size>;
  /// Sets normal, friction, spring, slides of the nodes 1/2 and 1.
  /// @param nodes  the three nodes, their kinematics set   @param forces  at the nodes 1/2 and 1 along n, t, x_loc
  /// @param rho  N/m, at the nodes 1/2 and 1, 0: not filled   @param rho_slip  N s/m: scales of the filled jumps
  NodalContact(const contact::Support& support, const SpringTable& table, ContactNode* nodes,
               const Row& forces, const std::array<double, 2>& rho, double rho_slip);

  [[nodiscard]] const Row& forces() const { return force_; }
  /// Forces - laws.
  [[nodiscard]] const Row& residual() const { return residual_; }
  /// Which branches of the laws `residual` took.
  [[nodiscard]] int branches() const;
  /// d residual / d forces.
  [[nodiscard]] std::array<Row, size> jacobian(const Answer<D>& answer) const;

private:
  enum class Normal { open, closed, limited };
  enum class Tangent { none, stick, line, relaxed, trial, opposed, rest };
  struct Law {
    Normal normal = Normal::open;
    Tangent tangent = Tangent::none;
    double by_penetration = 0.0, by_rate = 0.0;
    contact::Vec2 e; ///< direction of slip
    double share = 0.0;
    bool carries = false; ///< the spring of the node before
  };
  void press(int j);
  void rub(int j);
  void slide(int j, contact::Vec2 relaxed, contact::Vec2 stuck, double bound);
  [[nodiscard]] contact::Vec2 tried(int j) const;
  /// Of a tangential vector, which has no part along x_loc with two directions.
  [[nodiscard]] static double length(contact::Vec2 v) { return D == 2 ? std::abs(v.t) : contact::norm(v); }

  const contact::Support& support_;
  const SpringTable& table_;
  ContactNode* node_;
  Row force_, residual_;
  std::array<double, 2> rho_;
  double rho_slip_;
  Law law_[2];
};

extern template class NodalContact<2>;
extern template class NodalContact<3>;

} // namespace fretwork::transient
