// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// A beam along any axis by the force method: what wrenches at its end b do to it while its end a is held.
///
/// A wrench w = (f, m) at b acts on the section at s as the force f and the moment m + (x_b - x(s)) x f. With
/// C(s) the section's compliance (1/EA, 1/(k_y G A), 1/(k_z G A); 1/GJ, 1/EIy, 1/EIz in its axes), the section
/// at s moves by
///     theta(s) = int_0^s C M dr,    u(s) = int_0^s [C_f f + theta'(r) x (x(s) - x(r))] dr = D(s) w.
/// D(L) is the flexibility at b, S = D(L)^-1 the stiffness against the deformation
///     e = (d - r_a x (x_b - x_a), r_b - r_a),  d = u_b - u_a,
/// which no rigid motion changes. The motion of a section under end loads alone, and the shapes of the element:
///     u(s) = u_a + r_a x (x(s) - x_a) + D(s) S e.
/// They are exact for static loads at the ends whatever the axis and however the section changes along it, so
/// that nothing locks, neither arcs nor slender beams that shear; on a straight uniform axis they are the linear
/// and cubic shapes of the textbook.
///
/// Mass: consistent with these shapes, rotary inertia of bending with their rotations; to it comes
/// L^2/12 int [m_x eps^2 + rho Ip kappa_x^2] ds of the axial strain and the twist, which makes traction and
/// torsion of order 4 along equal beams (on a straight uniform beam: the mean of the consistent and the lumped
/// mass). InnerMotion has what it takes to be of order 4 everywhere (inner_motion.hpp). On an arc of curvature k a
/// section that moves along the tangent by b turns by k b in the plane of the arc, one that turns about the
/// tangent by b bends by k b: both fulfil the kinematics of Euler and Bernoulli, so that u + b c is a motion of the beam.
///
/// Axial force N of a straight beam: the work on the slopes u_t'(s) across it (shear included, so that a column
/// that shears buckles at Engesser's load), 2 U = N int |u_t'|^2 ds = N |d_t|^2 / L + N e^T G e, the mean slope
/// and the spread about it.
///
/// Integrals by Gauss with 8 points: exact to round-off for straight uniform beams and arcs of up to 2 rad, and
/// to 1e-11 for a section that grows by half along an element.
/// Source: the force method for curved bars, e.g. Timoshenko, Strength of Materials II, chapter 2;
/// Przemieniecki, Theory of Matrix Structural Analysis, chapters 6 and 15; Timoshenko and Gere, Theory of Elastic
/// Stability, section 2.17.
#pragma once
#include "fem/beam_axis.hpp"
#include "fem/beam_constants.hpp"

namespace fretwork::fem {

using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Matrix12 = Eigen::Matrix<double, 12, 12>;
using Vector6 = Eigen::Matrix<double, 6, 1>;
using Vector12 = Eigen::Matrix<double, 12, 1>;
using Shapes = Eigen::Matrix<double, 6, 12>; ///< displacement and rotation of a section, of the 12 dofs

/// Two motions b(s) c_1 and b(s) c_2 of the inside of a beam with both ends held: along its axis and turning about
/// it, b = 4 s (L - s) / L^2.
///     2 U = u^T K u + c^T stiffness c,   2 T = u^T (M - strain_mass^T strain_mass) u + 2 c^T coupling u + c^T mass c
/// of u + b c, u with the shapes of the element (T: for unit velocities). The shapes are exact for loads at the
/// ends, so that no strain energy couples the two.
struct InnerMotion {
  Eigen::Matrix2d stiffness, mass;
  Eigen::Matrix<double, 2, 12> coupling;
  /// The part of the mass matrix that comes from strains (L^2/12 ...), as a square.
  Eigen::Matrix<double, Eigen::Dynamic, 12, Eigen::ColMajor, 16, 12> strain_mass;
};

/// e = T u, for b at `span` from a.
[[nodiscard]] Shapes deformation_matrix(const Vec3& span);

/// All in one set of axes, those of the rows of `frame`: a is the origin, b lies on x.
class FlexibleBeam {
public:
  /// @param along  of the ends on the way of the property's taper
  FlexibleBeam(const BeamAxis& axis, const Eigen::Matrix3d& frame, const BeamProperty& property,
               const std::array<double, 2>& along = {0.0, 1.0});

  [[nodiscard]] const Matrix6& stiffness() const { return stiffness_; } ///< S
  [[nodiscard]] Matrix12 mass() const;
  [[nodiscard]] InnerMotion inner_motion() const;
  [[nodiscard]] Matrix6 slope_spread() const; ///< G, 1/m, 1, m; straight axes
  /// @param s  m along the axis from a
  [[nodiscard]] Shapes shapes(double s) const;

private:
  /// What masses are made of at one section.
  struct MovingSection {
    Eigen::Matrix3d axes; ///< as of section_axes
    BeamConstants constants;
    Shapes shape,
        strain; ///< displacement and rotation in the element's axes, strains in the section's, of the 12 dofs
    Vec3 lineic, inertia; ///< kg/m, kg m: along and about the section's axes
  };
  /// @param deformation  S e, of the 12 dofs
  [[nodiscard]] MovingSection section(double s, const Shapes& deformation) const;
  [[nodiscard]] Vec3 point(double s) const;
  [[nodiscard]] BeamConstants constants(double s) const;
  [[nodiscard]] Eigen::Matrix3d section_axes(double s) const; ///< rows: tangent, y, z of the section
  [[nodiscard]] Matrix6 strains(double s) const; ///< of the section, in its axes, by unit wrenches at b
  [[nodiscard]] Matrix6 motion(double s) const;  ///< D(s)

  BeamAxis axis_;
  Eigen::Matrix3d frame_;
  const BeamProperty& property_;
  std::array<double, 2> along_;
  Vec3 span_;
  Matrix6 stiffness_;
};

} // namespace fretwork::fem
