// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Text that may hold anything, as a terminal may be given it.
#pragma once
#include <string>
#include <string_view>

namespace fretwork::core {

/// The text with control characters but the line feed as \xNN (a terminal obeys escape sequences); of lines longer than `longest` bytes the
/// beginning and how many bytes follow.
[[nodiscard]] std::string printable(std::string_view text, std::size_t longest);

inline constexpr std::size_t longest_message_line = 2000; ///< bytes

} // namespace fretwork::core
