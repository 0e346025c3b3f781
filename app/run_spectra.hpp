// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// What is written beside summary.json where tubes stand in a flow: the flow along them, spectra of turbulence and of the run.
#pragma once
#include "app/turbulent_loads.hpp"
#include "results/flow_files.hpp"
#include "results/run_results.hpp"

namespace fretwork::app {

/// The flow at the middle of every element of every tube.
[[nodiscard]] std::vector<results::FlowRow> flow_rows(const study::Study& study, const fem::Model& model,
                                                      const std::vector<PlacedFlow>& flows);

/// Force per length of the turbulence where each zone is fastest, over its band; then, of a run, displacements of observed nodes and
/// contacts and normal forces from the output instants in the window of the statistics, by Welch's method (flow/welch.hpp) in eight stretches of the window.
/// Motion above half the output rate is folded back: folding_note.
[[nodiscard]] std::vector<results::Spectrum> run_spectra(const std::vector<TurbulentLoad>& loads,
                                                         const results::RunResults& results);

/// Names the estimates that have more than a hundredth of their variance in the upper quarter of their frequencies, so that motion above
/// half the output rate is folded into them; empty where none has.
[[nodiscard]] std::string folding_note(const std::vector<results::Spectrum>& spectra);

} // namespace fretwork::app
