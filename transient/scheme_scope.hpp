// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// What of a scene each scheme can take.
#pragma once
#include "transient/scene/scheme.hpp"

namespace fretwork::transient {

/// What of the scene the scheme cannot take, as the end of a sentence that begins with its name; empty where it takes all.
[[nodiscard]] std::string out_of_scope(const Scene& scene, SchemeKind kind);

/// @throws core::Error that names the scheme, what it cannot take and a scheme that can
void check_scope(const Scene& scene, SchemeKind kind);

} // namespace fretwork::transient
