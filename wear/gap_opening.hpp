// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Wear opens the gaps, and open gaps change the motion. The motion is computed again after each advance:
///
///     1. work rates W_k at the present gaps (a transient, or the mean of several)
///     2. the advance in time T: the largest with, at every place k,
///            d(p_t + p_s) <= max(min(gap_share gap, wall_share wall), least_wall_share wall)
///            p_t <= limit wall,   T <= horizon
///     3. V_t, V_s grow by V(age + T) - V(age) of their laws at W_k; p_t, p_s follow (depth.hpp); gap = initial gap +
///        what p_t + p_s has grown by; back to 1.
///
/// A place is a support, or one angular sector of it with the depths of sectors. It ends when the geometry stands
/// (nothing wears at the present work rates), a tube has lost its limit, or the horizon is reached. T is of order 1 in
/// the shares: half of them, half the error.
/// The least advance keeps a gap near 0 from asking for advances without end. Which of the limits acted, and where, is
/// returned. A law that does not apply at a place wears nothing there, which is returned too.
/// edf_mz has the age of the body as its clock, at the present V0.
/// Pure functions: equal input, equal result.
#pragma once
#include "contact/profile.hpp"
#include "wear/depth.hpp"
#include "wear/laws.hpp"
#include "wear/life.hpp"
#include <span>
#include <string>
#include <vector>

namespace fretwork::wear {

struct Place {
  WornSupport support;   ///< its `support_limit` does not end an advance
  double initial_gap;    ///< m, >= 0, in the direction of wear: of a new tube, or with its initial depth
  std::string name = {}; ///< in messages; empty: the number of the place
};

struct PlaceState {
  double tube_volume = 0.0, support_volume = 0.0; ///< V_t, V_s, m3, since each was new
  double age = 0.0;                               ///< s, of both
  PairDepth depth{0.0, 0.0};                      ///< p_t, p_s, m
  double opened = 0.0; ///< m: what p_t + p_s has grown by since the wear that is followed began
  double gap = 0.0;    ///< m
};

/// New tube, new support.
[[nodiscard]] PlaceState new_place(const Place& place);
/// With the initial depth of its tube, by the first work rates (life.hpp).
[[nodiscard]] PlaceState place_at_start(const Place& place, std::span<const OperatingState> loads);
/// Worn for a time (s, >= 0) at these before its wear is followed.
/// @throws core::Error where that leaves what the geometry describes
[[nodiscard]] PlaceState place_of_age(const Place& place, std::span<const OperatingState> loads, double age);

struct AdvanceOptions {
  double horizon;                  ///< s, > 0: time that is left
  double gap_share = 0.1;          ///< > 0
  double wall_share = 0.05;        ///< > 0
  double least_wall_share = 0.005; ///< > 0, <= wall_share
};

/// What ended the advance.
enum class AdvanceLimit { gap, wall, least, life, horizon };
/// What comes next.
enum class Progress { go_on, geometry_stands, life_reached, horizon_reached };

struct PlaceOutside {
  std::size_t place;
  OutsideLaw law;
};

struct Advance {
  double time; ///< T, s
  std::vector<PlaceState> states;
  Progress progress;
  AdvanceLimit limit;
  std::size_t place; ///< where the limit acted; 0 for the horizon
  std::vector<PlaceOutside> outside;
};

/// @param loads  operating states of each place at the present gaps
/// @throws core::Error for input out of range (naming the place), lists of different lengths, and for a place
/// whose wear leaves what its geometry describes
[[nodiscard]] Advance advance(std::span<const Place> places, std::span<const PlaceState> states,
                              std::span<const std::vector<OperatingState>> loads,
                              const AdvanceOptions& options);
/// One operating state each. @param work_rates  W
[[nodiscard]] Advance advance(std::span<const Place> places, std::span<const PlaceState> states,
                              std::span<const double> work_rates, const AdvanceOptions& options);

/// The state after a time (s, >= 0) at constant work rates; nothing: the wear leaves what its geometry describes. A law that does not
/// apply wears nothing.
/// @throws core::Error for input out of range
[[nodiscard]] std::optional<PlaceState> state_after(const Place& place, const PlaceState& state,
                                                    std::span<const OperatingState> loads, double time);
/// One of the two that wear at a place.
enum class WornBody { tube, support };
/// Depth that it may lose, m; infinity: it has no limit.
[[nodiscard]] double limit_of(const WornSupport& place, WornBody body);
[[nodiscard]] inline double depth_of(const PairDepth& depth, WornBody body) {
  return body == WornBody::tube ? depth.tube : depth.support;
}
/// s from the state until a body has lost its limit at constant work rates; infinity: never; not a number: the wear leaves its geometry before.
/// @throws core::Error for input out of range
[[nodiscard]] double time_to_limit(const Place& place, const PlaceState& state,
                                   std::span<const OperatingState> loads, WornBody body = WornBody::tube);

/// Polar points (rad, m) of the free space of the tube's centre, one at the middle of each sector of sectors.hpp, for
/// contact::Profile. Facets join them: between two middles of gap g the free space is narrower by up to
/// g (1 - cos(pi/n)), 0.4 % for 36 sectors.
/// @throws core::Error for fewer than 3 sectors
[[nodiscard]] std::vector<contact::PolarPoint> opened_profile(std::span<const PlaceState> sectors);

} // namespace fretwork::wear
