// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The checkpoints of a study's runs: DIR/checkpoint.h5 of the first, DIR/checkpoint-2.h5 of the second ...
#pragma once
#include "app/end_signal.hpp"
#include "app/expected_time.hpp"
#include "results/checkpoint.hpp"
#include "transient/run.hpp"
#include <chrono>
#include <functional>
#include <optional>
#include <vector>

namespace fretwork::app {

struct CheckpointOptions {
  std::filesystem::path directory;
  std::string version, input_sha256;            ///< as in results::RunIdentity
  double every = 0.0;                           ///< s on the clock; 0: none is written
  bool resume = true;                           ///< go on from what an earlier run has left
  std::function<void(const std::string&)> tell; ///< a line for the user
  TimeLimit limit = {};                         ///< of each run
};

/// What the runs of one rank keep, one run after the other: after an interruption at most `every` seconds of their work are lost.
class Checkpoints {
public:
  /// While it lives SIGTERM and SIGINT (Ctrl-C) end the run at its next look, where checkpoints are written at all.
  explicit Checkpoints(CheckpointOptions options);
  Checkpoints(const Checkpoints&) = delete;
  Checkpoints& operator=(const Checkpoints&) = delete;

  /// Records that a run makes before it is looked at again: at a microsecond each, reading the clock costs 0.1 %; at several
  /// milliseconds each (large bundles) a signal is noticed within half a second.
  static constexpr std::int64_t records_between_looks = 64;

  /// The state that an earlier run with this number has left, told to the user. Empty: it starts at the beginning.
  [[nodiscard]] std::string found(std::size_t run) const;
  /// What was found does not fit the run, which starts at the beginning after all.
  void refuse(std::size_t run) const;
  /// Saves the run, and those that have ended, when it is time to. Where that fails a line says so, and the run goes on. After a signal
  /// a process of its own saves them, in a session of its own: it completes the file also where a launcher kills the process group of
  /// this one soon after (Open MPI's mpirun: 1 s).
  /// @throws core::Interrupted after SIGTERM or SIGINT, when all is saved
  void look(std::size_t run, transient::Run& state);
  [[nodiscard]] const TimeLimit& limit() const { return options_.limit; }
  /// The run has come to its end; others follow.
  void ended(std::size_t run, transient::Run& state);

  /// Removes all checkpoints of a folder.
  static void remove(const std::filesystem::path& directory);

private:
  using Clock = std::chrono::steady_clock;
  struct Pending {
    std::size_t run;
    results::Checkpoint checkpoint;
  };
  [[nodiscard]] std::filesystem::path file(std::size_t run) const;
  [[nodiscard]] results::RunIdentity identity(std::size_t run) const;
  /// @return  whether all that was pending is written
  bool write();
  /// Saves the run by another process and waits for its end.
  /// @return  whether all is written
  [[nodiscard]] bool write_apart(std::size_t run, transient::Run& state);

  CheckpointOptions options_;
  std::vector<Pending> pending_; ///< of runs that have ended since the last writing
  Clock::time_point last_ = Clock::now();
  bool failed_ = false;
  std::optional<EndSignal> signal_;
};

} // namespace fretwork::app
