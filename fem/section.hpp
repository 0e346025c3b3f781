// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Sections by shape, m. Each throws core::Error for a size that makes no section.
#pragma once
#include "fem/model.hpp"

namespace fretwork::fem {

[[nodiscard]] Section pipe_section(double outer_diameter, double thickness);
[[nodiscard]] Section circle_section(double diameter);
/// Torsion constant: Saint-Venant series of the rectangle.
[[nodiscard]] Section rectangle_section(double height_y, double height_z);

} // namespace fretwork::fem
