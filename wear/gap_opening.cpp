// SPDX-License-Identifier: GPL-3.0-or-later
#include "wear/gap_opening.hpp"
#include "core/error.hpp"
#include "wear/check.hpp"
#include "wear/root.hpp"
#include "wear/sectors.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace fretwork::wear {

namespace {

constexpr double root_error = 1e-12; ///< of a depth from a bracketed root
constexpr double limit_error = 1e-9; ///< of the depth at the time to the limit
/// A time to the limit is looked for between these, s, in steps of a factor.
constexpr double first_look = 0.01 * year, last_look = 1e9 * year, look_factor = 1.05;

/// A place with its rates of wear.
struct Wearing {
  const Place& place;
  const PlaceState& state;
  WornVolume tube, support;

  /// Depths of volumes since both were new.
  [[nodiscard]] std::optional<PairDepth> depth_of(double tube_volume, double support_volume) const {
    return depths(place.support.pairing, tube_volume, support_volume);
  }
  [[nodiscard]] double tube_volume(double time) const {
    return AgedVolume{tube, state.age, state.tube_volume}.at(time);
  }
  [[nodiscard]] double support_volume(double time) const {
    return AgedVolume{support, state.age, state.support_volume}.at(time);
  }
  [[nodiscard]] std::optional<PairDepth> depth(double time) const {
    return depth_of(tube_volume(time), support_volume(time));
  }
  [[nodiscard]] bool wears() const { return tube.initial_rate > 0.0 || support.initial_rate > 0.0; }
};

struct Allowed {
  double growth; ///< m
  AdvanceLimit limit;
};

Allowed allowed_growth(const Wearing& at, const AdvanceOptions& options) {
  const double wall = at.place.support.wall;
  const double by_gap = options.gap_share * at.state.gap, by_wall = options.wall_share * wall;
  const double least = options.least_wall_share * wall;
  if (by_gap < least)
    return {least, AdvanceLimit::least};
  return by_gap < by_wall ? Allowed{by_gap, AdvanceLimit::gap} : Allowed{by_wall, AdvanceLimit::wall};
}

/// Time until `excess` is 0, where it comes before `time`.
bool shorten(double& time, const Function& excess) {
  if (!(excess(time) > 0.0))
    return false;
  time = excess(0.0) >= 0.0 ? 0.0 : root(excess, 0.0, time);
  return true;
}

/// T of one place on its own makes `out` shorter.
void limit_by(const Wearing& at, std::size_t place, const AdvanceOptions& options, Advance& out) {
  const double before = at.state.depth.total();
  const Allowed allowed = allowed_growth(at, options);
  if (shorten(out.time, [&](double time) {
        const auto depth = at.depth(time);
        // beyond the geometry: as deep as it describes; if even that is allowed, described_state_after refuses
        return (depth ? depth->total() : largest_depth(at.place.support.pairing)) - before - allowed.growth;
      })) {
    out.limit = allowed.limit;
    out.place = place;
    out.progress = Progress::go_on;
  }
  const double limit = limit_of(at.place.support, WornBody::tube);
  const auto life = [&](double time) {
    const auto depth = at.depth(time);
    return depth ? depth->tube - limit : -limit;
  };
  if (shorten(out.time, life) || life(out.time) >= -root_error * limit) {
    out.limit = AdvanceLimit::life;
    out.place = place;
    out.progress = Progress::life_reached;
  }
}

void check(const AdvanceOptions& options) {
  check_positive("gap opening", "horizon", options.horizon, "s");
  check_positive("gap opening", "gap_share", options.gap_share, "");
  check_positive("gap opening", "wall_share", options.wall_share, "");
  check_positive("gap opening", "least_wall_share", options.least_wall_share, "");
  if (options.least_wall_share > options.wall_share)
    throw core::Error(
        fmt::format("gap opening: least_wall_share = {:g} is above wall_share = {:g}; give at most as "
                    "much",
                    options.least_wall_share, options.wall_share));
}

void check_lengths(std::size_t places, std::size_t states, std::size_t loads) {
  if (places == 0 || places != states || places != loads)
    throw core::Error(
        fmt::format("gap opening: {} places, {} states and {} lists of work rates; give one of each for "
                    "each place, at least one",
                    places, states, loads));
}

/// Runs `work` and names the place in its message.
template <class Work> auto at_place(std::span<const Place> places, std::size_t place, Work work) {
  try {
    return work();
  } catch (const core::Error& error) {
    const std::string& name = places[place].name;
    throw core::Error(
        fmt::format("{}: {}", name.empty() ? fmt::format("place {}", place + 1) : name, error.what()));
  }
}

Wearing wearing_at(const Place& place, const PlaceState& state, std::span<const OperatingState> loads,
                   std::size_t number, std::vector<PlaceOutside>& outside) {
  check(place.support);
  check_not_negative("gap opening", "initial gap", place.initial_gap, "m");
  Wearing out{place, state, {}, {}};
  const auto rate = [&](const Law& law) {
    auto result = worn_volume(law, loads);
    if (result.outside)
      outside.push_back({number, *std::move(result.outside)});
    return result.volume.value_or(WornVolume{});
  };
  out.tube = rate(place.support.tube);
  out.support = rate(place.support.support);
  return out;
}

/// Nothing beyond the geometry.
std::optional<PlaceState> state_after(const Wearing& at, double time) {
  PlaceState out = at.state;
  out.tube_volume = at.tube_volume(time);
  out.support_volume = at.support_volume(time);
  out.age += time;
  const auto depth = at.depth_of(out.tube_volume, out.support_volume);
  if (!depth)
    return {};
  out.opened += depth->total() - out.depth.total();
  out.depth = *depth;
  out.gap = at.place.initial_gap + out.opened;
  return out;
}

core::Error beyond_geometry(const Wearing& at) {
  return core::Error(
      fmt::format("wear leaves what its geometry describes (depth {:g} m); take the exact form or a "
                  "lower limit",
                  largest_depth(at.place.support.pairing)));
}

PlaceState described_state_after(const Wearing& at, double time) {
  if (auto out = state_after(at, time))
    return *out;
  throw beyond_geometry(at);
}

} // namespace

