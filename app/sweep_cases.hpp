// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The cases of a sweep at work: those that no file has, over all ranks, each with a process of its own.
#pragma once
#include "app/case_worker.hpp"
#include "app/progress.hpp"
#include "app/sweep_plan.hpp"
#include "core/mpi_counter.hpp"
#include <mpi.h>

namespace fretwork::app {

class SweepCases {
public:
  /// Collective. Starts the process of this rank.
  /// @param request, plan, progress  must live longer
  /// @throws core::ComputationError where no process can be started
  SweepCases(MPI_Comm comm, const SweepRequest& request, const SweepPlan& plan, Progress& progress);
  SweepCases(const SweepCases&) = delete;
  SweepCases& operator=(const SweepCases&) = delete;

  /// What CaseWorker::facts gives and throws; the warnings on rank 0 only, and not of a shard.
  [[nodiscard]] const SweepFacts& facts() { return worker_->facts(); }

  /// Collective. Looks for the cases of this shard in the files of earlier calls.
  /// @param draws  those of the last call among them
  /// @return the message on what was found, on rank 0; empty: nothing to say
  [[nodiscard]] std::string find_missing(const sweep::Draws& draws);

  /// Collective. Computes the cases that find_missing has not found; each rank appends their rows to a file of its own.
  /// @throws core::Interrupted after SIGTERM or SIGINT; core::Error where a row cannot be written; what CaseWorker throws
  void compute_missing(const sweep::Draws& draws);

private:
  void look();
  [[nodiscard]] std::int64_t ended() const;
  [[nodiscard]] std::string ended_text(const std::string& signal) const;
  [[nodiscard]] std::int64_t cases_of_shard(const sweep::Draws& draws) const;

  MPI_Comm comm_;
  const SweepPlan& plan_;
  Progress& progress_;
  bool first_rank_;
  std::optional<CaseWorker> worker_;
  core::SharedCounters* counters_ = nullptr; ///< blocks that were handed out; cases that have ended
  std::vector<std::int64_t> missing_;
  std::int64_t all_ = 0;   ///< cases of the shard
  std::int64_t there_ = 0; ///< cases that find_missing has found
  std::int64_t known_ = 0; ///< cases of the calls before
};

} // namespace fretwork::app
