// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Words that the tables of assessments on linear modes share.
#pragma once
#include <string>
#include <vector>

namespace fretwork::results {

/// `pinned at tsp1, tsp2 and 4 more`, `nothing pinned`.
[[nodiscard]] std::string pinned_text(const std::vector<std::string>& names);

/// A cell of a CSV file between quotes; a quote within is doubled.
[[nodiscard]] std::string quoted(std::string text);

} // namespace fretwork::results
