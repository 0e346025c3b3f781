// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Checks of numbers that come from the input.
#pragma once
#include <string_view>

namespace fretwork::wear {

/// @param where  the object it belongs to: "flat bar"   @param name  "tube radius"   @param unit  "m"
/// @throws core::Error unless the value is finite and > 0
void check_positive(std::string_view where, std::string_view name, double value, std::string_view unit);

/// @throws core::Error unless the value is finite and >= 0
void check_not_negative(std::string_view where, std::string_view name, double value, std::string_view unit);

} // namespace fretwork::wear
