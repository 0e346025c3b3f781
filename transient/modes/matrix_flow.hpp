// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The exact motion of modes that a damping matrix couples, q'' + C q' + K q = f, over a step in which f is a polynomial,
/// f = f_0 + f_1 s + .. + f_d s^d with s the share of the step, d = 1 or 2.
///
/// The step is linear: (q, v, M_0, .. M_{d-1}) at its end = F (q, v, f_0, .. f_d) with the moments M_i = int_0^1 s^i q ds, which the works
/// of forces ask for. Over t with (w_max + |C|) t <= 1 its columns come from Taylor's series of the motion in first-order form,
/// T_j = q^(j) t^j/j!, V_j = v^(j) t^j/j!:
///     (j+1) T_{j+1} = t V_j,    (j+1) V_{j+1} = t (f_j - C V_j - K T_j),    q = sum T_j, v = sum V_j, M_i = sum T_j/(j+i+1)
/// and over the step by doubling L times, f the same polynomial all along: scaling and squaring (N. Higham, Functions of Matrices, SIAM 2008,
/// chapter 10) of the flow with its loads. C >= 0 is arbitrary: critical, overdamped and rigid motions are no special cases. The flows
/// of all h/2^l are kept: an instant inside a step is reached by whole halves and one short series.
///
/// Modes that C couples, directly or through others, make a block; a block of m modes costs (2+d)(3+d) m^2 multiplications a step. The
/// others are left to oscillator.hpp.
#pragma once
#include "transient/scene/scene.hpp"
#include <array>
#include <vector>

namespace fretwork::transient {

/// The system for its modes that the damping matrix does not couple: `damping` is the matrix's diagonal, where there is one.
[[nodiscard]] System with_diagonal(System system);

class MatrixFlow {
public:
  /// @param step  s; without a damping matrix, or with a diagonal one, no mode is coupled
  /// @param degree  d   @param halvings  at least so many halvings of the step can be asked of `advance` and `move`
  explicit MatrixFlow(const System& system, double step, int degree = 1, int halvings = 1);

  [[nodiscard]] bool empty() const { return blocks_.empty(); }
  [[nodiscard]] bool couples(Eigen::Index mode) const {
    return !blocks_.empty() && coupled_[static_cast<std::size_t>(mode)];
  }

  /// Motion of the coupled modes over a step; q, v and loads hold all modes. Null loads: none. No allocation.
  /// Of degree 1.
  /// @param halvings  over step/2^halvings   @return work of the loads, J
  double advance(int halvings, double* q, double* v, const double* f0, const double* f1);

  /// Motion of the coupled modes over step/2^halvings from q0, v0 (all modes). No allocation.
  /// @param force  force(mode, j): f_j   @param take  take(mode, q, v, moments): moments[i] = M_i of the mode
  template <class Force, class Take>
  void move(int halvings, const double* q0, const double* v0, const Force& force, const Take& take) {
    std::array<double, most_degree> moments{};
    for (Block& b : blocks_) {
      start(b, q0, v0);
      load(b, force);
      b.apply(static_cast<std::size_t>(halvings));
      for (Eigen::Index i = 0, m = b.size(); i < m; ++i) {
        for (int j = 0; j < degree_; ++j)
          moments[static_cast<std::size_t>(j)] = b.moved((2 + j) * m + i);
        take(b.modes[static_cast<std::size_t>(i)], b.moved(i), b.moved(m + i), moments);
      }
    }
  }

  /// State of the coupled modes a time 0 <= t <= step after q0, v0. No allocation.
  /// @param force  force(mode, j, from, length): f_j of the force between `from` and `from + length`, s
  template <class Force>
  void inside(double t, const double* q0, const double* v0, const Force& force, double* q, double* v) {
    for (Block& b : blocks_) {
      const auto load_between = [&](double from, double length) {
        load(b, [&](Eigen::Index mode, int j) { return force(mode, j, from, length); });
      };
      start(b, q0, v0);
      double at = 0.0, length = step_;
      for (std::size_t level = 0; level < b.flows.size(); ++level, length *= 0.5)
        if (t - at >= length) {
          load_between(at, length);
          b.apply(level);
          b.state.head(2 * b.size()) = b.moved.head(2 * b.size());
          at += length;
        }
      load_between(at, t - at);
      b.series(t - at);
      for (Eigen::Index i = 0; i < b.size(); ++i) {
        q[b.modes[static_cast<std::size_t>(i)]] = b.moved(i);
        v[b.modes[static_cast<std::size_t>(i)]] = b.moved(b.size() + i);
      }
    }
  }
  /// The same under the load f0 + t slope (null: none), of degree 1.
  void inside(double t, const double* q0, const double* v0, const double* f0, const double* slope, double* q,
              double* v);

private:
  static constexpr int most_degree = 2;
  struct Block {
    std::vector<Eigen::Index> modes;
    Eigen::MatrixXd c;
    Eigen::VectorXd k;
    std::vector<Eigen::MatrixXd> flows; ///< (2+d)m x (3+d)m over h, h/2, ... h/2^L
    Eigen::VectorXd state, moved;       ///< (q, v, f_0, .. f_d); (q, v, M_0, .. M_{d-1})
    Eigen::VectorXd t, v, work;         ///< terms of the series
    [[nodiscard]] Eigen::Index size() const { return k.size(); }
    void series(double time);
    void apply(std::size_t level);
  };
  static void start(Block& b, const double* q, const double* v);
  template <class Force> void load(Block& b, const Force& force) const {
    for (int j = 0; j <= degree_; ++j)
      for (Eigen::Index i = 0; i < b.size(); ++i)
        b.state((2 + j) * b.size() + i) = force(b.modes[static_cast<std::size_t>(i)], j);
  }
  [[nodiscard]] Block make_block(const System& system, std::vector<Eigen::Index> modes, int halvings) const;
  [[nodiscard]] Eigen::MatrixXd doubled(const Eigen::MatrixXd& flow) const;

  double step_;
  int degree_;
  std::vector<Block> blocks_;
  std::vector<char> coupled_;
};

} // namespace fretwork::transient
