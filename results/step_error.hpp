// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Relative errors of the contacts' statistics by the step, from what replays have measured (transient/splitting/replays.hpp).
#pragma once
#include "results/run_results.hpp"
#include <optional>

namespace fretwork::results {

/// Of a figure; a positive one is too high by that.
struct RelativeError {
  std::string name; ///< as in summary.json
  double value, standard_error;
};

/// Of one contact, for the figures that are not 0; empty where nothing was measured.
[[nodiscard]] std::vector<RelativeError> relative_errors(const transient::StepError& of);

/// Of the sums over all contacts.
[[nodiscard]] transient::StepError sum_of(const std::vector<transient::StepError>& contacts);

/// The largest error of work rate, friction power and impacts per second over all contacts; none where nothing was measured.
[[nodiscard]] std::optional<RelativeError> largest_error_of_sums(const RunResults& results);

/// One line on the contacts whose errors stand out and exceed the accuracy; empty: none. Contacts that do less than a hundredth of what the
/// busiest one does are left out.
[[nodiscard]] std::string unmet_accuracy(const RunResults& results);

/// One line on the contacts of which the replays know the errors of work rate or friction power too little: their standard
/// errors are three times the accuracy and three times the standard error of the statistic itself; empty: none. Contacts are left out as above.
[[nodiscard]] std::string uncertain_errors(const RunResults& results);

} // namespace fretwork::results
