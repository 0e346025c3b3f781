// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The flow along tubes in summary.json: keys as in doc/results.md.
#pragma once
#include "results/run_results.hpp"
#include <nlohmann/json_fwd.hpp>

namespace fretwork::results {

/// Adds `flow`, `stability`, `fluidelastic` and `response` where there are any.
void add_flow(nlohmann::ordered_json& out, const RunResults& results);

} // namespace fretwork::results
