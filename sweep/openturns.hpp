// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// OpenTURNS in a process of its own (openturns_helper.py): loading it takes a third of a second and some hundred libraries, and only sweeps
/// need it.
#pragma once
#include <nlohmann/json.hpp>
#include <vector>

namespace fretwork::sweep {

struct Answer {
  nlohmann::json json;
  std::vector<double> values; ///< of a request that draws
};

/// @param values  that go with the request, by rows
/// @throws core::Error where no Python has OpenTURNS and NumPy, or for what the helper refuses
[[nodiscard]] Answer ask_openturns(const nlohmann::json& request, const std::vector<double>& values);

} // namespace fretwork::sweep
