// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// What the step of each scheme has to resolve: one row for each, by which the automatic step is chosen and given ones are warned about
/// (transient/step_rule.hpp: the formula). doc/schemes.md has the same table (tests/transient/scheme_limits_test.cpp compares them).
#pragma once
#include "transient/scene/scheme.hpp"
#include <algorithm>
#include <array>
#include <limits>

namespace fretwork::transient {

constexpr double unbounded = std::numeric_limits<double>::infinity();

/// Of a rate times the step.
struct StepBound {
  /// At an accuracy of 0.01; goes with its square root. Unbounded: `largest` at any accuracy.
  double share = unbounded;
  double largest = unbounded; ///< at any accuracy; a given step above it is warned about
  /// @param fineness  1 at an accuracy of 0.01, as its square root
  [[nodiscard]] constexpr double at(double fineness) const { return std::min(share * fineness, largest); }
  [[nodiscard]] constexpr StepBound times(double n) const { return {n * share, n * largest}; }
};

/// The accuracy that shares are of, and the coarsest: no statistics are worth having in longer steps.
constexpr double accuracy_of_shares = 0.01, coarsest_accuracy = 0.02;

/// Steps in a period of a load. Lines between their ends lose (2 pi/n)^2/12: 3 % of n = 10, the fewest whatever the accuracy; 0.4 % of 30, at an
/// accuracy of 0.01 with contacts; 8e-5 of 200, without contacts, where little else limits the step.
constexpr double fewest_points = 10.0, points_of_lines = 30.0, points_without_contacts = 200.0;
/// w_max h at an accuracy of 0.01 without contacts, where flows are exact: statistics see the modes in 20 points a period.
constexpr double mode_without_contacts = 0.3;
/// w_c h at an accuracy of 0.01 that normal dampers never make the step shorter than: a faster one leaves no rebound (e < 0.001), and resolving
/// it costs without end.
constexpr double finest_for_normal_dampers = 0.03;

struct SchemeLimits {
  SchemeKind scheme;
  /// The modes move exactly between the contact impulses; their highest frequency then limits the step only where contacts excite it.
  bool exact_modes = false;
  /// That a step has at most for the dampers of contacts, whose bounds are those of an interval. 64: where more are needed, the step is made shorter.
  int intervals = 1;
  /// w_c h, w_t h: a closed, a sticking contact. `share`: impacts and slides are as accurate as statistics are to be (doc/schemes.md; the intervals of
  /// splitting have a third of it). `largest`: above it an impact changes the energy by more than 1 %, or (energy_conserving) the largest force is
  /// 4 % low and more, however stable the run (bench/stability_map.hpp).
  StepBound contact = {};
  /// r_t dt: a contact that its tangential damper stops; of Euler and devogelaere r_e h too, all dampers that they have explicitly, whose limits of stability are 1
  /// (r_e h: 2) and 0.59. Implicit ones leave (1 - x/2)/(1 + x/2) of the speed of a sticking contact at x = r_t h: it turns round above 2. Above 6.3 in an
  /// interval of splitting the work of a damper can come out below 0 (doc/schemes.md, Tangential dampers).
  StepBound tangential_damper = {};
  /// r_n dt: a contact that its normal damper stops, of schemes that have it implicitly; others have it in r_e. With splitting the force falls within an
  /// interval as a parabola up to contact::most_parabolic; collocation leaves a tenth of the speed of a mass at 4, where 0.02 is right.
  StepBound normal_damper = {};
  /// w_max h, with contacts. At 2 a mode takes an impulse that is short in a step of splitting to 5 %, where its instant is known; at pi that resonates with modes;
  /// energy_conserving has the same resonance; Euler's limit of stability is 2, that of devogelaere 2.8.
  StepBound highest_mode = {};
  /// In a period of harmonic and random loads on contacts, at an accuracy of 0.01. splitting has their moments to the second in each step
  /// (vibration/load_sum.hpp), which lose nothing but the path of contacts on modes that forces of motion couple. Others: (2 pi/30)^2/12 = 0.4 %.
  double points_per_period = points_of_lines;
  /// What a normal damper beyond its bound makes wrong, for messages.
  const char* by_normal_damper = "";
};

inline constexpr std::array<SchemeLimits, scheme_count> scheme_limits{{
    {.scheme = SchemeKind::splitting,
     .exact_modes = true,
     .intervals = 64,
     .contact = {3.0, 3.0},
     .tangential_damper = {6.3, 6.3},
     .normal_damper = {unbounded, 1.8},
     .highest_mode = {2.0, 2.0},
     .points_per_period = fewest_points,
     .by_normal_damper = "largest and rms forces"},
    {.scheme = SchemeKind::collocation,
     .exact_modes = true,
     .contact = {0.5, 1.0},
     .tangential_damper = {2.0, 4.0},
     .normal_damper = {2.0, 4.0},
     .by_normal_damper = "rebounds"},
    {.scheme = SchemeKind::euler,
     .contact = {0.3, 1.0},
     .tangential_damper = {0.5, 1.0},
     .highest_mode = {0.5, 1.8}},
    {.scheme = SchemeKind::energy_conserving,
     .exact_modes = true,
     .contact = {0.3, 0.5},
     .tangential_damper = {2.0, 4.0},
     .normal_damper = {2.0, 4.0},
     .highest_mode = {2.5, 2.5},
     .by_normal_damper = "largest forces (rebounds are right at any step)"},
    {.scheme = SchemeKind::devogelaere,
     .contact = {0.3, 0.75},
     .tangential_damper = {0.5, 0.5},
     .highest_mode = {0.5, 1.8}},
    {.scheme = SchemeKind::runge_kutta_54}, // by its tolerance
}};

/// Of splitting alone. w_s h, of the structure at its contacts, and w_c h (w_t h) up to which no step need be shorter for it: above both, what the modes hold back of a
/// force within the step is no cubic any more, and impacts change the energy by 1.6 % at w_c h = 3, w_s h = 1.1; within, by 0.1 % on average over the places of the touch in a step, 0.3 % at most.
constexpr StepBound structure_at_contacts{0.9, 0.9}, contact_beside_structure{1.75, 1.75};
/// w_c dt and w_t dt of its intervals, by accuracy as w_c h: three in the longest step. Contacts whose error replays
/// (splitting/replays.hpp) find above the accuracy move in up to 16 times as many.
constexpr StepBound contact_interval{1.0, 1.0};
/// Modes from so many times w_c and w_t on are made heavier at an accuracy of 0.01 (modes/mass_scaling.hpp); a step is short enough to follow those below.
constexpr double scaled_above = 2.25;
/// No mode is made heavier where that lengthens the longest step in which splitting follows all modes by less than this factor: those just above vibrate at the harmonics of impacts,
/// and the work of contacts that slip by little changes with their frequency (a highest mode of 2.7 w_t at 2.25 w_t: by 6 %, with a quarter of the tangential damper 15 %).
constexpr double least_gain_of_scaling = 1.25;
/// r_n h up to which modes are made heavier: the force of an impact that a damper stops within the step begins with a jump, which moves all modes.
constexpr double scaled_up_to_damper = 3.0;
/// A step over the shortest interval of a table that is no record, and w_c h (w_t h) up to which it may be the whole interval: where values change by their size from
/// point to point inside steps, a contact of w_c h = 3 has its largest force 4 % wrong in steps of a whole interval, 0.6 % within these.
constexpr double table_share = 0.5, contact_beside_tables = 1.75;
/// w_r h of records: the polygon nearest to one loses (w h)^4/720 of what moves with w, 0.14 % at an accuracy of 0.01 (0.01 % without contacts), and the
/// fewest steps in its period: 0.8 %.
constexpr double record_share = 1.0, record_share_without_contacts = 0.5, fewest_points_of_records = 4.0;

[[nodiscard]] constexpr const SchemeLimits& limits_of(SchemeKind scheme) {
  return scheme_limits[static_cast<std::size_t>(scheme)];
}
static_assert(
    [] {
      for (std::size_t i = 0; i < scheme_count; ++i)
        if (static_cast<std::size_t>(scheme_limits[i].scheme) != i)
          return false;
      return true;
    }(),
    "a row for each scheme, in their order");
} // namespace fretwork::transient
