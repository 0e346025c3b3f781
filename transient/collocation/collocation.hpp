// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Contact laws held at the nodes 0, 1/2 and 1 of a step, modes exact under the forces through them.
#pragma once
#include "transient/scene/scheme.hpp"
#include <memory>

namespace fretwork::transient {

[[nodiscard]] std::unique_ptr<Scheme> make_collocation(const Scene& scene, double step);

} // namespace fretwork::transient
