// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Words that the tables of assessments on linear modes share.
#pragma once
#include "results/run_results.hpp"
#include <string>
#include <vector>

namespace fretwork::results {

/// `pinned at tsp1, tsp2 and 4 more`, `nothing pinned`.
[[nodiscard]] std::string pinned_text(const std::vector<std::string>& names);

/// Number of the case with the largest ratio, of at least one.
[[nodiscard]] std::size_t worst_case(const flow::Stability& stability);

/// Crossings of zero damping and the modes at the velocities given, beside Connors; empty without a law.
[[nodiscard]] std::string law_table(const StabilityAssessment& assessment);

/// Of a run under fluidelastic laws, for the terminal: of each that is unstable without contacts where its tubes move most, and what the
/// fluid brings and dampers take; of the others that they are stable.
[[nodiscard]] std::vector<std::string> law_motion_lines(const RunResults& results);

/// The text of stability_diagram.csv: one mode at one factor of the velocity a row; empty without a law.
[[nodiscard]] std::string stability_diagram_csv(const RunResults& results);

/// A cell of a CSV file between quotes; a quote within is doubled.
[[nodiscard]] std::string quoted(std::string text);

} // namespace fretwork::results
