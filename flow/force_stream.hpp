// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The modal forces of a random draw as a function of time: linear between samples, with a smooth start
///     F(t) = ramp(t) Q(t),   ramp = (1 - cos(pi t/T_r))/2 up to T_r, 1 from there
/// Statistics start when the response to the start has decayed, T_r + 3/(xi_1 w_1).
#pragma once
#include "flow/draws.hpp"

namespace fretwork::flow {

/// T_r, s: 5 periods of the lowest mode.  @param lowest_frequency  Hz, > 0
[[nodiscard]] double ramp_time(double lowest_frequency);
/// s.  @param damping, omega  of the mode that decays most slowly: ratio, rad/s, both > 0
[[nodiscard]] double statistics_start(double ramp_time, double damping, double omega);
/// Relative standard deviation of the mean square of a mode's displacement over n draws of length T: 1/sqrt(xi w T n).
[[nodiscard]] double mean_square_scatter(double damping, double omega, double duration, int draws);

class ForceStream {
public:
  /// @param ramp  T_r, s, >= 0; 0: none   @throws core::Error  a ramp that is negative
  ForceStream(ForceDraw draw, double ramp);

  [[nodiscard]] Eigen::Index modes() const { return draw_.modes(); }
  /// Between samples, s.
  [[nodiscard]] double step() const { return draw_.step(); }
  /// Modal forces, N times the unit of the shapes. Costs a copy of two samples; every 64 samples these are read from the draw, and every
  /// block that begins is computed. Times may go back by less than a block without cost.
  /// @param time  s, >= 0   @param force  modes
  void at(double time, double* force);

private:
  ForceDraw draw_;
  double ramp_, per_step_;
  std::int64_t first_ = -1; ///< sample of the first column
  Eigen::MatrixXd samples_; ///< modes x window
};

} // namespace fretwork::flow
