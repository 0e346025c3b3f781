// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The explicit scheme of order 4 by de Vogelaere.
#pragma once
#include "transient/scene/scheme.hpp"
#include <memory>

namespace fretwork::transient {

[[nodiscard]] std::unique_ptr<Scheme> make_devogelaere(const Scene& scene, double step);

} // namespace fretwork::transient
