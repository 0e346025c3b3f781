// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Files that the user names.
#pragma once
#include <filesystem>
#include <string>

namespace fretwork::core {

/// @param what  the file in messages, e.g. `study file a.toml`
/// @throws Error if there is no such file, or it is a folder, a pipe or a device, which may have no end
void check_input_file(const std::filesystem::path& file, const std::string& what);

/// Its bytes.
/// @param most  bytes, 0: no limit
/// @throws Error also if it cannot be read or has more than `most` bytes
[[nodiscard]] std::string read_input_file(const std::filesystem::path& file, const std::string& what,
                                          std::uintmax_t most = 0);

} // namespace fretwork::core
