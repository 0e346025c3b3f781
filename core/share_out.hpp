// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Independent pieces of work over ranks.
#pragma once
#include <vector>

namespace fretwork::core {

/// Gives every piece to a rank: the costliest first, to the rank with the least work so far; the lower number
/// where they are equal. So every rank finds the same.
/// @param costs  of the pieces, in any unit
/// @return       the rank of each piece
[[nodiscard]] std::vector<int> share_out(const std::vector<double>& costs, int ranks);

} // namespace fretwork::core
