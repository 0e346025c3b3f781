// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Result files that are text, and names for files and groups.
#pragma once
#include <filesystem>
#include <string>
#include <string_view>

namespace fretwork::results {

/// The text as a whole file (see write_whole).
/// @throws core::Error if it cannot be written
void write_text(const std::filesystem::path& file, std::string_view text);

/// A name that may stand in a path: "/", "%", control characters and a leading "." as %XX. Different names
/// stay different.
[[nodiscard]] std::string path_name(std::string_view name);

/// The first bytes of a name, at most `width` > 3 with the "..." where it goes on; never half of a UTF-8 character.
[[nodiscard]] std::string shortened(const std::string& name, std::size_t width);

} // namespace fretwork::results
