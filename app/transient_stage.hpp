// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The transient of a study with its wear, and its repetitions at the gaps that the wear has opened.
#pragma once
#include "app/checkpoints.hpp"
#include "app/progress.hpp"
#include "app/scenes.hpp"
#include "app/wear_of_run.hpp"
#include "core/mpi.hpp"

namespace fretwork::app {

/// What the runs of a study need besides its scenes.
struct AroundTransient {
  MPI_Comm comm;
  const study::Study& study;
  const std::vector<PlacedContact>& placed;
  const std::vector<WornPlace>& worn;
  const OtherRuns& other_runs;
  const AtContacts& at_contacts; ///< what the scenes are built from
  Progress& progress;
  Checkpoints& checkpoints;
};

/// Collective. Runs the scenes and fills the statistics, series, wear and warnings of `out`, whose bases, contacts,
/// node_names and force_sites are those of the scenes.
void run_transient(const AroundTransient& around, std::vector<BuiltScene>& scenes, results::RunResults& out);

} // namespace fretwork::app
