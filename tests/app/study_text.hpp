// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Pieces of study files that many tests begin with.
#pragma once
#include <string>

namespace fretwork::app::test {

class Workshop;

/// [mesh], steel and the section "tube", a pipe of 19.05 x 1.09 mm. @param density  kg/m3
[[nodiscard]] std::string steel_pipe(const std::string& mesh_file, double density = 8000.0);

/// A study of 1 kg at the point "mass" of mesh.msh that a spring of 100 N/m holds along x and nothing else moves, for 1 s.
[[nodiscard]] std::string lone_mass();

/// A group of lines as a beam of it, and what its two ends (`group`_begin, `group`_end) are fixed by: "" for nothing.
[[nodiscard]] std::string tube_between(const std::string& group, const std::string& begin = "\"all\"",
                                       const std::string& end = "\"all\"");

/// Tubes of different lengths, side by side, clamped and pinned, each with a loose support with friction (node support0 ...) and a random
/// load (drive0 ...): as many runs. Writes bundle.msh. @param run  [transient] and [output]
[[nodiscard]] std::string bundle(const Workshop& folder, int tubes, const std::string& run);

/// A random load across the one of the bundle: the tube then slides round its support instead of bouncing along one line.
/// @param rms  N
[[nodiscard]] std::string across(const std::string& group, double rms = 20.0);

} // namespace fretwork::app::test
