// SPDX-License-Identifier: GPL-3.0-or-later
#include "signals/prescribed_motion.hpp"
#include "signals/table_curve.hpp"
#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <type_traits>
#include <utility>

namespace fretwork::signals {
namespace {

/// Constant: s = s0 + v0 t + a t^2/2.
MotionState uniform(const PrescribedMotion& m, double acceleration, double t) {
  return {m.displacement0 + t * (m.velocity0 + 0.5 * acceleration * t), m.velocity0 + acceleration * t};
}

/// (x - sin x)/x^2, x >= 0; below 0.1 by its series, where the difference has lost three digits.
double odd_part(double x) {
  if (x >= 0.1)
    return (x - std::sin(x)) / (x * x);
  const double x2 = x * x;
  return x / 6.0 * (1.0 - x2 / 20.0 * (1.0 - x2 / 42.0 * (1.0 - x2 / 72.0)));
}

/// a = A sin(w t + p) = A (cos p sin w t + sin p cos w t):
///     s' = v0 + A t sin(w t/2 + p) sin(w t/2)/(w t/2),    s = s0 + v0 t + A t^2 (cos p (x - sin x)/x^2 + sin p (1 - cos x)/x^2), x = w t
MotionState harmonic(const PrescribedMotion& m, const Harmonic& f, double t) {
  const double half = std::numbers::pi * f.frequency * t;
  const double share = half > 0.0 ? std::sin(half) / half : 1.0;
  const double drift = std::cos(f.phase) * odd_part(2.0 * half) + 0.5 * std::sin(f.phase) * share * share;
  return {m.displacement0 + t * (m.velocity0 + f.amplitude * t * drift),
          m.velocity0 + f.amplitude * t * share * std::sin(half + f.phase)};
}

/// The acceleration of the curve through a table (table_curve.hpp), and how it stands at t = 0.
PrescribedMotion along_curve(const Table& table) {
  const std::size_t last = table.time.size() - 1;
  const double first = table.time.front();
  if (last == 0)
    return {Table{{0.0}, {0.0}}, 0.0, table.value.front()};
  const std::vector<double> slope = shape_preserving_slopes(table);
  Table acceleration{{first}, {0.0}};
  PrescribedMotion out{Table{}, 0.0, first > 0.0 ? table.value.front() : table.value.back()};
  for (std::size_t i = 0; i < last; ++i) {
    const double h = table.time[i + 1] - table.time[i], chord = (table.value[i + 1] - table.value[i]) / h;
    const double begin = (6.0 * chord - 4.0 * slope[i] - 2.0 * slope[i + 1]) / h,
                 end = (-6.0 * chord + 2.0 * slope[i] + 4.0 * slope[i + 1]) / h;
    acceleration.time.insert(acceleration.time.end(), {table.time[i], table.time[i + 1]});
    acceleration.value.insert(acceleration.value.end(), {begin, end});
    if (const double t = -table.time[i]; t >= 0.0 && t < h) {
      const double third = (end - begin) / h;
      out.velocity0 = slope[i] + t * (begin + 0.5 * t * third);
      out.displacement0 = table.value[i] + t * (slope[i] + t * (0.5 * begin + t * third / 6.0));
    }
  }
  acceleration.time.push_back(table.time.back());
  acceleration.value.push_back(0.0);
  out.acceleration = std::move(acceleration);
  return out;
}

} // namespace

PrescribedMotion motion_of_displacement(const TimeFunction& displacement) {
  if (const auto* constant = std::get_if<Constant>(&displacement))
    return {Constant{0.0}, 0.0, constant->value};
  if (const auto* s = std::get_if<Harmonic>(&displacement)) {
    const double w = 2.0 * std::numbers::pi * s->frequency;
    return {Harmonic{-w * w * s->amplitude, s->frequency, s->phase}, w * s->amplitude * std::cos(s->phase),
            s->amplitude * std::sin(s->phase)};
  }
  assert(std::holds_alternative<Table>(displacement));
  return along_curve(std::get<Table>(displacement));
}

TimeFunction velocity_of(const PrescribedMotion& motion) {
  Integral out{Constant{0.0}, motion.velocity0};
  const auto take = [&](const auto& acceleration) {
    if constexpr (std::is_same_v<std::decay_t<decltype(acceleration)>, Integral>)
      assert(false);
    else
      out.function = acceleration;
  };
  std::visit(take, motion.acceleration);
  return out;
}

MotionState MotionSignal::Piece::at(double time) const {
  const double x = (time - start) / length;
  const double once = x * (c0 + x * (c1 / 2.0 + x * (c2 / 3.0 + x * c3 / 4.0)));
  const double twice = x * x * (c0 / 2.0 + x * (c1 / 6.0 + x * (c2 / 12.0 + x * c3 / 20.0)));
  return {before.displacement + length * (before.velocity * x + length * twice),
          before.velocity + length * once};
}

MotionSignal::MotionSignal(const PrescribedMotion& motion, double duration)
    : motion_(motion), signal_(motion.acceleration, duration) {
  if (const auto* table = std::get_if<Table>(&motion_.acceleration))
    cut(*table);
  if (std::holds_alternative<Random>(motion_.acceleration)) {
    at_grid_ = {{motion_.displacement0, motion_.velocity0}};
    const double h = signal_.grid_step();
    for (std::size_t j = 0; static_cast<double>(j) * h < duration; ++j)
      at_grid_.push_back(grid_piece(j).at(static_cast<double>(j + 1) * h));
  }
}

MotionState MotionSignal::operator()(double time) const {
  if (const auto* constant = std::get_if<Constant>(&motion_.acceleration))
    return uniform(motion_, constant->value, time);
  if (const auto* f = std::get_if<Harmonic>(&motion_.acceleration))
    return harmonic(motion_, *f, time);
  if (!at_grid_.empty()) {
    const auto j = static_cast<std::size_t>(std::max(0.0, time / signal_.grid_step()));
    return grid_piece(std::min(j, at_grid_.size() - 1)).at(time);
  }
  const auto after = std::upper_bound(pieces_.begin() + 1, pieces_.end(), time,
                                      [](double t, const Piece& p) { return t < p.start; });
  return (after - 1)->at(time);
}

/// The pieces between t = 0 and the table's points after it; the last is constant and has no end.
void MotionSignal::cut(const Table& table) {
  double time = 0.0, value = signal_(0.0);
  for (std::size_t i = 0; i < table.time.size(); ++i) {
    if (!(table.time[i] > 0.0))
      continue;
    if (table.time[i] > time)
      append(time, table.time[i] - time, value, table.value[i]);
    time = table.time[i];
    value = table.value[i];
  }
  append(time, 1.0, value, value);
}

void MotionSignal::append(double start, double length, double first, double last) {
  const MotionState before =
      pieces_.empty() ? MotionState{motion_.displacement0, motion_.velocity0} : pieces_.back().at(start);
  pieces_.push_back({start, length, first, last - first, 0.0, 0.0, before});
}

/// The Hermite cubic of a random signal between two samples.
MotionSignal::Piece MotionSignal::grid_piece(std::size_t number) const {
  const double h = signal_.grid_step();
  const double* p = signal_.samples().data() + 2 * number; // value, slope, next value, next slope
  const double difference = p[2] - p[0];
  return {static_cast<double>(number) * h,
          h,
          p[0],
          p[1],
          3.0 * difference - 2.0 * p[1] - p[3],
          p[1] + p[3] - 2.0 * difference,
          at_grid_[number]};
}

} // namespace fretwork::signals
