// SPDX-License-Identifier: GPL-3.0-or-later
#include "synthetic.hpp"
#include "wear/laws.hpp"
#include <cmath>
#include <fmt/format.h>

namespace fretwork::results {
namespace {

constexpr double coefficient = 2e-14; // m2/N
constexpr double years = 40.0;
constexpr double radius = 9.525e-3, tube_length = 0.02; // m

/// Of a flat bar, small depths: V = (4/3) sqrt(2 R) B p^1.5.
double depth_of(double volume) {
  return std::pow(0.75 * volume / (std::sqrt(2.0 * radius) * tube_length), 2.0 / 3.0);
}

void add_curves(WearOfSupport& s, double rate, std::vector<double> WearCurves::*which) {
  for (const double time : s.time) {
    const double volume = coefficient * rate * time;
    (s.volume.*which).push_back(volume);
    (s.support_volume.*which).push_back(0.5 * volume);
    (s.depth.*which).push_back(depth_of(1.5 * volume) / 1.5);
    (s.support_depth.*which).push_back(depth_of(1.5 * volume) / 3.0);
  }
}

void set_outside(WearOfSupport& s) {
  s.law = "edf_mz";
  s.coefficient = no_value;
  s.source = "constants of the law";
  s.outside = "edf_mz does not apply: V0 is below S";
  for (WearCurves* curves : {&s.volume, &s.support_volume, &s.depth, &s.support_depth})
    for (auto* list : {&curves->value, &curves->low, &curves->high})
      list->assign(s.time.size(), no_value);
  s.life = {"outside_law", {}};
  s.scar_width = s.scar_length = s.scar_half_angle = no_value;
}

WearOfSupport support(const RunResults& results, std::size_t c) {
  WearOfSupport s;
  s.name = results.contacts[c].name;
  s.contacts = {static_cast<std::int64_t>(c)};
  s.node = results.contacts[c].node;
  s.law = "archard";
  s.source = "690_405 on flat_bar: made up";
  s.coefficient = coefficient;
  s.support_coefficient = 0.5 * coefficient;
  s.geometry = "flat_bar";
  s.form = "exact";
  s.radius = radius;
  s.wall = 1.09e-3;
  s.length = tube_length;
  s.limit = 0.4 * s.wall;
  const double rate = 1e-4 * static_cast<double>(c + 1);
  s.states = {{"this run", 0.75, wear::work_rate_between(rate, 1.2 * rate, 1.4 * rate)},
              {"state 2", 0.25, wear::work_rate(0.4 * rate)}};
  s.work_rate = wear::work_rate_between(0.85 * rate, rate, 1.15 * rate);
  for (int k = 0; k <= 40; ++k)
    s.time.push_back(years * wear::year * k / 40);
  add_curves(s, rate, &WearCurves::value);
  add_curves(s, s.work_rate.low, &WearCurves::low);
  add_curves(s, s.work_rate.high, &WearCurves::high);
  s.scar_width = 2.0 * std::sqrt(2.0 * radius * (s.depth.last().value + s.support_depth.last().value));
  s.scar_length = tube_length;
  s.scar_half_angle = 0.5 * s.scar_width / radius;
  s.life = {"reached", {0.05 / rate, 0.05 / s.work_rate.high, 0.05 / s.work_rate.low}};
  for (int k = 0; k < 36; ++k)
    s.sector_rates.push_back(rate / 36.0 * (1.0 + std::cos(0.1745 * k)));
  if (c == 2)
    set_outside(s);
  if (c == 3) {
    s.life = {"never", {}};
    s.life.years = {std::numeric_limits<double>::infinity(), 123.5, std::numeric_limits<double>::infinity()};
    s.support_life = {"reached", {77.0, 66.0, 88.0}};
    s.support_limit = 1e-3;
    s.initial_depth = 1e-4;
    s.initial_years = 4.5;
    s.sector_depth.assign(36, 1e-5);
    s.sector_support_depth.assign(36, 2e-5);
  }
  return s;
}

} // namespace

Wear made_up_wear(const RunResults& results) {
  Wear wear;
  for (std::size_t c = 0; c < results.contacts.size(); ++c)
    wear.supports.push_back(support(results, c));
  wear.tubes = wear_by_tube(wear.supports);
  GapOpening& opening = wear.opening.emplace();
  opening.end = "life_reached";
  opening.time = {5.0 * wear::year, 12.5 * wear::year};
  for (std::size_t c = 0; c < results.contacts.size(); ++c) {
    const double rate = 1e-4 * static_cast<double>(c + 1);
    const auto figures = [](double a, double b) {
      return WearCurves{{a, b}, {0.9 * a, 0.8 * b}, {1.1 * a, 1.2 * b}};
    };
    opening.supports.push_back(
        {{2e-4, 2.5e-4},
         figures(rate, 1.5 * rate),
         figures(1e-4, 3e-4),
         figures(5e-5, 1.5e-4),
         {"reached",
          {12.5 / (static_cast<double>(c) + 1.0), 10.0 / (static_cast<double>(c) + 1.0),
           15.0 / (static_cast<double>(c) + 1.0)}}});
    if (c == 3)
      opening.supports.back().support_life = {"reached", {55.0, 44.0, 66.0}};
  }
  return wear;
}

} // namespace fretwork::results
