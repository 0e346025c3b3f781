// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Files that are there whole or not at all.
#pragma once
#include <filesystem>
#include <initializer_list>
#include <string_view>

namespace fretwork::results {

enum class Durability {
  on_disk, ///< on the disk before it takes its name: what is read back later
  cached,  ///< as the system pleases: what can be exported again
};

/// Writes the parts, one after the other, as a new file `<name>.part.<ending>` beside `file`, which then takes the name `file`. The new file
/// is created exclusively: no symbolic link is followed. Whatever fails, the status of every call is checked, the part file is removed and
/// `file` is what it was. Makes the folder where there is none.
/// @throws core::Error that names the file and what failed
void write_whole(const std::filesystem::path& file, std::initializer_list<std::string_view> parts,
                 Durability durability = Durability::on_disk);

} // namespace fretwork::results
