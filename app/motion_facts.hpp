// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The imposed motions of a run in figures: what a record is, how fast it accelerates and how far it goes. Slips show there: records in g, in
/// milliseconds, without baseline correction.
#pragma once
#include "results/run_results.hpp"
#include "study/study.hpp"

namespace fretwork::app {

/// Of every `[[base_motion]]` and `[[support_motion]]` of a study with `[transient]`: adds `motions`, a note where a run ends before a record and
/// a warning of motions that leave behind what stays in space.
void describe_motions(const study::Study& study, results::RunResults& out);

} // namespace fretwork::app
