// SPDX-License-Identifier: GPL-3.0-or-later
#include "wear/life.hpp"
#include "core/error.hpp"
#include "wear/check.hpp"
#include "wear/root.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace fretwork::wear {

namespace {

constexpr double never = std::numeric_limits<double>::infinity();
constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
constexpr double growth = 1.05;     ///< of the time from one look to the next
constexpr double least_look = 1.0;  ///< s, at least
constexpr double round_off = 1e-12; ///< of a depth from a bracketed root

enum class Bound { value, low, high };

std::vector<OperatingState> at_bound(std::span<const UncertainState> states, Bound bound) {
  std::vector<OperatingState> out;
  for (const auto& [share, work_rate, indices] : states)
    out.push_back({share,
                   bound == Bound::low    ? work_rate.low
                   : bound == Bound::high ? work_rate.high
                                          : work_rate.value,
                   indices});
  return out;
}

/// Both bodies against time.
struct Pair {
  const Pairing& pairing;
  AgedVolume tube, support;
  [[nodiscard]] std::optional<PairDepth> depth(double time) const {
    return depths(pairing, tube.at(time), support.at(time));
  }
  [[nodiscard]] double volume(double time) const { return tube.at(time) + support.at(time); }
};

enum class Body { tube, support };

double of(const PairDepth& depth, Body body) { return body == Body::tube ? depth.tube : depth.support; }

/// Volume of a body that wears alone, at a depth.
double volume_alone(const Pairing& pairing, Body body, double depth) {
  if (const auto* shared = std::get_if<SharedScar>(&pairing))
    return volume(shared->geometry, depth, shared->form);
  const auto& pair = std::get<SectorPair>(pairing);
  return body == Body::tube ? volume(pair.tube, depth) : volume(pair.support, depth);
}

/// Last time with a depth, between one that has it and one that has not.
double end_of_geometry(const Pair& pair, double inside, double beyond) {
  for (double middle = 0.5 * (inside + beyond); inside < middle && middle < beyond;
       middle = 0.5 * (inside + beyond))
    (pair.depth(middle) ? inside : beyond) = middle;
  return inside;
}

TimeToLimit first_time(const Pair& pair, Body body, double limit) {
  const auto& own = body == Body::tube ? pair.tube : pair.support;
  const auto excess = [&](double time) {
    const auto depth = pair.depth(time);
    return depth ? of(*depth, body) - limit : unknown;
  };
  if (excess(0.0) >= -round_off * limit)
    return {LifeEnd::reached, 0.0};
  const auto alone = own.time_of(volume_alone(pair.pairing, body, limit));
  if (!alone)
    return {LifeEnd::never, never};
  if (excess(*alone) >= -round_off * limit)
    return {LifeEnd::reached, *alone};
  double before = 0.0;
  for (double time = std::max(*alone, least_look); std::isfinite(time); time *= growth) {
    double found = excess(time);
    if (std::isnan(found)) {
      time = end_of_geometry(pair, before, time);
      found = excess(time);
      if (found < 0.0)
        return {LifeEnd::beyond_geometry, unknown};
    }
    if (found >= 0.0)
      return {LifeEnd::reached, root([&](double t) { return excess(t); }, before, time)};
    if (before > 0.0 && pair.volume(time) == pair.volume(before))
      break; // nothing wears any more
    before = time;
  }
  return {LifeEnd::never, never};
}

std::variant<Pair, OutsideLaw> pair_of(const WornSupport& place, std::span<const OperatingState> states) {
  const LawResult tube = worn_volume(place.tube, states), support = worn_volume(place.support, states);
  if (tube.outside)
    return *tube.outside;
  if (support.outside)
    return *support.outside;
  const InitialWear worn = initial_wear(place, *tube.volume, *support.volume);
  return Pair{place.pairing, {*tube.volume, worn.age, worn.tube}, {*support.volume, worn.age, worn.support}};
}

} // namespace

InitialWear initial_wear(const WornSupport& place, const WornVolume& tube, const WornVolume& support) {
  check(place);
  if (place.initial_depth == 0.0)
    return {};
  const TimeToLimit found = first_time({place.pairing, {tube}, {support}}, Body::tube, place.initial_depth);
  if (found.end == LifeEnd::reached)
    return {found.time, tube.at(found.time), support.at(found.time)};
  return {0.0, volume_alone(place.pairing, Body::tube, place.initial_depth), 0.0};
}