PlaceState new_place(const Place& place) {
  check(place.support);
  check_not_negative("gap opening", "initial gap", place.initial_gap, "m");
  PlaceState out;
  out.gap = place.initial_gap;
  return out;
}

PlaceState place_of_age(const Place& place, std::span<const OperatingState> loads, double age) {
  check_not_negative("gap opening", "age", age, "s");
  std::vector<PlaceOutside> outside;
  PlaceState out = described_state_after(wearing_at(place, new_place(place), loads, 0, outside), age);
  out.opened = 0.0;
  out.gap = place.initial_gap;
  return out;
}

PlaceState place_at_start(const Place& place, std::span<const OperatingState> loads) {
  PlaceState out = new_place(place);
  std::vector<PlaceOutside> outside;
  const Wearing at = wearing_at(place, out, loads, 0, outside);
  const InitialWear worn = initial_wear(place.support, at.tube, at.support);
  out.tube_volume = worn.tube;
  out.support_volume = worn.support;
  out.age = worn.age;
  const auto depth = at.depth_of(worn.tube, worn.support);
  if (!depth)
    throw beyond_geometry(at);
  out.depth = *depth;
  return out;
}

Advance advance(std::span<const Place> places, std::span<const PlaceState> states,
                std::span<const std::vector<OperatingState>> loads, const AdvanceOptions& options) {
  check(options);
  check_lengths(places.size(), states.size(), loads.size());
  Advance out{options.horizon, {}, Progress::horizon_reached, AdvanceLimit::horizon, 0, {}};
  std::vector<Wearing> wearing;
  for (std::size_t k = 0; k < places.size(); ++k)
    wearing.push_back(
        at_place(places, k, [&] { return wearing_at(places[k], states[k], loads[k], k, out.outside); }));
  bool any = false;
  for (std::size_t k = 0; k < places.size(); ++k) {
    at_place(places, k, [&] { limit_by(wearing[k], k, options, out); });
    any = any || wearing[k].wears();
  }
  if (!any && out.progress == Progress::horizon_reached)
    out.progress = Progress::geometry_stands;
  for (std::size_t k = 0; k < places.size(); ++k)
    out.states.push_back(at_place(places, k, [&] { return described_state_after(wearing[k], out.time); }));
  return out;
}

Advance advance(std::span<const Place> places, std::span<const PlaceState> states,
                std::span<const double> work_rates, const AdvanceOptions& options) {
  std::vector<std::vector<OperatingState>> loads;
  for (const double work_rate : work_rates)
    loads.push_back({OperatingState{1.0, work_rate}});
  return advance(places, states, loads, options);
}

std::optional<PlaceState> state_after(const Place& place, const PlaceState& state,
                                      std::span<const OperatingState> loads, double time) {
  check_not_negative("gap opening", "time", time, "s");
  std::vector<PlaceOutside> outside;
  return state_after(wearing_at(place, state, loads, 0, outside), time);
}

double limit_of(const WornSupport& place, WornBody body) {
  return body == WornBody::tube ? place.limit * place.wall
                                : place.support_limit.value_or(std::numeric_limits<double>::infinity());
}

double time_to_limit(const Place& place, const PlaceState& state, std::span<const OperatingState> loads,
                     WornBody body) {
  std::vector<PlaceOutside> outside;
  const Wearing at = wearing_at(place, state, loads, 0, outside);
  const double limit = limit_of(place.support, body);
  const auto lost = [&](double time) {
    const auto depth = at.depth(time);
    return depth ? depth_of(*depth, body) - limit : limit; // beyond the geometry: the root is then checked
  };
  if (lost(0.0) >= -root_error * limit)
    return 0.0;
  const WornVolume& own = body == WornBody::tube ? at.tube : at.support;
  if (!(own.initial_rate > 0.0) || std::isinf(limit))
    return std::numeric_limits<double>::infinity();
  double before = 0.0;
  for (double time = first_look; time < last_look; time *= look_factor) {
    if (lost(time) >= 0.0) {
      const double found = root(lost, before, time);
      const auto depth = at.depth(found); // at the end of the geometry `lost` jumps from below 0 to the limit
      const bool reached = depth && depth_of(*depth, body) >= (1.0 - limit_error) * limit;
      return reached ? found : std::numeric_limits<double>::quiet_NaN();
    }
    before = time;
  }
  return std::numeric_limits<double>::infinity();
}

std::vector<contact::PolarPoint> opened_profile(std::span<const PlaceState> sectors) {
  if (sectors.size() < 3 || sectors.size() > SectorWork::most)
    throw core::Error(fmt::format("gap opening: {} sectors do not enclose a hole; give 3 to {}",
                                  sectors.size(), SectorWork::most));
  const SectorWork angles(static_cast<int>(sectors.size()));
  std::vector<contact::PolarPoint> out;
  for (std::size_t k = 0; k < sectors.size(); ++k)
    out.push_back({angles.middle(k), sectors[k].gap});
  return out;
}

} // namespace fretwork::wear
