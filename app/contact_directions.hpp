// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Along which directions flat obstacles limit the motion of their tubes.
#pragma once
#include "app/build_contacts.hpp"

namespace fretwork::app {

/// One line: of planes, stops and bars along y_loc or z_loc the direction in global axes and how it lies to the tube (in the plane of a bend, out
/// of it, across or along a straight tube). Empty without such obstacles.
[[nodiscard]] std::string directions_text(const study::Study& study, const fem::Model& model,
                                          const std::vector<PlacedContact>& placed);

} // namespace fretwork::app
