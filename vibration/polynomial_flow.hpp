// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The exact motion of the modes over a step under a force that is quadratic in time, given at the nodes 0, 1/2, 1 of the step:
///     q'' + c q' + k q = F(s),   F(s) = F0 + B s + D s^2,  s = t/h,  B = -3 F0 + 4 F1 - F2,  D = 2 F0 - 4 F1 + 2 F2
/// With g the response to a unit impulse, a = g' + c g, and G_n its n-th repeated integral from 0 (G_0 = g):
///     q(t) = a q0 + g v0 + G_1 F0 + G_2 B/h + 2 G_3 D/h^2
///     v(t) = -k g q0 + g' v0 + g F0 + G_1 B/h + 2 G_2 D/h^2
/// The work of a part L of the force (loads, contacts) up to s is exact too, by parts:
///     int L q' dt = L0 (q - q0) + B_L (s q - M_0) + D_L (s^2 q - 2 M_1),   M_j = int_0^s s^j q ds
/// M_j from q integrated once and twice, which raises every index of the formula of q.
/// k >= 0 and c >= 0 are arbitrary (oscillator.hpp). Modes that a damping matrix couples: coupled_flow.hpp, of degree 2.
#pragma once
#include "core/state_archive.hpp"
#include "kernels/kernels.hpp"
#include "vibration/coupled_flow.hpp"
#include <array>

namespace fretwork::vibration {

/// g', and G_0 .. G_5 at time t.
struct ImpulseChain {
  double rate;
  std::array<double, 6> g;
};
[[nodiscard]] ImpulseChain impulse_chain(double k, double c, double t);

/// phi_n(x) = int_0^1 exp(-x (1 - s)) s^(n-1)/(n-1)! ds for n = 1 .. 5 at [n - 1], x >= 0.
[[nodiscard]] std::array<double, 5> decay_functions(double x);

/// Values of a quadratic polynomial (or of the modes) at the nodes of a step.
struct Nodes {
  kernels::Array at[3];
  void visit(core::StateArchive& state) { state(at); }
};

/// What a step of length h needs of the modes, made once.
class PolynomialFlow {
public:
  PolynomialFlow(const System& system, double h) : PolynomialFlow(system, h, nullptr, 0) {}
  /// @param coupled  of degree 2, over h 2^halvings, with one halving more: moves the modes that it couples; must live longer. Null: none
  PolynomialFlow(const System& system, double h, CoupledFlow* coupled, int halvings);

  /// q and v at the nodes 1/2 and 1 from those at 0, under the loads and the contact forces of node 0 alone. No allocation.
  void predict(const Nodes& load, const Nodes& contact, Nodes& q, Nodes& v) const;

  /// Works from the start of the step to its nodes 1/2 and 1, J.
  struct Works {
    double load[2], contact[2];
  };
  /// The same under all forces. No allocation.
  Works move(const Nodes& load, const Nodes& contact, Nodes& q, Nodes& v) const;

  /// What a modal force of node `from` (1 or 2) does to q and v at node `to`, all modes.
  void respond(const double* force, int to, int from, double* q, double* v) const;

private:
  template <class Force, class Take>
  void move_coupled(const Nodes& q, const Nodes& v, const Force& force, const Take& take) const;
  void predict_coupled(const Nodes& load, const Nodes& contact, Nodes& q, Nodes& v) const;
  void move_coupled(const Nodes& load, const Nodes& contact, Nodes& q, Nodes& v, Works& works) const;

  Eigen::Index modes_;
  CoupledFlow* coupled_;
  int halvings_;
  int padded_modes_;
  kernels::Array
      table_; ///< `lanes` modes at a time: for both nodes the coefficients of q, v, M_0, M_1 by q0 v0 F0 F1 F2
};

/// Coefficients of s^j, j = 0, 1, 2, s from 0 to 1, on the part [from, from + length] of a step (in shares of it), of the quadratic through
/// values at the nodes.
[[nodiscard]] std::array<double, 3> part_of(const std::array<double, 3>& force, double from, double length);

/// State at time t of a step of length h, for output.
struct PolynomialState {
  double q, v;
};
[[nodiscard]] PolynomialState state_under(double k, double c, double h, double t, double q0, double v0,
                                          const std::array<double, 3>& force);

} // namespace fretwork::vibration
