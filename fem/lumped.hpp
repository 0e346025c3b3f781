// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Lumped masses and springs as 6 x 6 blocks (ux uy uz rx ry rz, global axes).
///
/// A body of mass m and inertia J about its centre, its centre at `arm` a from the node, moves with u + r
/// cross a; with S v = a cross v:  M = [ m I, -m S ; m S, J - m S S ].
#pragma once
#include "fem/model.hpp"
#include <Eigen/Core>

namespace fretwork::fem {

using Matrix6 = Eigen::Matrix<double, 6, 6>;

[[nodiscard]] Matrix6 lumped_mass_matrix(const LumpedMass& body);

} // namespace fretwork::fem
