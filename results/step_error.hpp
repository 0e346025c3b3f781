// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Relative errors of the contacts' statistics by the step, from what replays have measured (transient/splitting/replays.hpp).
#pragma once
#include "results/run_results.hpp"
#include <optional>

namespace fretwork::results {

/// By how many standard errors an error by the step is to differ from 0, or to exceed the accuracy, to be taken for one.
constexpr double significance = 2.0;

/// Of a figure; a positive one is too high by that.
struct RelativeError {
  std::string name; ///< as in summary.json
  double value, standard_error;

  /// Whether it stands out of what the replays scatter by.
  [[nodiscard]] bool is_resolved() const;
  /// Below which the error is, resolved or not, with a confidence of some 95 %.
  [[nodiscard]] double upper_bound() const;
};

/// Of one contact, for the figures that are not 0; empty where nothing was measured.
[[nodiscard]] std::vector<RelativeError> relative_errors(const transient::StepError& of);

/// Of the sums over all contacts.
[[nodiscard]] transient::StepError sum_of(const std::vector<transient::StepError>& contacts);

/// What replays know of the errors of work rate, friction power and impacts per second over all contacts.
struct ErrorsOfSums {
  std::optional<RelativeError> largest; ///< of those resolved; 0 only where all are
  /// Of work rate and friction power, where they are not resolved, that with the larger upper bound; none where that of `largest` is above it.
  std::optional<RelativeError> least_known;
  /// Where they are not resolved and may err by more than the others: replays have few of them, and each counts.
  std::optional<RelativeError> impacts;

  [[nodiscard]] bool measured() const { return largest || least_known || impacts; }
  /// The largest error, or standard error of one where that is larger; 0 where nothing was measured.
  [[nodiscard]] double size() const;
};
[[nodiscard]] ErrorsOfSums errors_of_sums(const RunResults& results);

/// One line on the contacts whose errors stand out and exceed the accuracy; empty: none. Contacts that do less than a hundredth of what the
/// busiest one does are left out.
[[nodiscard]] std::string unmet_accuracy(const RunResults& results);

/// One line on the contacts of which the replays do not resolve the errors of work rate or friction power: their standard
/// errors are three times the accuracy and three times the standard error of the statistic itself; empty: none. Contacts are left out as above.
[[nodiscard]] std::string uncertain_errors(const RunResults& results);

} // namespace fretwork::results