void check(const WornSupport& place) {
  check(place.pairing);
  check(place.tube);
  check(place.support);
  check_positive("wear", "wall thickness", place.wall, "m");
  if (!(place.limit > 0.0 && place.limit <= 1.0))
    throw core::Error(fmt::format(
        "wear: limit = {:g} is no share of the wall; give a number > 0 and at most 1", place.limit));
  if (place.support_limit)
    check_positive("wear", "limit of the support", *place.support_limit, "m");
  check_not_negative("wear", "initial depth", place.initial_depth, "m");
  const double most = largest_depth(place.pairing);
  if (place.initial_depth > most)
    throw core::Error(
        fmt::format("wear: an initial depth of {:g} m is beyond the {:g} m that the geometry describes; give "
                    "a smaller one or the exact form",
                    place.initial_depth, most));
  const double deepest = place.limit * place.wall;
  if (deepest > most || place.support_limit.value_or(0.0) > most)
    throw core::Error(
        fmt::format("wear: a limit of {:g} m is beyond the {:g} m that the geometry describes; give a "
                    "thinner wall, a lower limit or the exact form",
                    deepest > most ? deepest : *place.support_limit, most));
}

std::optional<InitialWear> initial_wear(const WornSupport& place, std::span<const UncertainState> states) {
  const std::vector<OperatingState> at_value = at_bound(states, Bound::value);
  const LawResult tube = worn_volume(place.tube, at_value), support = worn_volume(place.support, at_value);
  if (!tube.volume || !support.volume)
    return {};
  return initial_wear(place, *tube.volume, *support.volume);
}

std::vector<DepthAt> depth_history(const WornSupport& place, std::span<const OperatingState> states,
                                   std::span<const double> times, std::optional<OutsideLaw>* outside) {
  check(place);
  const auto pair = pair_of(place, states);
  if (const auto* why = std::get_if<OutsideLaw>(&pair)) {
    if (outside)
      *outside = *why;
    return {};
  }
  const auto& bodies = std::get<Pair>(pair);
  std::vector<DepthAt> out;
  for (const double time : times) {
    check_not_negative("wear", "time", time, "s");
    out.push_back({time, bodies.tube.at(time), bodies.support.at(time), bodies.depth(time)});
  }
  return out;
}

DepthHistory depth_history(const WornSupport& place, std::span<const UncertainState> states,
                           std::span<const double> times) {
  DepthHistory out;
  std::optional<OutsideLaw> at_value, at_low, at_high;
  out.value = depth_history(place, at_bound(states, Bound::value), times, &at_value);
  out.low = depth_history(place, at_bound(states, Bound::low), times, &at_low);
  out.high = depth_history(place, at_bound(states, Bound::high), times, &at_high);
  out.outside = at_value ? at_value : at_low ? at_low : at_high;
  return out;
}

BodyLives time_to_limit(const WornSupport& place, std::span<const OperatingState> states) {
  check(place);
  const auto pair = pair_of(place, states);
  if (const auto* why = std::get_if<OutsideLaw>(&pair)) {
    const TimeToLimit outside{LifeEnd::outside_law, unknown, *why};
    if (place.initial_depth >= place.limit * place.wall) // by any law
      return {{LifeEnd::reached, 0.0}, place.support_limit ? std::optional(outside) : std::nullopt};
    return {outside, place.support_limit ? std::optional(outside) : std::nullopt};
  }
  const auto& bodies = std::get<Pair>(pair);
  BodyLives out{first_time(bodies, Body::tube, place.limit * place.wall), {}};
  if (place.support_limit)
    out.support = first_time(bodies, Body::support, *place.support_limit);
  return out;
}

Life time_to_limit(const WornSupport& place, std::span<const UncertainState> states) {
  return {time_to_limit(place, at_bound(states, Bound::value)),
          time_to_limit(place, at_bound(states, Bound::low)),
          time_to_limit(place, at_bound(states, Bound::high))};
}

} // namespace fretwork::wear
