// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The study run again at the gaps that its wear has opened (wear/gap_opening.hpp, doc/wear.md section 4).
///
/// Stage 1 is the run of the study as it stands, whose results are kept in full. Each later stage is a run of the same study, forces
/// included, with obstacles opened by the depths so far (opened_contacts.hpp); of it the work rates are kept. It ends when the geometry
/// stands, a tube has lost its limit, the years are over or the stages are used up.
#pragma once
#include "app/worn_places.hpp"
#include "results/run_results.hpp"
#include <functional>

namespace fretwork::app {

/// Runs the study with contacts as given and returns its results with their wear. @param stage  from 2 on
using RunStage =
    std::function<results::RunResults(const std::vector<PlacedContact>& opened, std::int64_t stage)>;

/// @throws core::Error for sectors of a contact whose gap cannot open by angle
void check_gap_opening(const study::Study& study, const std::vector<WornPlace>& places,
                       const std::vector<PlacedContact>& placed);

/// Collective as `run` is. Fills out.wear->opening, and warns where it ended before its time.
void open_gaps(const study::Study& study, const std::vector<WornPlace>& places,
               const std::vector<PlacedContact>& placed, const RunStage& run, results::RunResults& out);

/// Of the study in a later stage: without series, tables of impacts and the run at half the step.
[[nodiscard]] study::Study without_series(const study::Study& study);

} // namespace fretwork::app
