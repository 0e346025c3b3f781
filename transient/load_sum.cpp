// SPDX-License-Identifier: GPL-3.0-or-later
#include "transient/load_sum.hpp"
#include <algorithm>
#include <cmath>

namespace fretwork::transient {

LoadSum::LoadSum(const std::vector<Load>& loads, Eigen::Index modes, double duration, double step)
    : padded_modes_(kernels::padded(static_cast<int>(modes))), step_(step) {
  std::vector<const TimeFunction*> functions;
  for (const Load& load : loads) {
    if (load.modal_force.isZero(0.0))
      continue;
    const auto same =
        std::find_if(functions.begin(), functions.end(), [&](const auto* f) { return *f == load.function; });
    const auto source = static_cast<std::size_t>(same - functions.begin());
    if (same == functions.end()) {
      functions.push_back(&load.function);
      signals_.emplace_back(load.function, duration);
      const auto* harmonic = std::get_if<Harmonic>(&load.function);
      sines_.push_back(harmonic && step > 0.0 && std::isfinite(step)
                           ? std::optional<GridSine>({*harmonic, 0.5 * step})
                           : std::nullopt);
      shapes_.resize(shapes_.size() + static_cast<std::size_t>(padded_modes_), 0.0);
      constant_ = constant_ && signals_.back().is_constant();
    }
    for (Eigen::Index i = 0; i < modes; ++i)
      shapes_[source * padded_modes_ + i] += load.modal_force(i);
  }
  values_.resize(signals_.size());
}

template <class Value> void LoadSum::combine(double time, const Value& value, double* force) {
  const SampleGrid* grid = nullptr; // of the last random signal: those of a study mostly share one
  SampleGrid::Place place{};
  for (std::size_t k = 0; k < signals_.size(); ++k) {
    const Signal& signal = signals_[k];
    if (!signal.is_random()) {
      values_[k] = value(k);
      continue;
    }
    if (!grid || *grid != signal.grid())
      place = signal.grid().place(time);
    grid = &signal.grid();
    values_[k] = signal.at(place);
  }
  kernels::combine(padded_modes_, static_cast<int>(signals_.size()), shapes_.data(), values_.data(), force);
}

void LoadSum::at(double time, double* force) { at(time, Signal::window(time, step_), force); }

void LoadSum::at(double time, Signal::Window window, double* force) {
  combine(
      time,
      [&](std::size_t k) {
        return sines_[k] ? (*sines_[k])(time) : signals_[k].over_step(time, step_, window);
      },
      force);
}

void LoadSum::instant(double time, double* force) {
  combine(
      time, [&](std::size_t k) { return signals_[k](time); }, force);
}

} // namespace fretwork::transient
