// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// What the user is to know of the wear of a run: depths and lives that do not hold, and supports that were left out.
#pragma once
#include "app/worn_places.hpp"
#include "results/run_results.hpp"

namespace fretwork::app {

/// Adds to `out`, for all supports of which one thing is true together (the figures are those of the first):
/// - warnings of laws that do not apply, of classes of `kwu_epri` that are exceeded, of depths beyond the wall and beyond the geometry;
/// - a note where scars about corners of lands are deeper than the depths given;
/// - a warning of a support without an entry of [[wear]] that works more than all of its tube that have one: their shortest life need not be
///   that of the tube. Not where entries combine operating states, of which this run is one.
/// Nothing without `out.wear`.
/// @param placed  as out.contact_summaries
void judge_wear(const study::Study& study, const std::vector<WornPlace>& places,
                const std::vector<PlacedContact>& placed, results::RunResults& out);

} // namespace fretwork::app
