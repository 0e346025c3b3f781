// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "post/moments.hpp"
#include <cmath>
#include <nlohmann/json.hpp>

namespace fretwork::results {

using Json = nlohmann::ordered_json;

/// JSON knows no infinity and no NaN: a run that diverged leaves null.
inline Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

inline Json moments(const post::Moments& m) {
  return {{"mean", number(m.mean)}, {"std", number(m.std)}, {"min", number(m.min)}, {"max", number(m.max)}};
}

} // namespace fretwork::results
