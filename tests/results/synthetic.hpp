// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Results made up for tests: a straight pinned tube with supports along it, rattling in a plausible way. No
/// solver behind them.
#pragma once
#include "results/run_results.hpp"
#include <string>

namespace fretwork::results {

struct Made {
  int contacts = 3;
  Eigen::Index outputs = 200; ///< 0: modes only
  int structures = 1;         ///< tubes side by side, all equal
  int modes = 6;              ///< of each
  int elements = 24;          ///< of each
};

[[nodiscard]] RunResults made_up(const Made& made = {});

/// Of each contact a support: work rates that rise along the tube, the third outside its law, the fourth without an end of its life.
[[nodiscard]] Wear made_up_wear(const RunResults& results);

} // namespace fretwork::results
