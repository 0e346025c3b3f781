// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The straight Euler-Bernoulli beam.
#pragma once
#include "fem/model.hpp"
#include <Eigen/Core>

namespace fretwork::fem {

using Matrix12 = Eigen::Matrix<double, 12, 12>;

struct ElementMatrices {
  Matrix12 stiffness; ///< N/m, N, N m
  Matrix12 mass;      ///< kg, kg m, kg m2
};

/// Rows: the unit vectors x (from a to b), y, z of the element in global axes. The y axis lies in the plane of x and
/// `orientation`; without one, any section with iy = iz gives the same matrices and a fixed rule picks it.
/// @throws core::Error for a beam of no length or an orientation along the beam
[[nodiscard]] Eigen::Matrix3d beam_axes(const Vec3& a, const Vec3& b, const std::optional<Vec3>& orientation);

/// Stiffness and consistent mass of a straight 3D Euler-Bernoulli beam, no rotary inertia of bending, in global axes.
/// Dofs: ux uy uz rx ry rz of a, then of b.
[[nodiscard]] ElementMatrices beam_element(const Vec3& a, const Vec3& b, const BeamProperty& property);

} // namespace fretwork::fem
