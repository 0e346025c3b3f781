// SPDX-License-Identifier: GPL-3.0-or-later
#include "fem/beam_element.hpp"
#include "core/error.hpp"
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>

namespace fretwork::fem {
namespace {

/// Sine of the smallest angle between a beam and its orientation vector: below it the y axis would be made of
/// round-off.
constexpr double least_orientation_sine = 1e-6;
/// Relative difference of iy and iz up to which a section has no principal directions (round-off of the
/// section formulas).
constexpr double equal_inertia = 1e-9;

std::string beam_text(const Vec3& a, const Vec3& b) { return "beam from " + place(a) + " to " + place(b); }

/// Global direction least aligned with x: y then never degenerates.
Vec3 any_orientation(const Vec3& x) {
  Eigen::Index least = 0;
  x.cwiseAbs().minCoeff(&least);
  return Vec3::Unit(least);
}

/// Bending in one plane, dofs v_a, s_a, v_b, s_b at `dof`, s = sign * rotation.
void add_bending(ElementMatrices& e, const std::array<int, 4>& dof, double sign, double ei, double mu,
                 double l) {
  Eigen::Matrix4d k, m;
  k << 12, 6 * l, -12, 6 * l, 6 * l, 4 * l * l, -6 * l, 2 * l * l, -12, -6 * l, 12, -6 * l, 6 * l, 2 * l * l,
      -6 * l, 4 * l * l;
  k *= ei / (l * l * l);
  m << 156, 22 * l, 54, -13 * l, 22 * l, 4 * l * l, 13 * l, -3 * l * l, 54, 13 * l, 156, -22 * l, -13 * l,
      -3 * l * l, -22 * l, 4 * l * l;
  m *= mu * l / 420.0;
  const std::array<double, 4> s{1.0, sign, 1.0, sign};
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j) {
      const auto row = static_cast<Eigen::Index>(i), column = static_cast<Eigen::Index>(j);
      e.stiffness(dof[i], dof[j]) = s[i] * s[j] * k(row, column);
      e.mass(dof[i], dof[j]) = s[i] * s[j] * m(row, column);
    }
}

/// Linear shapes: traction or torsion.
void add_linear(ElementMatrices& e, int a, int b, double k, double m) {
  e.stiffness(a, a) = e.stiffness(b, b) = k;
  e.stiffness(a, b) = e.stiffness(b, a) = -k;
  e.mass(a, a) = e.mass(b, b) = m / 3.0;
  e.mass(a, b) = e.mass(b, a) = m / 6.0;
}

void rotate_to_global(Matrix12& matrix, const Eigen::Matrix3d& axes) {
  for (int i = 0; i < 12; i += 3)
    for (int j = 0; j < 12; j += 3)
      matrix.block<3, 3>(i, j) = (axes.transpose() * matrix.block<3, 3>(i, j) * axes).eval();
  matrix = (0.5 * (matrix + matrix.transpose())).eval(); // symmetric to the last digit
}

/// Strains of the element: elongation, twist, and end rotations less the chord's (about y and about z).
struct Strain {
  double elongation, twist, ya, yb, za, zb;
};

Strain strain_of(const BeamConstants& beam, const Vector12& u) {
  const Vec3 d = beam.axes * (u.segment<3>(6) - u.segment<3>(0));
  const Vec3 ra = beam.axes * u.segment<3>(3);
  const Vec3 rb = beam.axes * u.segment<3>(9);
  const double chord_y = -d.z() / beam.length;
  const double chord_z = d.y() / beam.length;
  return {d.x(), rb.x() - ra.x(), ra.y() - chord_y, rb.y() - chord_y, ra.z() - chord_z, rb.z() - chord_z};
}

} // namespace

