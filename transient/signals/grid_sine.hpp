// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// sin(2 pi f t + phase) at the points t = k d of a grid: the sine and the cosine at the first point of a block of points, turned by tables.
/// As near as round-off of the angle lets it be. What it gives depends on t alone, not on what it gave before.
#pragma once
#include "transient/signals/time_function.hpp"
#include <array>
#include <cmath>
#include <cstdint>

namespace fretwork::transient {

class GridSine {
public:
  /// @param grid_step  d, s, finite and > 0
  GridSine(const Harmonic& function, double grid_step);

  /// At any instant: off the grid, by more than round-off, the sine itself.
  [[nodiscard]] double operator()(double time) {
    const double position = time * per_step_;
    if (!(position >= 0.0 && position < most))
      return function_.amplitude * std::sin(angle(time));
    const auto k = static_cast<std::int64_t>(position + 0.5);
    if (!(std::abs(position - static_cast<double>(k)) <= round_off * position))
      return function_.amplitude * std::sin(angle(time));
    if (const std::int64_t block = k / points; block != block_)
      begin(block);
    const auto& [cosine, sine] = turns_[static_cast<std::size_t>(k % points)];
    return sine_ * cosine + cosine_ * sine;
  }

private:
  static constexpr std::int64_t points = 64; ///< of a block
  static constexpr double round_off = 1e-15, most = 0x1p52;
  struct Turn {
    double cosine, sine;
  };
  [[nodiscard]] double angle(double time) const;
  void begin(std::int64_t block);

  Harmonic function_;
  double step_, per_step_; ///< s; 1/s
  std::array<Turn, points> turns_;
  std::int64_t block_ = -1;
  double sine_ = 0.0, cosine_ = 0.0; ///< times the amplitude, at the first point of the block
};

} // namespace fretwork::transient
