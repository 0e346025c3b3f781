// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Whether sizes of a support can hold a tube. Messages name the object and the size, e.g. "drilled hole", "hole radius".
#pragma once
#include <string_view>

namespace fretwork::contact {

/// @throws core::Error unless the value is a length > 0, m
void check_size(std::string_view object, std::string_view name, double value);
/// @param otherwise  what the message ends with for a room that is too small: how to model what may have been meant
/// @throws core::Error unless both are sizes and the room is at least the tube's radius, m
void check_room(std::string_view object, double tube_radius, std::string_view name, double room,
                std::string_view otherwise = "");
/// @throws core::Error as above, and without a clearance
void check_clearance(std::string_view object, double tube_radius, std::string_view name, double room);

} // namespace fretwork::contact
