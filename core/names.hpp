// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Help for messages about names that do not exist.
#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace fretwork::core {

/// The candidate nearest to `name` (edit distance, case ignored) of which at most a third of the characters would have to change; else the shortest
/// that begins with `name`, if it begins all others that do; else an empty string.
[[nodiscard]] std::string nearest_name(std::string_view name, const std::vector<std::string>& candidates);

/// `"a", "b", "c"`, or `none` for an empty list; at most `most` names, then how many more there are.
[[nodiscard]] std::string list_names(const std::vector<std::string>& names, std::size_t most = 20);

/// `; did you mean "b"? existing: "a", "b"`: what follows a message about an unknown name.
[[nodiscard]] std::string name_help(std::string_view name, const std::vector<std::string>& candidates,
                                    std::string_view existing = "existing");

/// Whether a name fits a pattern, in which `*` stands for any characters and `?` for one.
[[nodiscard]] bool fits(std::string_view name, std::string_view pattern);

} // namespace fretwork::core
