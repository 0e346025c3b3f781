// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Run another program: readers that may crash, hang or are slow to load (gmsh, meshio) stay outside our process.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace fretwork::core {

class Confinement;

struct ChildResult {
  int status = 0;     ///< exit status; 128 + signal when a signal ended it; 127 when it could not be started
  std::string output; ///< what it wrote to standard output and standard error, in order
  std::string stopped = {}; ///< why it was ended by us ("it ran for more than 120 s"); empty: it was not
};

/// 0: no limit.
struct ChildLimits {
  double seconds = 0.0;           ///< on the clock
  std::uint64_t memory_bytes = 0; ///< of its address space
  std::uint64_t file_bytes = 0;   ///< of each file that it writes
  std::uint64_t output_bytes = 0; ///< on its standard output and error
};

/// Run `arguments[0]` (searched on PATH) with its arguments, no shell, no standard input; wait for its end. It dies with this process,
/// however that ends; with a limit of time so do the processes that it started.
/// @param confinement  nullptr: none
/// @throws core::Interrupted after SIGTERM, SIGINT or SIGHUP where these would end this process: the child is ended first, and what the
///         caller has made for it is removed on the way
[[nodiscard]] ChildResult run_child(const std::vector<std::string>& arguments, const ChildLimits& limits = {},
                                    const Confinement* confinement = nullptr);

/// Directory of the running executable, without a final slash.
[[nodiscard]] std::string executable_directory();

} // namespace fretwork::core
