// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Depth of wear against time, and the time at which a body has lost its limit.
///
///     t_limit: the first t with p_t(t) >= limit wall          (support: p_s(t) >= its own limit)
///     p_t, p_s of V_t(t), V_s(t) as depth.hpp shares them; V(t) of laws.hpp
///
/// Where one body wears, t_limit is the time of the volume at the limit (archard: V/(K W)). Where both share a scar,
/// p_t <= p(V_t): t_limit is at or after that time, and is looked for from there on in steps of 5 %, then by
/// bracketing. "Never": the volume cannot be reached, or stops growing before.
/// The interval of work rates is carried through: its upper end gives the larger depths and the shorter life.
///
/// A tube that is worn already: t = 0 is where p_t is its initial depth, on the curve of the work rates at hand: V(t) = V_new(age + t), p_t(age) the
/// initial depth. Where these never wear as much the tube begins with the volume of that depth, the support new, and V(t) = V(0) + V_new(t).
#pragma once
#include "wear/depth.hpp"
#include "wear/laws.hpp"
#include "wear/work_rate.hpp"
#include <span>
#include <vector>

namespace fretwork::wear {

inline constexpr double default_limit = 0.40; ///< of the tube's wall

/// Tube and support at one place.
struct WornSupport {
  Pairing pairing;
  Law tube;
  double wall;                              ///< m, > 0, of the tube
  Law support = Archard{0.0};               ///< 0: the support does not wear
  double limit = default_limit;             ///< of the wall, 0 < limit <= 1
  std::optional<double> support_limit = {}; ///< m, > 0: depth that the support may lose
  double initial_depth = 0.0;               ///< m, >= 0, of the tube at t = 0
};

/// What has been worn at t = 0.
struct InitialWear {
  double age = 0.0; ///< s, that the work rates would have taken for it; 0: new, or they never would
  double tube = 0.0, support = 0.0; ///< m3
};
/// @param tube, support  by the laws of the place   @throws core::Error for input out of range
[[nodiscard]] InitialWear initial_wear(const WornSupport& place, const WornVolume& tube,
                                       const WornVolume& support);

/// An operating state whose work rate is known within an interval.
struct UncertainState {
  double share;                              ///< of the time, >= 0; the shares sum to 1
  WorkRate work_rate;                        ///< of the support: the sum over its points, the mean over draws
  std::optional<ImpactSliding> indices = {}; ///< for kwu_epri
};

/// At the work rates themselves; nothing where a law does not apply.
[[nodiscard]] std::optional<InitialWear> initial_wear(const WornSupport& place,
                                                      std::span<const UncertainState> states);

struct DepthAt {
  double time;                        ///< s
  double tube_volume, support_volume; ///< m3
  std::optional<PairDepth> depth;     ///< nothing: beyond the geometry
};
/// Empty lists where a law does not apply.
struct DepthHistory {
  std::vector<DepthAt> value, low, high; ///< at the work rate and at the ends of its interval
  std::optional<OutsideLaw> outside;     ///< at the value, or else at an end
};

/// @param times  s, >= 0, any order
/// @throws core::Error for input out of range
[[nodiscard]] std::vector<DepthAt> depth_history(const WornSupport& place,
                                                 std::span<const OperatingState> states,
                                                 std::span<const double> times,
                                                 std::optional<OutsideLaw>* outside = nullptr);
[[nodiscard]] DepthHistory depth_history(const WornSupport& place, std::span<const UncertainState> states,
                                         std::span<const double> times);

enum class LifeEnd { reached, never, outside_law, beyond_geometry };

struct TimeToLimit {
  LifeEnd end;
  double time; ///< s; infinity: never; not a number: outside the law or beyond the geometry
  std::optional<OutsideLaw> outside = {};
  [[nodiscard]] double years() const { return time / year; }
};
struct BodyLives {
  TimeToLimit tube;
  std::optional<TimeToLimit> support; ///< where it has a limit
};
struct Life {
  BodyLives value;
  BodyLives at_low,
      at_high; ///< at the lower end of the work rates (long life) and at the upper end (short life)
};

/// @throws core::Error for input out of range, and for a limit deeper than the geometry describes
[[nodiscard]] BodyLives time_to_limit(const WornSupport& place, std::span<const OperatingState> states);
[[nodiscard]] Life time_to_limit(const WornSupport& place, std::span<const UncertainState> states);

/// @throws core::Error for a wall, a limit, an initial depth, a law or a geometry out of range
void check(const WornSupport& place);

} // namespace fretwork::wear
