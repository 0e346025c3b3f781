// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The errors of a run by its step, as replays measure them (replays.hpp).
#pragma once
#include <array>
#include <cstddef>

namespace fretwork::transient {

/// Statistics whose errors are measured, summed over time. Rms forces have half the relative error of their squares.
enum ReplayedFigure : std::size_t {
  replayed_work,        ///< J, integral of F_N |v_T| while the contact slides
  replayed_friction,    ///< J, by the slider
  replayed_square,      ///< N2 s, integral of F_N^2
  replayed_impulse,     ///< N s, integral of F_N
  replayed_closed_time, ///< s
  replayed_impacts,
  replayed_figures
};

/// Of one contact.
struct StepError {
  using Figures = std::array<double, replayed_figures>;
  Figures sums{};    ///< over the run, by the times that were replayed, over their length
  Figures errors{};  ///< of these sums, by the step
  Figures spreads{}; ///< standard errors of `errors`
  int parts = 0;     ///< intervals of a step at the end of the run
};

} // namespace fretwork::transient
