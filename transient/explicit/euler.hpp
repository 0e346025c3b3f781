// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Semi-implicit Euler.
#pragma once
#include "transient/scene/scheme.hpp"
#include <memory>

namespace fretwork::transient {

[[nodiscard]] std::unique_ptr<Scheme> make_euler(const Scene& scene, double step);

} // namespace fretwork::transient
