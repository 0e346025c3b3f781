// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cmath>
#include <nlohmann/json.hpp>

namespace fretwork::results {

using Json = nlohmann::ordered_json;

/// JSON knows no infinity and no NaN: a run that diverged leaves null.
inline Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

} // namespace fretwork::results
