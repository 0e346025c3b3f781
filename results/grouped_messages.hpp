// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Messages that say the same of several things, as one.
#pragma once
#include <cstddef>
#include <string>
#include <vector>

namespace fretwork::results {

/// Messages that differ only in names ("...") and numbers.
struct AlikeMessages {
  std::string text;                 ///< of all of them, as of grouped_messages
  std::vector<std::size_t> members; ///< their numbers, in order
};

/// In the order of their first ones.
[[nodiscard]] std::vector<AlikeMessages> alike_messages(const std::vector<std::string>& messages);

/// Messages that differ only in names ("...") and numbers become one, at the place of the first: names are listed (of more than three the
/// first, the last and their number), numbers and ranges become a range. Equal messages are said once.
///     contact "a": stiffness 3 N/m  +  contact "b": stiffness 5 N/m  ->  contact "a", "b": stiffness 3 to 5 N/m
[[nodiscard]] std::vector<std::string> grouped_messages(const std::vector<std::string>& messages);

} // namespace fretwork::results
