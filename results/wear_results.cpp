// SPDX-License-Identifier: GPL-3.0-or-later
#include "results/wear_results.hpp"
#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <functional>
#include <map>

namespace fretwork::results {
namespace {

void add(Bounds& sum, const Bounds& of) {
  sum.value += of.value;
  sum.low += of.low;
  sum.high += of.high;
}

/// Ends of the extreme are extremes of the ends: an upper bound of its interval. An end that one of them does not have, such as a depth beyond the
/// geometry, the extreme does not have either.
template <class Better> void take(Bounds& extreme, const Bounds& of, Better better) {
  if (std::isnan(of.value))
    return;
  if (std::isnan(extreme.value)) {
    extreme = of;
    return;
  }
  const auto one = [&](double& at, double candidate) {
    if (std::isnan(candidate) || better(candidate, at))
      at = candidate;
  };
  one(extreme.value, of.value);
  one(extreme.low, of.low);
  one(extreme.high, of.high);
}

constexpr std::array ends{&WearCurves::value, &WearCurves::low, &WearCurves::high};

/// At one time and one end of the intervals.
struct WornAt {
  double volume = no_value, support_volume = no_value, depth = no_value, support_depth = no_value;
};

double larger(double a, double b) { return std::isnan(a) || std::isnan(b) ? no_value : std::max(a, b); }

WornAt worn_at(const std::vector<WearOfSide>& sides, std::vector<double> WearCurves::*end, std::size_t i) {
  WornAt out;
  for (const WearOfSide& side : sides) {
    const WornAt own{(side.volume.*end)[i], (side.support_volume.*end)[i], (side.depth.*end)[i],
                     (side.support_depth.*end)[i]};
    if (std::isnan(own.volume)) // outside its law
      continue;
    out = std::isnan(out.volume)
              ? own
              : WornAt{out.volume + own.volume, out.support_volume + own.support_volume,
                       larger(out.depth, own.depth), larger(out.support_depth, own.support_depth)};
  }
  return out;
}

/// The first of the lives of the sides.
WearLife first_life(const std::vector<WearOfSide>& sides, WearLife WornScar::*life) {
  WearLife out = sides.front().*life;
  for (const WearOfSide& side : sides) {
    const WearLife& own = side.*life;
    if (!std::isnan(own.years.value) && !(own.years.value >= out.years.value))
      out.end = own.end;
    take(out.years, own.years, std::less<>());
  }
  return out;
}

} // namespace

std::string text_of_side(const std::string& name) {
  return name.starts_with("land ") || name.starts_with("facet ") ? name : "side " + name;
}

void combine_sides(WearOfSupport& support) {
  const auto& sides = support.sides;
  support.volume = support.support_volume = support.depth = support.support_depth = {};
  for (const auto end : ends)
    for (std::size_t i = 0; i < support.time.size(); ++i) {
      const WornAt worn = worn_at(sides, end, i);
      (support.volume.*end).push_back(worn.volume);
      (support.support_volume.*end).push_back(worn.support_volume);
      (support.depth.*end).push_back(worn.depth);
      (support.support_depth.*end).push_back(worn.support_depth);
    }
  support.life = first_life(sides, &WornScar::life);
  support.support_life = first_life(sides, &WornScar::support_life);
  double deepest = -1.0;
  for (const WearOfSide& side : sides) {
    if (side.initial_depth > support.initial_depth ||
        (side.initial_depth == support.initial_depth && !(support.initial_years <= side.initial_years))) {
      support.initial_depth = side.initial_depth;
      support.initial_years = std::isnan(side.initial_years) ? support.initial_years : side.initial_years;
    }
    if (!side.outside.empty())
      support.outside +=
          fmt::format("{}{}: {}", support.outside.empty() ? "" : "; ", text_of_side(side.name), side.outside);
    if (const double depth = side.depth.last().value; depth > deepest) {
      deepest = depth;
      support.scar_width = side.scar_width;
      support.scar_length = side.scar_length;
      support.scar_half_angle = side.scar_half_angle;
    }
  }
}

Bounds first_life(const WornScar& scar) {
  Bounds out = scar.life.years;
  take(out, scar.support_life.years, std::less<>());
  return out;
}

std::vector<WearOfTube> wear_by_tube(const std::vector<WearOfSupport>& supports) {
  std::map<std::int64_t, WearOfTube> tubes;
  std::map<std::int64_t, const WearOfSupport*> beyond; // the largest scar beyond its geometry
  for (const WearOfSupport& support : supports) {
    const auto [at, is_new] = tubes.try_emplace(support.tube);
    WearOfTube& tube = at->second;
    tube.tube = support.tube;
    ++tube.supports;
    const wear::WorkRate rates[] = {tube.work_rate, support.work_rate};
    tube.work_rate = is_new ? support.work_rate : wear::sum_of_points(rates);
    if (is_new)
      tube.volume = {0.0, 0.0, 0.0};
    add(tube.volume, support.volume.last());
    const Bounds depth = support.depth.last();
    if (!std::isnan(depth.value) && !(depth.value <= tube.depth.value))
      tube.deepest = support.name;
    take(tube.depth, depth, std::greater<>());
    if (const double volume = support.volume.last().value; std::isnan(depth.value) && volume > 0.0)
      if (const WearOfSupport*& of = beyond[support.tube]; !of || volume > of->volume.last().value)
        of = &support;
    for (const auto& [life, body] :
         {std::pair(&support.life, "tube"), std::pair(&support.support_life, "support")}) {
      const double years = life->years.value;
      if (!life->end.empty() && std::isnan(years))
        ++tube.unknown_lives;
      if (std::isfinite(years) && !(years >= tube.years.value)) {
        tube.first = support.name;
        tube.body = body;
      }
      take(tube.years, life->years, std::less<>());
    }
  }
  for (const auto& [tube, support] : beyond) {
    tubes.at(tube).depth = {};
    tubes.at(tube).deepest = support->name;
  }
  std::vector<WearOfTube> out;
  for (auto& entry : tubes)
    out.push_back(std::move(entry.second));
  return out;
}

} // namespace fretwork::results
