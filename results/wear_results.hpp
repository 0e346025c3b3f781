// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The wear that follows from the work rates of a run: plain data, by support and by tube (doc/wear.md).
#pragma once
#include "core/types.hpp"
#include "wear/laws.hpp"
#include "wear/work_rate.hpp"
#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace fretwork::results {

/// `source` of a coefficient that the study gives.
inline constexpr const char* given_source = "study";
inline constexpr double no_value = std::numeric_limits<double>::quiet_NaN();

/// A figure at the work rate and at the two ends of its interval; not a number where there is none.
struct Bounds {
  double value = no_value, low = no_value, high = no_value;
};

/// A figure against time, at the work rate and at the ends of its interval.
struct WearCurves {
  std::vector<double> value, low, high;
  /// At the last time; not numbers where there is none.
  [[nodiscard]] Bounds last() const {
    return value.empty() ? Bounds{} : Bounds{value.back(), low.back(), high.back()};
  }
};

/// An operating state: its share of the time and the work rate of the support in it.
struct WearStateRate {
  std::string name;
  double share = 1.0;
  wear::WorkRate work_rate{};
};

/// How the time to the limit of a body ends: "reached", "never", "outside_law", "beyond_geometry".
struct WearLife {
  std::string end;
  Bounds years; ///< a: low is the short life, of the upper end of the work rate; infinity: never
};

/// One scar, by the work rates of its states.
struct WornScar {
  std::vector<WearStateRate> states;
  wear::WorkRate work_rate{};        ///< W, mean over the states by their shares
  std::string outside;               ///< why the law does not apply; empty: it does
  WearCurves volume, support_volume; ///< m3
  WearCurves depth, support_depth;   ///< m; not a number beyond the geometry
  double initial_depth = 0.0;        ///< m, that the tube has lost where the years begin
  double initial_years =
      no_value; ///< a, that the work rates would have taken for the depth at the start; not a number: there is none, or they never would
  double scar_width = no_value, scar_length = no_value,
         scar_half_angle = no_value; ///< m, m, rad: at the last time
  WearLife life, support_life;       ///< an empty end: the support has no limit
};

/// The scar of one flat face, or on one land.
struct WearOfSide : WornScar {
  std::string name; ///< contact/sides.hpp
};

/// A support, all points of it: one scar, or where flat faces or lands meet the tube on several sides the sum of their volumes, the deepest of their
/// depths and the first of their lives.
struct WearOfSupport : WornScar {
  std::string name;
  std::vector<std::int64_t> contacts; ///< their numbers
  std::int64_t node = 0;              ///< of the first contact, in the model
  std::int64_t tube = 0;              ///< number of its structure

  std::optional<double> confidence; ///< of the intervals; none: +- the standard error
  std::string law, source;          ///< of the law; where the coefficient of the tube is from
  double coefficient = 0.0;         ///< K of the tube, m2/N; not a number for a law that has none
  double support_coefficient = 0.0; ///< m2/N
  std::string geometry, form;
  double radius = 0.0, wall = 0.0; ///< m, of the tube
  double length = no_value;        ///< m, of the support along the tube
  double clearance = no_value;     ///< m, radial, of geometries that have one
  double inclination = 0.0;        ///< rad
  double limit = 0.0;              ///< m, depth that the tube may lose
  double support_limit = no_value; ///< m

  double impact_index = no_value, sliding_index = no_value; ///< Si, Sg of kwu_epri
  double share_above = no_value; ///< of the time in contact that is above the maxima of kwu_epri's classes

  std::vector<double> time;      ///< s, from 0 to the years asked for
  std::vector<WearOfSide> sides; ///< scars of several flat faces or lands; else empty
  double corner_share =
      no_value; ///< of the work of this run, at corners of lands; not a number: no lands, or no work
  double corner_depth = no_value,
         corner_years = no_value;   ///< m at the last time and a, of the tube, were all scars about corners
  std::vector<double> sector_rates; ///< W, of this run by angular sector of the contact point, from -pi on
  std::vector<double> sector_depth, sector_support_depth; ///< m, at the last time; geometry "sectors" only
};

/// All supports of one structure.
struct WearOfTube {
  std::int64_t tube = 0; ///< number of the structure
  std::int64_t supports = 0;
  wear::WorkRate work_rate{}; ///< W, sum over its supports
  Bounds volume; ///< m3, sum over supports at the years asked for; not a number where a law does not apply
  Bounds depth;  ///< m, the largest; not a number where a scar is beyond its geometry
  std::string deepest; ///< the support where it is, or of the largest of these scars
  Bounds years;        ///< the shortest life, of the tube or of a support that has a limit
  std::string first;   ///< the support that ends it; empty: none
  std::string body;    ///< what reaches its limit there, "tube" or "support"; empty: nothing
  std::int64_t unknown_lives =
      0; ///< that have no value, outside their law or beyond their geometry: one may be shorter
};

/// One support through the stages of gap opening; lists by stage.
struct OpenedSupport {
  std::vector<double> gap;    ///< m, during the stage, in the direction of wear
  WearCurves work_rate;       ///< W, mean over its states, at that gap
  WearCurves depth;           ///< m, of the tube at the end of the stage; not a number beyond the geometry
  WearCurves support_depth;   ///< m
  WearLife life;              ///< beyond the last stage at its work rates
  WearLife support_life = {}; ///< likewise; an empty end: the support has no limit
};

/// The run repeated at the gaps that its wear has opened (wear/gap_opening.hpp). The wear of supports above is that of the first stage alone.
struct GapOpening {
  /// "life_reached", "geometry_stands", "horizon_reached", "stages_used", "beyond_geometry", "stage_failed", "stage_refused"
  std::string end;
  std::string reason;                  ///< of the last three, the message; else empty
  std::vector<double> time;            ///< s, at the end of each stage
  std::vector<OpenedSupport> supports; ///< as Wear::supports
};

struct Wear {
  std::vector<WearOfSupport> supports;
  std::vector<WearOfTube> tubes;
  std::optional<GapOpening> opening; ///< where the study asks for it
};

/// "side +y", "facet 1", "land 1", from the name of a side.
[[nodiscard]] std::string text_of_side(const std::string& name);

/// Volumes, depths, scar and lives of a support from its sides, at each end of the intervals. Sides that are outside their law count only
/// where all are.
void combine_sides(WearOfSupport& support);

/// The life of what reaches its limit first, tube or support.
[[nodiscard]] Bounds first_life(const WornScar& scar);

/// Sums and extremes over the supports of each tube, by the number of the tube.
[[nodiscard]] std::vector<WearOfTube> wear_by_tube(const std::vector<WearOfSupport>& supports);

} // namespace fretwork::results
