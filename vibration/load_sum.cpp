// SPDX-License-Identifier: GPL-3.0-or-later
#include "vibration/load_sum.hpp"
#include "signals/record.hpp"
#include <algorithm>
#include <cmath>

namespace fretwork::vibration {
namespace {

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

} // namespace

LoadSum::LoadSum(const std::vector<Load>& loads, Eigen::Index modes, double duration, double step,
                 const std::vector<signals::SampledLoad>& sampled, Records records)
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
      polygons_.push_back(records == Records::by_polygon ? polygon_of(load.function, duration, step)
                                                         : std::vector<double>());
      shapes_.resize(shapes_.size() + static_cast<std::size_t>(padded_modes_), 0.0);
      constant_ = constant_ && signals_.back().is_constant();
      bends_ = bends_ || !(signals_.back().is_constant() || !polygons_.back().empty());
    }
    for (Eigen::Index i = 0; i < modes; ++i)
      shapes_[source * padded_modes_ + i] += load.modal_force(i);
  }
  for (kernels::Array* a : {&values_, &first_, &last_, &bend_})
    a->resize(signals_.size());
  for (const signals::SampledLoad& load : sampled)
    if (load.acts())
      sampled_.emplace_back(load);
  constant_ = constant_ && sampled_.empty();
  if (!sampled_.empty())
    sampled_at_end_.resize(static_cast<std::size_t>(padded_modes_));
}

template <std::size_t Count, class OfRandom, class OfOther>
void LoadSum::each(const std::array<double, Count>& times, const OfRandom& of_random,
                   const OfOther& of_other) const {
  const signals::SampleGrid* grid = nullptr; // of the last random signal
  std::array<signals::SampleGrid::Place, Count> places{};
  for (std::size_t k = 0; k < signals_.size(); ++k) {
    const signals::Signal& signal = signals_[k];
    if (!signal.is_random()) {
      of_other(k);
      continue;
    }
    if (!grid || *grid != signal.grid())
      for (std::size_t i = 0; i < Count; ++i)
        places[i] = signal.grid().place(times[i]);
    grid = &signal.grid();
    of_random(k, places);
  }
}

template <class Value> void LoadSum::combine(double time, const Value& value, double* force) {
  each(
      std::array{time}, [&](std::size_t k, const auto& places) { values_[k] = signals_[k].at(places[0]); },
      [&](std::size_t k) { values_[k] = value(k); });
  sum(values_, force);
  for (signals::SampledForce& sampled : sampled_)
    sampled.add(time, force);
}

void LoadSum::at(double time, double* force) { at(time, signals::Signal::window(time, step_), force); }

void LoadSum::at(double time, signals::Signal::Window window, double* force) {
  combine(
      time, [&](std::size_t k) { return signals_[k].over_step(time, step_, window); }, force);
}

void LoadSum::instant(double time, double* force) {
  combine(
      time, [&](std::size_t k) { return signals_[k](time); }, force);
}

void LoadSum::observe(double time, double* force) {
  instant(time, observed_.data());
  std::copy_n(observed_.begin(), modes_, force);
}

signals::InStep LoadSum::in_step(std::size_t signal, double start, double end) const {
  const std::vector<double>& polygon = polygons_[signal];
  if (polygon.empty())
    return signals_[signal].in_step(start, end);
  const auto corner = [&](double time) {
    return polygon[std::min(static_cast<std::size_t>(std::llround(time / step_)), polygon.size() - 1)];
  };
  const double first = corner(start), last = corner(end);
  return {0.5 * (first + last), 0.5 * (last - first), 0.0};
}

void LoadSum::in_step(double start, double end, double* load0, double* load1, double* bend) {
  const auto set = [&](std::size_t k, const signals::InStep& of) {
    first_[k] = of.mean - of.slope;
    last_[k] = of.mean + of.slope;
    bend_[k] = of.bend;
  };
  each(
      signals::lobatto_times(start, end),
      [&](std::size_t k, const auto& places) { set(k, signals_[k].in_step(places)); },
      [&](std::size_t k) { set(k, in_step(k, start, end)); });
  sum(first_, load0);
  sum(last_, load1);
  if (bend)
    sum(bend_, bend);
  if (sampled_.empty())
    return;
  add_sampled(start, load0);
  add_sampled(end, load1);
}

void LoadSum::sum(const kernels::Array& values, double* force) const {
  if (signals_.empty())
    std::fill_n(force, padded_modes_, 0.0);
  else
    kernels::combine(padded_modes_, static_cast<int>(signals_.size()), shapes_.data(), values.data(), force);
}

void LoadSum::add_sampled(double time, double* force) {
  if (time != sampled_time_) {
    std::fill(sampled_at_end_.begin(), sampled_at_end_.end(), 0.0);
    for (signals::SampledForce& sampled : sampled_)
      sampled.add(time, sampled_at_end_.data());
    sampled_time_ = time;
  }
  for (std::size_t i = 0; i < sampled_at_end_.size(); ++i)
    force[i] += sampled_at_end_[i];
}

} // namespace fretwork::vibration
