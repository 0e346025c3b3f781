// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The straight Euler-Bernoulli beam with two nodes: axial displacement and torsion linear, bending in the
/// planes x-y and x-z cubic (Hermite), mass consistent with these shapes, no rotary inertia of bending, no
/// shear deformation. Element axes: x from a to b, y and z the principal axes of the section. Dofs: ux uy uz
/// rx ry rz of a, then of b; rz = duy/dx, ry = -duz/dx.
///
/// With d = u_b - u_a, chord rotation psi = x cross d / L and p = r - psi (components y, z):
///   2 U = EA/L d_x^2 + GJ/L (r_bx - r_ax)^2 + sum over y, z of EI/L (4 p_a^2 + 4 p_a p_b + 4 p_b^2)
/// Source: Przemieniecki, Theory of Matrix Structural Analysis, sections 5.6 and 11.3. Limits: slender beams;
/// static deflections at nodes exact; eigenvalues of bending converge as h^4 from above, of traction and
/// torsion as h^2.
#pragma once
#include "fem/model.hpp"
#include <Eigen/Core>

namespace fretwork::fem {

using Matrix12 = Eigen::Matrix<double, 12, 12>;
using Vector12 = Eigen::Matrix<double, 12, 1>;

struct ElementMatrices {
  Matrix12 stiffness; ///< N/m, N, N m
  Matrix12 mass;      ///< kg, kg m, kg m2
};

/// What the element's matrices are made of.
struct BeamConstants {
  Eigen::Matrix3d axes;   ///< rows x, y, z in global axes
  double length;          ///< m
  double axial;           ///< E A, N
  double torsion;         ///< G J, N m2
  double bending_y;       ///< E Iy, N m2
  double bending_z;       ///< E Iz, N m2
  double mass_axial;      ///< kg/m
  double mass_transverse; ///< kg/m
  double polar_inertia;   ///< density times polar inertia, kg m
};

/// Rows: the unit vectors x (from a to b), y, z of the element in global axes. The y axis lies in the plane
/// of x and `orientation`; without one, any section with iy = iz gives the same matrices and a fixed rule
/// picks it.
/// @throws core::Error for a beam of no length or an orientation along the beam
[[nodiscard]] Eigen::Matrix3d beam_axes(const Vec3& a, const Vec3& b, const std::optional<Vec3>& orientation);

/// @throws core::Error as beam_axes, and for a section with iy != iz without orientation
[[nodiscard]] BeamConstants beam_constants(const Vec3& a, const Vec3& b, const BeamProperty& property);

/// Stiffness and consistent mass, in global axes.
[[nodiscard]] ElementMatrices beam_element(const BeamConstants& beam);
[[nodiscard]] ElementMatrices beam_element(const Vec3& a, const Vec3& b, const BeamProperty& property);

/// 2 U of an element displacement (global axes), J, from its strains: rigid motions cancel before anything is
/// multiplied by a stiffness, so that the small energy of a fine mesh keeps its digits (K u does not).
[[nodiscard]] double twice_strain_energy(const BeamConstants& beam, const Vector12& displacement);

/// K u of an element, by its strains; global axes.
[[nodiscard]] Vector12 elastic_force(const BeamConstants& beam, const Vector12& displacement);

} // namespace fretwork::fem
