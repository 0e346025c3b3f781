// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The beam with two nodes, its axis straight or an arc, its section constant or changing along it; by Euler and
/// Bernoulli (neither shear deformation nor rotary inertia of bending) unless its section has them (Timoshenko).
/// Dofs: ux uy uz rx ry rz of a, then of b, global axes.
///
/// Element axes: x along the chord from a to b. With d = u_b - u_a and the span c = x_b - x_a,
///     e = (d - r_a x c, r_b - r_a),   2 U = e^T S e,   K = T^T S T  where  e = T u.
/// Rigid motions cancel in e, before anything is multiplied by a stiffness. S and the mass of any beam are those
/// of flexible_beam.hpp (shapes exact for static end loads). A straight uniform beam has them in closed form:
///   S: EA/L, GJ/L, bending EI/L^3 [12, -6L; -6L, 4L^2];
///   mass: in bending consistent with cubic (Hermite) shapes; in traction and torsion m L/12 [5 1; 1 5], the mean
///   of the consistent and the lumped one, whose errors in frequency, (k h)^2/24 and its opposite, cancel.
/// An axial force N (tension > 0, straight beams) adds N G to S (flexible_beam.hpp) and N |d_t|^2 / L to 2 U, d_t
/// being d across the beam. The second is no deformation: a beam under tension resists being turned. N neither
/// follows from loads nor changes with the motion.
/// Source: Przemieniecki, Theory of Matrix Structural Analysis, sections 5.6, 11.3 and 15.2. Limits: slender beams;
/// with shear and rotary inertia, waves some heights of the section long.
/// Static deflections at nodes are exact (without N). Frequencies of K and M converge as h^4 from above in bending; in
/// traction and torsion as h^4 from below, -(k h)^4/480, along equal elements between ends that are free or held, and
/// as h^2 where the axial force or its wave number jumps (lumped masses, springs, corners, changes of the element
/// length): inner_motion.hpp takes this error from the frequencies. What shear takes from a frequency of bending converges
/// as h^2.
#pragma once
#include "fem/flexible_beam.hpp"

namespace fretwork::fem {

class BeamElement {
public:
  /// @param middle  a point of the arc from a to b; none: straight
  /// @throws core::Error for a beam of no length, a middle that is not between the ends, an orientation along
  /// the beam, a section with iy != iz without orientation, or an axial force in an arc
  /// @param along  of a and b on the way of the property's taper
  BeamElement(const Vec3& a, const Vec3& b, const BeamProperty& property,
              const std::optional<Vec3>& middle = std::nullopt,
              const std::array<double, 2>& along = {0.0, 1.0});
  BeamElement(const Model& model, const Beam& beam);

  [[nodiscard]] const BeamAxis& axis() const { return axis_; }
  [[nodiscard]] Matrix12 stiffness() const; ///< N/m, N, N m
  [[nodiscard]] Matrix12 mass() const;      ///< kg, kg m, kg m2
  [[nodiscard]] InnerMotion inner_motion() const;

  /// 2 U of an element displacement, J, from its deformation: the small energy of a fine mesh keeps its digits
  /// (K u does not).
  [[nodiscard]] double twice_strain_energy(const Vector12& displacement) const;
  /// K u, likewise from the deformation.
  [[nodiscard]] Vector12 elastic_force(const Vector12& displacement) const;

  /// Displacement and rotation at the share (0 to 1) of the axis, of the dofs.
  [[nodiscard]] Shapes shapes(double share) const;
  /// Rows: x_loc (along the axis towards b), y_loc, z_loc of the section at the share (0 to 1) of the axis, global axes.
  [[nodiscard]] Eigen::Matrix3d section_axes(double share) const;
  /// N Vy Vz T My Mz (N, N m) of the section there, in its axes: what the part beyond it, towards b, exerts on the part before it.
  /// They follow from the deformation by the shapes of the element: on straight uniform beams N = EA u', T = GJ rx',
  /// My = -EIy w'', Mz = EIz v'', Vy = -EIz v''', Vz = -EIy w''' (v, w without the deflection by shear), so that N, T, Vy and Vz are
  /// constant along the element and My, Mz linear; exact for loads at the nodes, of order 2 in the length for loads between them. The
  /// preload axial_force is not in N.
  [[nodiscard]] Vector6 section_forces(const Vector12& displacement, double share) const;
  /// The same at an end, of what its nodes exert on the element (global axes). With `held` = (K - omega^2 M) u of a mode they are
  /// equal on both sides of a node that nothing loads, and of order 4 in the length in bending; an axial_force N adds N v' and N w'
  /// to Vy and Vz.
  [[nodiscard]] Vector6 end_forces(const Vector12& held, bool at_b) const;
  /// Consistent forces and moments at the dofs of a uniform line force (N/m along the axis, global direction).
  [[nodiscard]] Vector12 line_force(const Vec3& force_per_length) const;

private:
  /// e, in element axes.
  [[nodiscard]] Vector6 deformation(const Vector12& displacement) const;
  [[nodiscard]] Vec3 across(const Vector12& displacement) const; ///< d_t, global axes
  [[nodiscard]] FlexibleBeam flexible() const { return {axis_, axes_, property_, along_}; }

  BeamProperty property_;
  std::array<double, 2> along_;
  BeamAxis axis_;
  Eigen::Matrix3d axes_; ///< rows x, y, z of the element
  double chord_;         ///< m
  Matrix6 elastic_;      ///< S, element axes
  Matrix6 stiffness_;    ///< S + N G
  double string_ = 0.0;  ///< N / L, N/m
};

} // namespace fretwork::fem
