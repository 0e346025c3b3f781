// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// SHA-256 digests: what identifies the inputs of a stage, and what tells that a file is as it was written.
#pragma once
#include <string>
#include <string_view>

namespace fretwork::core {

/// Hexadecimal SHA-256 of the bytes (64 characters).
[[nodiscard]] std::string sha256(std::string_view bytes);

inline constexpr std::size_t sha256_digits = 64;

/// Hexadecimal SHA-256 of the bytes of a file from `offset` on; empty where it cannot be read that far.
[[nodiscard]] std::string sha256_of_file(const std::string& file, std::size_t offset);

} // namespace fretwork::core
