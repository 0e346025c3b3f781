// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Wear of the supports of a study: work rates of the operating states, depth against time, life (doc/wear.md).
///
/// The work rate of a support in a state is the sum over its contacts of those of this run, with their standard errors; of the contacts of the
/// same names in the summary.json of another run; or what the study gives. The work rate told for a support is the mean over its states by
/// their shares of the time.
/// Geometry "sectors": each sector wears its share of the volume, which is that of its work in this run; the deepest one decides the life.
#pragma once
#include "app/worn_places.hpp"
#include "results/run_results.hpp"
#include <map>

namespace fretwork::app {

/// A work rate as a run states it.
struct StatedRate {
  double value, error; ///< W, mean and its standard error, not a number: none
  double batches;      ///< effective number behind the error
  /// @param confidence  of the interval; none: +- the standard error
  [[nodiscard]] wear::WorkRate with(std::optional<double> confidence) const;
};

/// Work rates by name of a contact, of each state of each entry; empty for states that are not results of another run.
using OtherRuns = std::vector<std::vector<std::map<std::string, StatedRate>>>;

/// @throws core::Error for a folder without results of a transient, a run that diverged, a contact that it does not have
[[nodiscard]] OtherRuns read_other_runs(const study::Study& study, const std::vector<WornPlace>& places,
                                        const std::vector<PlacedContact>& placed);

/// Fills `out.wear` from its statistics of contacts. Laws that do not apply and scars beyond their geometry become warnings.
void add_wear(const study::Study& study, const std::vector<WornPlace>& places,
              const std::vector<PlacedContact>& placed, const OtherRuns& others, results::RunResults& out);

} // namespace fretwork::app
