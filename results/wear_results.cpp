// SPDX-License-Identifier: GPL-3.0-or-later
#include "results/wear_results.hpp"
#include <algorithm>
#include <cmath>
#include <map>

namespace fretwork::results {
namespace {

void add(Bounds& sum, const Bounds& of) {
  sum.value += of.value;
  sum.low += of.low;
  sum.high += of.high;
}

/// Ends of the extreme are extremes of the ends: an upper bound of its interval.
template <class Better> void take(Bounds& extreme, const Bounds& of, Better better) {
  if (std::isnan(of.value))
    return;
  const auto one = [&](double& at, double candidate) {
    if (std::isnan(at) || better(candidate, at))
      at = candidate;
  };
  one(extreme.value, of.value);
  one(extreme.low, of.low);
  one(extreme.high, of.high);
}

} // namespace

std::vector<WearOfTube> wear_by_tube(const std::vector<WearOfSupport>& supports) {
  std::map<std::int64_t, WearOfTube> tubes;
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
    if (!std::isnan(support.life.years.value) && !(support.life.years.value >= tube.years.value))
      tube.first = support.name;
    take(tube.years, support.life.years, std::less<>());
  }
  std::vector<WearOfTube> out;
  for (auto& entry : tubes)
    out.push_back(std::move(entry.second));
  return out;
}

} // namespace fretwork::results
