// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/support_sizes.hpp"
#include "core/error.hpp"
#include <cmath>
#include <fmt/format.h>

namespace fretwork::contact {

void check_size(std::string_view object, std::string_view name, double value) {
  if (!(value > 0.0) || !std::isfinite(value))
    throw core::Error(fmt::format("{}: {} = {:g} m makes no sense; give a length > 0", object, name, value));
}

void check_room(std::string_view object, double tube_radius, std::string_view name, double room,
                std::string_view otherwise) {
  check_size(object, "tube radius", tube_radius);
  check_size(object, name, room);
  if (room < tube_radius)
    throw core::Error(
        fmt::format("{}: {} = {:g} m is less than the tube radius, {:g} m; give at least the tube radius{}",
                    object, name, room, tube_radius, otherwise));
}

void check_clearance(std::string_view object, double tube_radius, std::string_view name, double room) {
  check_room(object, tube_radius, name, room);
  if (room == tube_radius)
    throw core::Error(fmt::format(
        "{}: {} = {:g} m is the tube radius and leaves no room; give a radius or width with a clearance",
        object, name, room));
}

} // namespace fretwork::contact
