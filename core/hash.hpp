// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// SHA-256 digests: what identifies the inputs of a stage.
#pragma once
#include <string>
#include <string_view>

namespace fretwork::core {

/// Hexadecimal SHA-256 of the bytes (64 characters).
[[nodiscard]] std::string sha256(std::string_view bytes);

} // namespace fretwork::core
