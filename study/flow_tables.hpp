// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Quantities along a tube: a number, rows [s, value], or a file of rows.
///
/// A file with a header has a column `s` and one of the key's name (`velocity_x`, `velocity_y`, `velocity_z` of a
/// vector); other columns are passed over, so that one file may serve all keys. Without a header its columns are s and the
/// value, or s and the three components.
#pragma once
#include "flow/profile.hpp"
#include "study/table_reader.hpp"
#include <filesystem>
#include <string>
#include <vector>

namespace fretwork::study {

/// Keys of a zone whose values may be tables.
inline const std::vector<std::string> flow_table_keys{"velocity", "density",   "void_fraction",
                                                      "quality",  "mass_flux", "fluid_inside"};

/// @param key  is in the table
/// @throws core::Error naming key, row and file
[[nodiscard]] flow::Table<double> read_flow_table(const TableReader& table, const std::string& key,
                                                  const std::filesystem::path& folder,
                                                  const Quantity& quantity);

/// `velocity`: also a vector [x, y, z], rows [s, x, y, z], or a file of them. A speed that is not there is 0.
[[nodiscard]] flow::Velocity read_velocity(const TableReader& zone, const std::filesystem::path& folder);

/// Puts the rows of files in the place of their names, in every zone of an entry of `[[flow]]`.
/// @param path  of the entry, for messages
/// @throws core::Error if a file cannot be read
void inline_flow_tables(Value& entry, const std::string& path, const std::filesystem::path& folder);

} // namespace fretwork::study
