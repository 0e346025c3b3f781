// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// What the step of a scene has to resolve: each rate with its bound in the scheme of the choice (scene/scheme_limits.hpp) and its names in messages. The automatic step
/// is the longest within the bounds (step_rule.hpp); a step beyond one is warned about (step_warnings.hpp).
#pragma once
#include "transient/scene/scheme_limits.hpp"
#include "transient/step_choice.hpp"
#include <algorithm>
#include <array>

namespace fretwork::transient {

/// A rate of the scene that the step has to resolve.
struct StepTerm {
  const char *name, *symbol; ///< symbol: of the rate times the step
  double rate;               ///< 0: there is none
  const char* unit;
  StepBound bound;
  const char* cure = "";           ///< what makes the step longer, after "resolved for an accuracy of 0.01"
  const char* spoiled = "results"; ///< what cannot be trusted above the bound
  StepBound shortest{0.0, 0.0};    ///< s, a time: no automatic step need be shorter for this term
  double never_warned = 0.0;       ///< s, a given step up to it resolves the term whatever its bound
  /// s, the longest step that is not warned about.
  [[nodiscard]] double longest() const { return std::max(bound.largest / rate, never_warned); }
};

/// Relative, of what follows from times that are given in decimal numbers.
constexpr double time_round_off = 1e-9;
/// Names of loads in messages.
constexpr const char *name_of_excitation = "the excitation",
                     *name_of_record_band = "the band of a record below the highest mode",
                     *name_of_table_interval = "the shortest interval of a table";

/// s, the longest step for tables that are no records, of which there are some.
[[nodiscard]] double longest_for_tables(const StepChoice& c);
[[nodiscard]] StepTerm mode_term(const StepChoice& c, bool contacts);
/// Closed and sticking contacts, and the structure beside them.
[[nodiscard]] std::array<StepTerm, 3> contact_terms(const StepChoice& c);
[[nodiscard]] StepTerm normal_damper_term(const StepChoice& c);
/// Of contacts, and all that only explicit schemes have to resolve.
[[nodiscard]] std::array<StepTerm, 3> damper_terms(const StepChoice& c);

} // namespace fretwork::transient
