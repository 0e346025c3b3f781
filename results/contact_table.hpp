// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The contacts of a run on the terminal.
#pragma once
#include "results/run_results.hpp"

namespace fretwork::results {

/// A line a contact with its impacts, forces, position and powers, their sums; flat obstacles (contact_position.hpp) once more, normal
/// position and sliding apart. Of many contacts those with the largest work rates, or, where none slides, forces. r and penetration in micrometres, r from the
/// obstacle's centre.
[[nodiscard]] std::vector<std::string> contact_lines(const RunResults& results);

} // namespace fretwork::results
