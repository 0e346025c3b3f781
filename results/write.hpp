// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Result files. Each is written under a temporary name and renamed when it is whole (whole_file.hpp): an interrupted
/// run leaves the last good ones. Those that are read back carry a checksum (checksum.hpp).
#pragma once
#include "results/run_results.hpp"
#include <cstdint>
#include <filesystem>
#include <optional>

namespace fretwork::results {

/// Number of the layout of the files: part of what tells whether stored results can be read. Raise it when the layout changes.
inline constexpr int file_layout = 14;

/// summary.json: keys as in doc/results.md; numbers with the shortest text that reads back the same, null
/// where they are not finite.
/// @throws core::Error if it cannot be written
void write_summary(const std::filesystem::path& file, const RunResults& results);

/// The short table at the end of a run, about 100 columns wide; it ends with what `directory` holds (nothing
/// where it is empty).
[[nodiscard]] std::string terminal_table(const RunResults& results,
                                         const std::filesystem::path& directory = {});

/// A prescribed motion: its largest acceleration and displacement, its record.
[[nodiscard]] std::string motion_text(const MotionFacts& motion);

/// A line a mode, at most 60: frequency, damping, estimated error of the mesh, effective mass by direction as
/// a share of the moving mass; their sum over all modes.
[[nodiscard]] std::string modes_table(const RunResults& results);

/// Terms of the damping by the flow along tubes, a line a mode, at most 60; empty without.
[[nodiscard]] std::string flow_damping_table(const RunResults& results);

/// Stability of tubes in their flow: a line a case (combination of constants), at most 20, the modes of the worst case,
/// its sweep of velocities; empty without.
[[nodiscard]] std::string stability_table(const RunResults& results);

/// stability.csv: one mode of one case a row; where flows have laws stability_diagram.csv: one mode at one factor of the velocity a row.
/// @throws core::Error if they cannot be written
void write_stability_csv(const std::filesystem::path& folder, const RunResults& results);

/// Linear response to turbulence, a line a displacement, at most 60; empty without.
[[nodiscard]] std::string response_table(const RunResults& results);

/// One displacement a row.
/// @throws core::Error if it cannot be written
void write_response_csv(const std::filesystem::path& file, const RunResults& results);

/// results.h5: layout as in doc/results.md and basis_file.hpp. The same results give the same bytes,
/// whatever the ranks and timings.
/// @throws core::Error if it cannot be written
void write_archive(const std::filesystem::path& file, const RunResults& results);

/// modes.h5: the bases, read back bit for bit; `key` tells what they were computed from. With the mesh, modes
/// can be exported from it.
/// @throws core::Error if it cannot be written
void write_bases(const std::filesystem::path& file, const RunRecord& record,
                 const std::vector<modal::Basis>& bases, const std::string& key,
                 const std::vector<core::Vec3>& nodes = {},
                 const std::vector<std::array<core::Index, 2>>& lines = {});
/// The bases, if the file exists, is as it was written and has this key.
struct FoundBases {
  std::optional<std::vector<modal::Basis>> bases;
  std::string
      refusal; ///< why the file is of no use; empty where there is none, it is of other inputs, or good
};
[[nodiscard]] FoundBases read_bases(const std::filesystem::path& file, const std::string& key);

/// Why results.h5 is not what a run of these inputs wrote; empty where it is.
[[nodiscard]] std::string archive_refusal(const std::filesystem::path& file, const std::string& input_sha256);

/// What the exports need, read back from results.h5, or from modes.h5 where there is no results.h5 (no
/// contacts, no series): all but statistics, facts of the transient, timings and warnings, which are in
/// summary.json.
/// @throws core::Error if the folder holds no results or the file is damaged
[[nodiscard]] RunResults read_archive(const std::filesystem::path& directory);

/// Of results.h5 what was computed: the nodes, the contacts without their series, what the beams are made of. Nothing where there is no file.
/// @throws core::Error if the file is damaged
[[nodiscard]] std::optional<RunResults> read_set_up(const std::filesystem::path& directory);

/// contact_<name>.csv and node_<name>.csv: time and all series; <name>_impacts.csv: one impact a row. Header
/// with units; numbers read back bit for bit. With wear also the files of export_wear_csv (wear_json.hpp).
/// @throws core::Error without a transient
void export_csv(const std::filesystem::path& directory, const RunResults& results);
/// Which outputs of the series a VTU export holds; nothing given: all, or `most_snapshots` evenly spread where there are more.
struct OutputWindow {
  std::optional<double> from = {}, to = {}; ///< s
  std::optional<std::int64_t> every =
      {}; ///< every n-th output of the window; none: `most_snapshots` of it at most
  [[nodiscard]] bool given() const { return from || to || every; }
};
inline constexpr Eigen::Index most_snapshots = 200;

/// What a VTU export wrote.
struct VtuSeries {
  Eigen::Index count = 0, outputs = 0; ///< instants written, of so many in the results
  double from = 0.0, to = 0.0;         ///< s, the first and the last
  double bytes = 0.0;                  ///< of all files
  bool contacts = false;
};

/// For ParaView (doc/paraview.md):
///     modes.vtu      structure, one vector array a mode (with several structures the k-th mode of each in one array)
///     snapshots.pvd  the moving structure in time: displacements, rotations, frames, radius; section forces and stresses
///     contacts.pvd   the contact points in time: forces as vectors, gaps, states
/// The two series need series of the modes; what an earlier export left of them is removed.
/// @throws core::Error without a mesh, for a window without outputs or where there are no series to choose from, and where the series
///         would not fit on the disk
VtuSeries export_vtu(const std::filesystem::path& directory, const RunResults& results,
                     const OutputWindow& window = {});
/// modes.msh: .msh 4.1 with a NodeData view a mode (with several structures the k-th mode of each in one
/// view).
/// @throws core::Error without a mesh
void export_msh(const std::filesystem::path& directory, const RunResults& results);

} // namespace fretwork::results
