// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// One step of the Runge-Kutta pair of J. R. Dormand and P. J. Prince (J. Comp. Appl. Math. 6 (1980) 19): order 5, error estimate of order
/// 4, seven stages of which the last is the first of the next step. Between the ends the continuous extension of order 4 of E. Hairer,
/// S. P. Norsett, G. Wanner (Solving Ordinary Differential Equations I, 2nd ed., section II.6), theta = the share of the step:
///     y = r_0 + theta (r_1 + (1 - theta)(r_2 + theta (r_3 + (1 - theta) r_4)))
#pragma once
#include "core/state_archive.hpp"
#include "kernels/kernels.hpp"
#include <array>

namespace fretwork::transient {

class MotionRates;

class DormandPrince {
public:
  static constexpr int stages = 7, terms = 5;

  explicit DormandPrince(int size);

  /// State at the start of the step, then that at its end until `advance`.
  [[nodiscard]] double* start() { return y0_.data(); }
  [[nodiscard]] double* end() { return y1_.data(); }
  /// Rate at the start, to be given before the first try.
  [[nodiscard]] double* start_rate() { return k_[0].data(); }

  /// Tries a step; the last evaluation is at its end. `evaluations` of the rates.
  static constexpr int evaluations = stages - 1;
  void make(MotionRates& rates, double time, double h);
  /// Estimated error of the end, component by component.
  const double* error(double h);
  /// Prepares `terms` for the step tried last.
  void extend(double h);
  [[nodiscard]] const double* term(int j) const { return r_[static_cast<std::size_t>(j)].data(); }
  /// The state at a share of the step, of the extension.
  void inside(double share, kernels::Array& y) const;
  /// Factor of each term at a share of the step.
  [[nodiscard]] static std::array<double, terms> factors(double share);
  /// The end becomes the start; its rate is the last stage's.
  void advance();
  void visit(core::StateArchive& state) { state(y0_, y1_, k_, r_); }

private:
  void combine(const double* factors, int count, double h, kernels::Array& target);

  kernels::Array y0_, y1_, error_;
  std::array<kernels::Array, stages> k_;
  std::array<kernels::Array, terms> r_;
  std::array<const double*, stages> rows_{};
  std::array<double, stages> scaled_{};
};

} // namespace fretwork::transient
