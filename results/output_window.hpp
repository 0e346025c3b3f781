// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The outputs of a series that an export is to hold.
#pragma once
#include "results/write.hpp"

namespace fretwork::results {

/// Numbers of the outputs, ascending: those from `from` to `to` (both included, to within round-off), of them every n-th from the first
/// on; without `every` the first, the last and as many evenly between them as make `most_snapshots` at most.
/// @param time  s, ascending, at least one
/// @throws core::Error that names the option, for times that are no numbers or outside the series, a window with no output, every < 1
[[nodiscard]] std::vector<Eigen::Index> outputs_of(const OutputWindow& window, const Eigen::VectorXd& time);

} // namespace fretwork::results
