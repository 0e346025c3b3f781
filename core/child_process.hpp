// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Run another program: readers that may crash or are slow to load (gmsh, meshio) stay outside our process.
#pragma once
#include <string>
#include <vector>

namespace fretwork::core {

struct ChildResult {
  int status = 0;     ///< exit status; 128 + signal when a signal ended it; 127 when it could not be started
  std::string output; ///< what it wrote to standard output and standard error, in order
};

/// Run `arguments[0]` (searched on PATH) with its arguments, no shell, no standard input; wait for its end.
[[nodiscard]] ChildResult run_child(const std::vector<std::string>& arguments);

/// Directory of the running executable, without a final slash.
[[nodiscard]] std::string executable_directory();

} // namespace fretwork::core
