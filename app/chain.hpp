// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The commands: the only place that knows the whole chain from the study file to the results.
#pragma once
#include "app/stages.hpp"

namespace fretwork::app {

enum class Stage { mesh, modes, stability, response, check, transient };

/// Collective. The chain up to a stage: mesh, modes, stability in flow, transient with results (and stability where the
/// study asks for it). `with_report`: also
/// DIR/report.html. `check`: all that the transient needs, without its steps; nothing is written but the mesh and the modes.
void run_chain(MPI_Comm comm, const Request& request, Stage last);

/// What the study as it stands warns of as a case of a sweep, before its steps are chosen; alike ones together. On this process alone; prints
/// nothing.
/// @throws core::Error, core::ComputationError for what a run would refuse before
[[nodiscard]] std::vector<std::string> warnings_of_case(const Request& request);

/// Refuses what a run would refuse, and says what it would be: the chain up to the first step of the transient, in a temporary folder, on
/// this process alone.
void check(const Request& request);

} // namespace fretwork::app