Eigen::Matrix3d beam_axes(const Vec3& a, const Vec3& b, const std::optional<Vec3>& orientation) {
  const Vec3 span = b - a;
  const double length = span.norm();
  if (!(length > 0.0))
    throw core::Error(beam_text(a, b) + " has no length; merge its nodes or move one of them");
  const Vec3 x = span / length;
  const Vec3 guide = orientation ? *orientation : any_orientation(x);
  const Vec3 across = guide - x * x.dot(guide);
  if (!(across.norm() > least_orientation_sine * guide.norm()))
    throw core::Error(
        fmt::format("{}: orientation {} is along the beam (or zero); give a vector in the plane of the beam "
                    "and the y axis of its section",
                    beam_text(a, b), place(guide)));
  const Vec3 y = across.normalized();
  Eigen::Matrix3d axes;
  axes.row(0) = x.transpose();
  axes.row(1) = y.transpose();
  axes.row(2) = x.cross(y).transpose();
  return axes;
}

BeamConstants beam_constants(const Vec3& a, const Vec3& b, const BeamProperty& property) {
  const auto& [young, poisson, density] = property.material;
  const Section& s = property.section;
  if (!property.orientation && std::abs(s.iy - s.iz) > equal_inertia * std::max(s.iy, s.iz))
    throw core::Error(fmt::format(
        "{}: its section has iy = {:g} and iz = {:g} m4, so that it matters how it is turned; give "
        "orientation, a vector in the plane of the beam and the y axis of the section",
        beam_text(a, b), s.iy, s.iz));
  const double lineic = density * s.area;
  const double axial_added = property.added_mass_direction == AddedMass::all ? property.added_mass : 0.0;
  return {beam_axes(a, b, property.orientation),
          (b - a).norm(),
          young * s.area,
          young / (2.0 * (1.0 + poisson)) * s.torsion_constant,
          young * s.iy,
          young * s.iz,
          lineic + axial_added,
          lineic + property.added_mass,
          density * s.polar_inertia};
}

ElementMatrices beam_element(const BeamConstants& beam) {
  const double l = beam.length;
  ElementMatrices e{Matrix12::Zero(), Matrix12::Zero()};
  add_linear(e, 0, 6, beam.axial / l, beam.mass_axial * l);
  add_linear(e, 3, 9, beam.torsion / l, beam.polar_inertia * l);
  add_bending(e, {1, 5, 7, 11}, 1.0, beam.bending_z, beam.mass_transverse, l);
  add_bending(e, {2, 4, 8, 10}, -1.0, beam.bending_y, beam.mass_transverse, l);
  rotate_to_global(e.stiffness, beam.axes);
  rotate_to_global(e.mass, beam.axes);
  return e;
}

ElementMatrices beam_element(const Vec3& a, const Vec3& b, const BeamProperty& property) {
  return beam_element(beam_constants(a, b, property));
}

double twice_strain_energy(const BeamConstants& beam, const Vector12& displacement) {
  const Strain s = strain_of(beam, displacement);
  return (beam.axial * s.elongation * s.elongation + beam.torsion * s.twist * s.twist +
          4.0 * beam.bending_y * (s.ya * s.ya + s.ya * s.yb + s.yb * s.yb) +
          4.0 * beam.bending_z * (s.za * s.za + s.za * s.zb + s.zb * s.zb)) /
         beam.length;
}

Vector12 elastic_force(const BeamConstants& beam, const Vector12& displacement) {
  const Strain s = strain_of(beam, displacement);
  const double l = beam.length;
  const double normal = beam.axial / l * s.elongation;
  const double torque = beam.torsion / l * s.twist;
  const double may = beam.bending_y / l * (4.0 * s.ya + 2.0 * s.yb);
  const double mby = beam.bending_y / l * (2.0 * s.ya + 4.0 * s.yb);
  const double maz = beam.bending_z / l * (4.0 * s.za + 2.0 * s.zb);
  const double mbz = beam.bending_z / l * (2.0 * s.za + 4.0 * s.zb);
  const Vec3 force_b = beam.axes.transpose() * Vec3(normal, -(maz + mbz) / l, (may + mby) / l);
  Vector12 force;
  force << -force_b, beam.axes.transpose() * Vec3(-torque, may, maz), force_b,
      beam.axes.transpose() * Vec3(torque, mby, mbz);
  return force;
}

} // namespace fretwork::fem
