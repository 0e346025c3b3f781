// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The commands: the only place that knows the whole chain from the study file to the results.
#pragma once
#include "app/stages.hpp"

namespace fretwork::app {

enum class Stage { mesh, modes, stability, response, transient };

/// Collective. The chain up to a stage: mesh, modes, stability in flow, transient with results (and stability where the
/// study asks for it). `with_report`: also
/// DIR/report.html.
void run_chain(MPI_Comm comm, const Request& request, Stage last);

/// Reads and checks all that can be checked without computing, on one process without MPI.
/// @return what was found, for the terminal
[[nodiscard]] std::string check(const Request& request);

/// Writes DIR/export-<format>/ from the results in DIR; format csv, vtu or msh.
/// @return where the files are, for the terminal
[[nodiscard]] std::string export_results(const std::filesystem::path& directory, const std::string& format);

} // namespace fretwork::app
