// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Wear of the supports of a study: work rates of the operating states, depth against time, life (doc/wear.md).
///
/// The work rate of a support in a state is the sum over its contacts of those of this run, with their standard errors; of the contacts of the
/// same names in the summary.json of another run; or what the study gives. The work rate told for a support is the mean over its states by
/// their shares of the time.
/// Geometry "sectors": each sector wears its share of the volume, which is that of its work in this run; the deepest one decides the life.
#pragma once
#include "app/other_runs.hpp"
#include "results/run_results.hpp"

namespace fretwork::app {

/// Fills `out.wear` from its statistics of contacts, without warnings (judge_wear.hpp). Nothing where no support wears, or the other runs are not
/// complete.
/// @param placed  as out.contact_summaries
void add_wear(const study::Study& study, const std::vector<WornPlace>& places,
              const std::vector<PlacedContact>& placed, const OtherRuns& others, results::RunResults& out);

} // namespace fretwork::app
