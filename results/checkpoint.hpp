// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// checkpoint.h5: the state of a run on its way, to go on from it after an interruption.
#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace fretwork::results {

/// Which run of which program a state belongs to: to any other it means nothing.
struct RunIdentity {
  std::string version;      ///< of the program
  std::string input_sha256; ///< of all that the run is computed from
  std::int64_t run = 0;     ///< number among the runs of the study
  std::string build = {};   ///< of the program: what one build keeps, another may read otherwise
};

struct Checkpoint {
  double time = 0.0; ///< s, simulated
  std::string state; ///< bytes of core::StateArchive
};

/// Writes the whole file anew. It is on the disk before it takes the place of the one before: whatever happens meanwhile, one of the
/// two is there and whole.
/// @throws core::Error if it cannot be written
void write_checkpoint(const std::filesystem::path& file, const RunIdentity& identity,
                      const Checkpoint& checkpoint);

/// What there is to go on from.
struct FoundCheckpoint {
  std::optional<Checkpoint> checkpoint;
  std::string refusal; ///< why the file is of no use; empty where there is none, or it is good
};
[[nodiscard]] FoundCheckpoint read_checkpoint(const std::filesystem::path& file, const RunIdentity& wanted);

} // namespace fretwork::results
