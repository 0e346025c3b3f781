// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The exact motion of modes that a damping matrix or forces of motion (core/motion_forces.hpp) couple,
///     q'' + C q' + K q = G z + f,   z' = R z + E q'
/// K and C less what the forces of motion add to them, over a step in which f is a polynomial, f = f_0 + f_1 s + .. + f_d s^d with s the share of
/// the step, d = 1 or 2.
///
/// The step is linear: (q, v, z, M_0, .. M_{d-1}) at its end = F (q, v, z, f_0, .. f_d) with the moments M_i = int_0^1 s^i q ds, which the works
/// of forces ask for. Over t with (w_max + |C| + |R| + |G E|^(1/2)) t <= 1 its columns come from Taylor's series of the motion in first-order
/// form, T_j = q^(j) t^j/j!, V_j = v^(j) t^j/j!, Z_j = z^(j) t^j/j!:
///     (j+1) T_{j+1} = t V_j,    (j+1) V_{j+1} = t (f_j - C V_j - K T_j + G Z_j),    (j+1) Z_{j+1} = t (R Z_j + E V_j)
///     q = sum T_j, v = sum V_j, z = sum Z_j, M_i = sum T_j/(j+i+1)
/// and over the step by doubling L times, f the same polynomial all along: scaling and squaring (N. Higham, Functions of Matrices, SIAM 2008,
/// chapter 10) of the flow with its loads. Critical, overdamped, rigid and growing motions are no special cases. The flows
/// of all h/2^l are kept: an instant inside a step is reached by whole halves and one short series.
///
/// A block (system.hpp) of m modes and r states costs ((2+d) m + r)((3+d) m + r) multiplications a step. Modes of no block are left to
/// oscillator.hpp.
#pragma once
#include "vibration/system.hpp"
#include <array>
#include <concepts>
#include <vector>

namespace fretwork::vibration {

class CoupledFlow {
public:
  CoupledFlow() = default;
  /// Of all blocks of the system.
  /// @param degree  d   @param halvings  at least so many halvings of the step can be asked of `advance` and `move`
  explicit CoupledFlow(const System& system, double step, int degree = 1, int halvings = 1);
  /// Of these alone.
  CoupledFlow(const System& system, const std::vector<CoupledBlock>& blocks, double step, int degree = 1,
              int halvings = 1);

  [[nodiscard]] bool empty() const { return blocks_.empty(); }
  [[nodiscard]] bool couples(Eigen::Index mode) const {
    return !blocks_.empty() && coupled_[static_cast<std::size_t>(mode)];
  }

  /// Motion of the coupled modes over a step; q, v and loads hold all modes, z all states (null: there are none). No allocation.
  /// Of degree 1.
  /// @param halvings  over step/2^halvings   @return work of the loads, J
  double advance(int halvings, double* q, double* v, const double* f0, const double* f1, double* z = nullptr);

  /// Motion of the coupled modes, without states, over step/2^halvings from q0, v0 (all modes). No allocation.
  /// @param force  force(mode, j): f_j   @param take  take(mode, q, v, moments): moments[i] = M_i of the mode
  template <class Force, class Take>
  void move(int halvings, const double* q0, const double* v0, const Force& force, const Take& take) {
    for (Block& b : blocks_) {
      start(b, q0, v0, nullptr);
      load(b, force);
      b.apply(static_cast<std::size_t>(halvings));
      give(b, take);
    }
  }

  /// State of the coupled modes a time 0 <= t <= step after q0, v0, z0 (null: there are no states). No allocation.
  /// @param force  force(mode, j, from, length): f_j of the force between `from` and `from + length`, s
  template <std::invocable<Eigen::Index, int, double, double> Force>
  void inside(double t, const double* q0, const double* v0, const Force& force, double* q, double* v,
              const double* z0 = nullptr) {
    for (Block& b : blocks_) {
      const auto load_between = [&](double from, double length) {
        load(b, [&](Eigen::Index mode, int j) { return force(mode, j, from, length); });
      };
      start(b, q0, v0, z0);
      double at = 0.0, length = step_;
      for (std::size_t level = 0; level < b.flows.size(); ++level, length *= 0.5)
        if (t - at >= length) {
          load_between(at, length);
          b.apply(level);
          b.state.head(b.unknowns()) = b.moved.head(b.unknowns());
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
              double* v, const double* z0 = nullptr);
  /// Adds the forces of motion where `inside` was last. No allocation.
  void add_forces(double* force) const;

private:
  static constexpr int most_degree = 2;
  struct Block : CoupledBlock {
    Eigen::MatrixXd k, c; ///< m x m
    Eigen::MatrixXd input, rates, output;
    Eigen::MatrixXd forces;                ///< of motion, m x (2m + r)
    std::vector<Eigen::MatrixXd> flows;    ///< over h, h/2, ... h/2^L
    Eigen::VectorXd state, moved;          ///< (q, v, z, f_0, .. f_d); (q, v, z, M_0, .. M_{d-1})
    Eigen::VectorXd t, v, z, work, z_rate; ///< terms of the series
    [[nodiscard]] Eigen::Index size() const { return k.rows(); }
    [[nodiscard]] Eigen::Index unknowns() const { return 2 * size() + rates.rows(); }
    void series(double time);
    void apply(std::size_t level) { moved.noalias() = flows[level] * state; }
  };
  static void start(Block& b, const double* q, const double* v, const double* z);
  template <class Force> void load(Block& b, const Force& force) const {
    for (int j = 0; j <= degree_; ++j)
      for (Eigen::Index i = 0; i < b.size(); ++i)
        b.state(b.unknowns() + j * b.size() + i) = force(b.modes[static_cast<std::size_t>(i)], j);
  }
  template <class Take> void give(const Block& b, const Take& take) const {
    std::array<double, most_degree> moments{};
    for (Eigen::Index i = 0, m = b.size(); i < m; ++i) {
      for (int j = 0; j < degree_; ++j)
        moments[static_cast<std::size_t>(j)] = b.moved(b.unknowns() + j * m + i);
      take(b.modes[static_cast<std::size_t>(i)], b.moved(i), b.moved(m + i), moments);
    }
  }
  [[nodiscard]] Block make_block(const System& system, const CoupledBlock& of, int halvings) const;
  [[nodiscard]] Eigen::MatrixXd doubled(const Block& b, const Eigen::MatrixXd& flow) const;

  double step_ = 0.0;
  int degree_ = 1;
  std::vector<Block> blocks_;
  std::vector<char> coupled_;
};

} // namespace fretwork::vibration
