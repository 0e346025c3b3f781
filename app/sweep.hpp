// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// `fretwork sweep`: the cases of `[sweep]` over all ranks, their table, what they say together (doc/sweep.md).
///
///     study -> Sweep -> Draws -> cases (overrides) -> CaseWorker -> Row -> ShardFile -> Table -> summary, report
#pragma once
#include "app/stages.hpp"
#include "sweep/shard.hpp"

namespace fretwork::app {

struct SweepRequest {
  Request request;                   ///< default of its directory: the study's name with .sweep, beside it
  std::optional<sweep::Shard> shard; ///< this part of the cases only, without table
  bool gather = false;               ///< no case: the table of what shards have
};

/// Collective. Computes what is missing of the cases; what is there, of earlier calls on any number of ranks, is kept.
/// @throws core::Error, core::ComputationError for what concerns all cases; what one case throws is its outcome
void run_sweep(MPI_Comm comm, const SweepRequest& request);

} // namespace fretwork::app
