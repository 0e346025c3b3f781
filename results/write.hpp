// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Result files. Each is written under a temporary name and renamed when it is whole: an interrupted run leaves the last good ones.
#pragma once
#include "results/run_results.hpp"
#include <filesystem>
#include <functional>

namespace fretwork::results {

/// Calls `write` with a temporary name beside `file`, then renames. Removes the temporary file when `write` throws.
/// @throws core::Error if the folder cannot be written
void write_whole(const std::filesystem::path& file, const std::function<void(const std::filesystem::path&)>& write);

/// summary.json: keys as in doc/study-file.md; numbers with the shortest text that reads back the same.
void write_summary(const std::filesystem::path& file, const RunResults& results);

/// The short table at the end of a run.
[[nodiscard]] std::string terminal_table(const RunResults& results);

/// results.h5: layout as in doc/study-file.md. The same results give the same bytes.
void write_archive(const std::filesystem::path& file, const RunResults& results);

/// modes.h5: the bases, read back bit for bit; `key` tells what they were computed from.
void write_bases(const std::filesystem::path& file, const RunRecord& record, const std::vector<modal::Basis>& bases, const std::string& key);
/// The bases, if the file exists, is whole and has this key.
[[nodiscard]] std::optional<std::vector<modal::Basis>> read_bases(const std::filesystem::path& file, const std::string& key);

/// What `export` needs, read back from results.h5 (or modes.h5 only: no series).
/// @throws core::Error if the folder holds no results
[[nodiscard]] RunResults read_archive(const std::filesystem::path& directory);

/// One CSV a contact and a node: time and all its series, header with units.
void export_csv(const std::filesystem::path& directory, const RunResults& results);
/// modes.vtu (one vector array a mode) and, with a transient, snapshots.pvd with its .vtu files.
void export_vtu(const std::filesystem::path& directory, const RunResults& results);
/// modes.msh: .msh 4.1 with a NodeData view a mode.
void export_msh(const std::filesystem::path& directory, const RunResults& results);

} // namespace fretwork::results
