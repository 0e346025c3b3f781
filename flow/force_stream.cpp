// SPDX-License-Identifier: GPL-3.0-or-later
#include "flow/force_stream.hpp"
#include "core/error.hpp"
#include <cassert>
#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace fretwork::flow {
namespace {

constexpr std::int64_t window = 64;  ///< intervals between samples that are read together
constexpr double ramp_periods = 5.0; ///< of the lowest mode
constexpr double decay_times = 3.0;  ///< of a mode's amplitude: 5 % of its start is left

} // namespace

double ramp_time(double lowest_frequency) {
  if (!(lowest_frequency > 0.0) || !std::isfinite(lowest_frequency))
    throw core::Error(
        fmt::format("a lowest frequency of {:g} Hz gives no ramp; give one > 0", lowest_frequency));
  return ramp_periods / lowest_frequency;
}

double statistics_start(double ramp_time, double damping, double omega) {
  if (!(damping > 0.0) || !(omega > 0.0))
    throw core::Error(fmt::format("a mode of damping ratio {:g} and {:g} rad/s does not decay; give both > 0",
                                  damping, omega));
  return ramp_time + decay_times / (damping * omega);
}

double mean_square_scatter(double damping, double omega, double duration, int draws) {
  return 1.0 / std::sqrt(damping * omega * duration * draws);
}

ForceStream::ForceStream(ForceDraw draw, double ramp)
    : draw_(std::move(draw)), ramp_(ramp), per_step_(1.0 / draw_.step()),
      samples_(draw_.modes(), window + 1) {
  if (!(ramp >= 0.0) || !std::isfinite(ramp))
    throw core::Error(fmt::format("a ramp of {:g} s makes no sense; give a time >= 0", ramp));
}

void ForceStream::at(double time, double* force) {
  assert(time >= 0.0);
  const double place = time * per_step_;
  const auto sample = static_cast<std::int64_t>(place);
  if (const std::int64_t first = sample / window * window; first != first_) {
    draw_.fill(first, samples_);
    first_ = first;
  }
  const double share = place - static_cast<double>(sample);
  const double start = time < ramp_ ? 0.5 * (1.0 - std::cos(std::numbers::pi * time / ramp_)) : 1.0;
  const Eigen::Index column = sample - first_;
  Eigen::Map<Eigen::VectorXd>(force, modes()) =
      (start * (1.0 - share)) * samples_.col(column) + (start * share) * samples_.col(column + 1);
}

} // namespace fretwork::flow
