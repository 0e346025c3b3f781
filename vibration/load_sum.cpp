// SPDX-License-Identifier: GPL-3.0-or-later
#include "vibration/load_sum.hpp"
#include "signals/record.hpp"
#include <algorithm>
#include <cmath>
#include <numbers>

namespace fretwork::vibration {
namespace {

/// pi f h up to which a polygon is taken to follow a harmonic load.
constexpr double most_corrected = 0.5;
/// Likewise a random one, in intervals of its samples, of which there are 32 a period.
constexpr double most_grid_steps = 5.0;

/// Steps beyond the end of a run, or of a record, after which the last value stays.
constexpr std::size_t corners_beyond = 64;

std::vector<double> polygon_of(const signals::TimeFunction& function, double duration, double step) {
  const auto* table = std::get_if<signals::Table>(&function);
  if (!table || !signals::is_record(*table) || !(signals::mean_interval(*table) < step))
    return {};
  const double end = std::clamp(table->time.back(), 0.0, duration);
  return signals::nearest_polygon(*table, step,
                                  static_cast<std::size_t>(std::ceil(end / step)) + corners_beyond);
}

/// @param half_turn  pi f times the distance of corners
double height_of_corner(double half_turn) {
  return half_turn > 0.0 && half_turn < most_corrected ? std::pow(half_turn / std::sin(half_turn), 2) : 1.0;
}

} // namespace

LoadSum::LoadSum(const std::vector<Load>& loads, Eigen::Index modes, double duration, double step,
                 const std::vector<signals::SampledLoad>& sampled, Corners corners)
    : modes_(modes), padded_modes_(kernels::padded(static_cast<int>(modes))), step_(step),
      observed_(static_cast<std::size_t>(padded_modes_)) {
  std::vector<const signals::TimeFunction*> functions;
  for (const Load& load : loads) {
    if (load.modal_force.isZero(0.0))
      continue;
    const auto same =
        std::find_if(functions.begin(), functions.end(), [&](const auto* f) { return *f == load.function; });
    const auto source = static_cast<std::size_t>(same - functions.begin());
    if (same == functions.end()) {
      functions.push_back(&load.function);
      signals_.emplace_back(load.function, duration);
      const auto* harmonic = std::get_if<signals::Harmonic>(&load.function);
      half_rates_.push_back(harmonic ? std::numbers::pi * harmonic->frequency : 0.0);
      above_.push_back(height_of_corner(half_rates_.back() * step));
      polygons_.push_back(corners == Corners::used ? polygon_of(load.function, duration, step)
                                                   : std::vector<double>());
      shapes_.resize(shapes_.size() + static_cast<std::size_t>(padded_modes_), 0.0);
      constant_ = constant_ && signals_.back().is_constant();
    }
    for (Eigen::Index i = 0; i < modes; ++i)
      shapes_[source * padded_modes_ + i] += load.modal_force(i);
  }
  values_.resize(signals_.size());
  for (const signals::SampledLoad& load : sampled)
    if (load.acts())
      sampled_.emplace_back(load);
  constant_ = constant_ && sampled_.empty();
}

template <class Value, class Place>
void LoadSum::combine(double time, const Place& place_on, const Value& value, double* force) {
  const signals::SampleGrid* grid = nullptr; // of the last random signal: those of a study mostly share one
  signals::SampleGrid::Place place{};
  for (std::size_t k = 0; k < signals_.size(); ++k) {
    const signals::Signal& signal = signals_[k];
    if (!signal.is_random()) {
      values_[k] = value(k);
      continue;
    }
    if (!grid || *grid != signal.grid())
      place = place_on(signal.grid());
    grid = &signal.grid();
    values_[k] = signal.at(place);
  }
  if (signals_.empty())
    std::fill_n(force, padded_modes_, 0.0);
  else
    kernels::combine(padded_modes_, static_cast<int>(signals_.size()), shapes_.data(), values_.data(), force);
  for (signals::SampledForce& sampled : sampled_)
    sampled.add(time, force);
}

void LoadSum::at(double time, double* force) { at(time, signals::Signal::window(time, step_), force); }

void LoadSum::at(double time, signals::Signal::Window window, double* force) {
  combine(
      time, [&](const signals::SampleGrid& grid) { return grid.place(time); },
      [&](std::size_t k) { return signals_[k].over_step(time, step_, window); }, force);
}

void LoadSum::instant(double time, double* force) {
  combine(
      time, [&](const signals::SampleGrid& grid) { return grid.place(time); },
      [&](std::size_t k) { return signals_[k](time); }, force);
}

void LoadSum::observe(double time, double* force) {
  instant(time, observed_.data());
  std::copy_n(observed_.begin(), modes_, force);
}

double LoadSum::above(std::size_t signal, double length) const {
  return length == step_ ? above_[signal] : height_of_corner(half_rates_[signal] * length);
}

void LoadSum::corner(double time, double length, double* force) {
  const signals::Signal::Window window = signals::Signal::window(time, step_);
  const auto corner = static_cast<std::size_t>(std::llround(time / step_));
  combine(
      time,
      [&](const signals::SampleGrid& grid) {
        return length * grid.per_step < most_grid_steps ? grid.corner(time, length) : grid.place(time);
      },
      [&](std::size_t k) {
        return polygons_[k].empty() ? above(k, length) * signals_[k].over_step(time, step_, window)
                                    : polygons_[k][std::min(corner, polygons_[k].size() - 1)];
      },
      force);
}

} // namespace fretwork::vibration
