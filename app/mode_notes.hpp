// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// What the user should know of the mesh and the modes: warnings and notes of results.
#pragma once
#include "mesh/line_mesh.hpp"
#include "results/run_results.hpp"
#include "study/study.hpp"

namespace fretwork::app {

/// Groups of equal frequencies that are cut, a mesh that is too coarse, damping ratios given as per cent, lists of ratios that differ between modes of equal frequency, copies, fewer modes than asked for.
void note_modes(const study::Study& study, results::RunResults& out);

/// Nodes at the same place that are not joined.
void note_coincident_nodes(const mesh::LineMesh& mesh, results::RunResults& out);

} // namespace fretwork::app
