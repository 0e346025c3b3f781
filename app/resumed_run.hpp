// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// A run from its checkpoint, or its beginning, to its end.
#pragma once
#include "app/checkpoints.hpp"
#include "core/state_archive.hpp"
#include <memory>
#include <string>
#include <utility>

namespace fretwork::app {

/// Whether the job has taken over the state; if not, it is to be made anew.
template <class Job> bool restore(Job& job, std::string bytes) {
  try {
    core::StateArchive state(std::move(bytes));
    state(job.run());
    state.end();
    return true;
  } catch (const core::StateMismatch&) {
    return false;
  }
}

/// The checkpoint of one of the runs of a study.
struct OwnCheckpoint {
  Checkpoints& checkpoints;
  std::size_t number; ///< of the run among those of the study, which names its checkpoint
  bool others_follow; ///< runs of this rank: an interruption of theirs must not lose this one
};

/// @param make  makes the job, a unique_ptr to what has run() -> transient::Run&
/// @return      the job, its run advanced to the end
/// @throws core::Interrupted after SIGTERM or SIGINT, when all is saved; core::Error where the run would take too long
template <class MakeJob> auto resumed_run(const MakeJob& make, const OwnCheckpoint& own) {
  const auto& [checkpoints, number, others_follow] = own;
  auto job = make();
  if (std::string state = checkpoints.found(number); !state.empty() && !restore(*job, std::move(state))) {
    checkpoints.refuse(number);
    job = make();
  }
  ExpectedTime expected(checkpoints.limit(), job->run().time());
  while (job->run().advance(Checkpoints::records_between_looks)) {
    expected.look(job->run().time());
    checkpoints.look(number, job->run());
  }
  if (others_follow)
    checkpoints.ended(number, job->run());
  return job;
}

} // namespace fretwork::app
