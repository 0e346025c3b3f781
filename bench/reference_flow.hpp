// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The modes of the reference solution (reference_solution.hpp) between contact impulses: their exact flow over 2^k steps, from the
/// exponential of their equations. Over one step loads lie on a line that is renewed every 0.03 rad of the fastest load and at each row of
/// a table, over longer flows on a parabola (up to 0.25 rad).
///
/// Modes are sorted by what they move: those along y_loc of any contact first, those along z_loc next; both ranges may overlap.
#pragma once
#include "transient/scene/scene.hpp"
#include <cstdint>
#include <vector>

namespace fretwork::bench {

class ReferenceFlow {
public:
  /// @param step  s   @throws core::Error for loads other than constant, harmonic and random ones and tables without jumps
  ReferenceFlow(const transient::Scene& scene, double step);

  std::vector<double> q, v;
  [[nodiscard]] std::int64_t unit() const { return unit_; } ///< steps since t = 0
  /// Over one step.
  void advance();

  /// Whole steps until the next row of a table: no longer flow has its loads on a parabola.
  [[nodiscard]] std::int64_t steps_to_row();

  [[nodiscard]] int levels() const { return static_cast<int>(flows_.size()); }
  /// Over 2^level steps to far_q and far_v, level > 0.
  void extrapolate(int level);
  /// The state becomes that of the last `extrapolate`.
  void accept();
  std::vector<double> far_q, far_v;

  struct Range {
    std::size_t begin, end;
    [[nodiscard]] std::size_t size() const { return end - begin; }
  };
  [[nodiscard]] Range moving_y() const { return y_; }
  [[nodiscard]] Range moving_z() const { return z_; }
  /// Of a mode of the scene in sorted order.
  [[nodiscard]] const std::vector<Eigen::Index>& order() const { return order_; }

private:
  /// (q, v) by (q, v) and by the load, its first and its second derivative in times of the flow's length.
  struct Table {
    double length; ///< s
    std::vector<double> qq, qv, vq, vv, q0, q1, q2, v0, v1, v2;
  };
  [[nodiscard]] Table table_of(double length) const;
  void sort(const transient::Scene& scene);
  void load_at(double time, std::vector<double>& force) const;
  void renew_line();

  std::size_t n_;
  double h_, duration_;
  std::vector<Eigen::Index> order_;
  Range y_{}, z_{};
  std::vector<double> stiffness_, damping_;
  std::vector<signals::Signal> signals_;
  std::vector<std::vector<double>> shapes_; ///< modal forces
  std::vector<Table> flows_;
  std::vector<double> load_, slope_, middle_, last_;
  std::vector<double> rows_;                               ///< s, of all tables
  std::size_t row_ = 0;                                    ///< the next one
  std::int64_t unit_ = 0, line_left_ = 0, line_steps_ = 1; ///< steps
  int level_ = 0;
};

/// Sum of a[i] b[i].
[[nodiscard]] double inner(std::size_t n, const double* a, const double* b);
/// to[i] += s a[i].
void add(std::size_t n, double s, const double* a, double* to);

} // namespace fretwork::bench
