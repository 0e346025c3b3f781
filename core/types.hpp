// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Small aliases used everywhere.
#pragma once
#include <Eigen/Core>
#include <cstdint>

namespace fretwork::core {

/// Number of a node, an element, a structure.
using Index = std::int32_t;
/// Coordinates and displacements in the global axes, m.
using Vec3 = Eigen::Vector3d;
/// Degrees of freedom of a node, in this order: ux uy uz (m) rx ry rz (rad).
inline constexpr int dofs_per_node = 6;

} // namespace fretwork::core
