// SPDX-License-Identifier: GPL-3.0-or-later
#include "transient/signals/grid_sine.hpp"
#include <numbers>

namespace fretwork::transient {

static constexpr double full_turn = 2.0 * std::numbers::pi;

GridSine::GridSine(const Harmonic& function, double grid_step)
    : function_(function), step_(grid_step), per_step_(1.0 / grid_step) {
  for (std::int64_t k = 0; k < points; ++k) {
    const double turn = full_turn * function.frequency * (static_cast<double>(k) * grid_step);
    turns_[static_cast<std::size_t>(k)] = {std::cos(turn), std::sin(turn)};
  }
}

double GridSine::angle(double time) const { return full_turn * function_.frequency * time + function_.phase; }

void GridSine::begin(std::int64_t block) {
  const double start = angle(static_cast<double>(block * points) * step_);
  sine_ = function_.amplitude * std::sin(start);
  cosine_ = function_.amplitude * std::cos(start);
  block_ = block;
}

} // namespace fretwork::transient
