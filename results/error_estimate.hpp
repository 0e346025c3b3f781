// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// What the run knows of its own errors. The error of a figure has two parts: that of the step, which replays measure (transient/splitting/replays.hpp) and a
/// second run at half the step shows, and the scatter of a window of limited length, which batches show.
#pragma once
#include "results/run_results.hpp"

namespace fretwork::results {

enum class ErrorKind {
  none,
  statistical, ///< the scatter only
  measured,    ///< both: that of the step by replays
  verified     ///< both: the run was compared with one at half the step
};
/// As in summary.json: none, statistical, measured, verified.
[[nodiscard]] std::string name_of(ErrorKind kind);

struct ErrorEstimate {
  ErrorKind kind = ErrorKind::none;
  /// The largest of work rate, friction power and impacts per second, each summed over the contacts: standard error and, where replays measure it, the
  /// error by the step or, if larger, its standard error (ErrorsOfSums::size), or, where the run was compared with one at half the step, the
  /// error that its difference stands for (post/verification.hpp), over the figure. Not a number where there is none.
  double relative;
  std::string text; ///< what it is, or why there is none
};

[[nodiscard]] ErrorEstimate error_estimate(const RunResults& results);

/// Figures that differ from those at half the step by more than their scatter and the accuracy; all that were compared.
struct Disagreement {
  std::size_t differ = 0, compared = 0;
  std::string worst; ///< one line: where, which, both values; empty where all agree
};
[[nodiscard]] Disagreement disagreement(const Verification& verification,
                                        const std::vector<ContactFacts>& contacts);

} // namespace fretwork::results
