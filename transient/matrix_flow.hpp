// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The exact motion of modes that a damping matrix couples, q'' + C q' + K q = f(t), over a step in which f is linear from f0 to f1.
///
/// The step is linear: (q1, v1, mean of q) = F (q0, v0, f0, f1). Over t with (w_max + |C|) t <= 1 its columns come from Taylor's
/// series of the motion in first-order form, T_j = q^(j) t^j/j!, V_j = v^(j) t^j/j!, f_0 = f0, f_1 = f1 - f0, the others 0:
///     (j+1) T_{j+1} = t V_j,    (j+1) V_{j+1} = t (f_j - C V_j - K T_j),    q1 = sum T_j, v1 = sum V_j, mean = sum T_j/(j+1)
/// and over the step by doubling L times, f linear all along: scaling and squaring (N. Higham, Functions of Matrices, SIAM 2008,
/// chapter 10) of the flow with its loads. C >= 0 is arbitrary: critical, overdamped and rigid motions are no special cases. The flows
/// of all h/2^l are kept: an instant inside a step is reached by whole halves and one short series.
///
/// Modes that C couples, directly or through others, make a block; a block of m modes costs 12 m^2 multiplications a step. The others
/// are left to oscillator.hpp.
#pragma once
#include "transient/scene.hpp"
#include <vector>

namespace fretwork::transient {

/// The system for its modes that the damping matrix does not couple: `damping` is the matrix's diagonal, where there is one.
[[nodiscard]] System with_diagonal(System system);

class MatrixFlow {
public:
  /// @param step  s; without a damping matrix, or with a diagonal one, no mode is coupled
  MatrixFlow(const System& system, double step);

  [[nodiscard]] bool empty() const { return blocks_.empty(); }
  [[nodiscard]] bool couples(Eigen::Index mode) const {
    return !blocks_.empty() && coupled_[static_cast<std::size_t>(mode)];
  }

  /// Motion of the coupled modes over a step; q, v and loads hold all modes. Null loads: none. No allocation.
  /// @param halvings  0: over the step, 1: over half of it   @return work of the loads, J
  double advance(int halvings, double* q, double* v, const double* f0, const double* f1);

  /// State of the coupled modes a time 0 <= t <= step after q0, v0 under the load f0 + t slope (null: none). No allocation.
  void inside(double t, const double* q0, const double* v0, const double* f0, const double* slope, double* q,
              double* v);

private:
  struct Block {
    std::vector<Eigen::Index> modes;
    Eigen::MatrixXd c;
    Eigen::VectorXd k;
    std::vector<Eigen::MatrixXd> flows; ///< 3m x 4m over h, h/2, ... h/2^L
    Eigen::VectorXd state, moved;       ///< (q, v, f0, f1); (q, v, mean)
    Eigen::VectorXd t, v, work;         ///< terms of the series
    [[nodiscard]] Eigen::Index size() const { return k.size(); }
    void series(double time);
    void apply(std::size_t level);
  };
  static Block make_block(const System& system, std::vector<Eigen::Index> modes, double step);
  static Eigen::MatrixXd doubled(const Eigen::MatrixXd& flow);

  double step_;
  std::vector<Block> blocks_;
  std::vector<char> coupled_;
};

} // namespace fretwork::transient
