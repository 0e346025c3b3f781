// SPDX-License-Identifier: GPL-3.0-or-later
#include "fem/beam_element.hpp"
#include "core/error.hpp"
#include "fem/gauss.hpp"
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>

namespace fretwork::fem {
namespace {

/// Relative difference of iy and iz up to which a section has no principal directions (round-off of the
/// section formulas).
constexpr double equal_inertia = 1e-9;

void check_orientation(const Vec3& a, const Vec3& b, const Section& s) {
  if (std::abs(s.iy - s.iz) > equal_inertia * std::max(s.iy, s.iz))
    throw core::Error(fmt::format(
        "{}: its section has iy = {:g} and iz = {:g} m4, so that it matters how it is turned; give "
        "orientation, a vector in the plane of the beam and the y axis of the section",
        beam_text(a, b), s.iy, s.iz));
}

/// Whether the closed forms hold: straight, uniform, by Euler and Bernoulli.
bool is_plain(const BeamAxis& axis, const BeamProperty& property) {
  return axis.is_straight() && !property.taper && !property.section.rotary_inertia &&
         std::holds_alternative<std::monostate>(property.section.shear);
}

/// The closed form of S, straight and uniform.
Matrix6 uniform_stiffness(const BeamConstants& c, double l) {
  Matrix6 s = Matrix6::Zero();
  s(0, 0) = c.axial / l;
  s(3, 3) = c.torsion / l;
  const auto bend = [&](int across, int turn, double sign, double ei) {
    s(across, across) = 12.0 * ei / (l * l * l);
    s(across, turn) = s(turn, across) = -sign * 6.0 * ei / (l * l);
    s(turn, turn) = 4.0 * ei / l;
  };
  bend(1, 5, 1.0, c.bending_z);
  bend(2, 4, -1.0, c.bending_y); // ry = -duz/dx
  return s;
}

/// Consistent mass of bending in one plane, dofs v_a, s_a, v_b, s_b at `dof`, s = sign * rotation.
void add_bending(Matrix12& mass, const std::array<int, 4>& dof, double sign, double mu, double l) {
  Eigen::Matrix4d m;
  m << 156, 22 * l, 54, -13 * l, 22 * l, 4 * l * l, 13 * l, -3 * l * l, 54, 13 * l, 156, -22 * l, -13 * l,
      -3 * l * l, -22 * l, 4 * l * l;
  m *= mu * l / 420.0;
  const std::array<double, 4> s{1.0, sign, 1.0, sign};
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j)
      mass(dof[i], dof[j]) = s[i] * s[j] * m(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
}

/// Of traction or torsion.
void add_along(Matrix12& mass, int a, int b, double m) {
  mass(a, a) = mass(b, b) = m * 5.0 / 12.0;
  mass(a, b) = mass(b, a) = m / 12.0;
}

Matrix12 uniform_mass(const BeamConstants& c, double l) {
  Matrix12 mass = Matrix12::Zero();
  add_along(mass, 0, 6, c.mass_axial * l);
  add_along(mass, 3, 9, c.inertia_x * l);
  add_bending(mass, {1, 5, 7, 11}, 1.0, c.mass_transverse, l);
  add_bending(mass, {2, 4, 8, 10}, -1.0, c.mass_transverse, l);
  return mass;
}

/// Of traction (component 0, along x) or torsion (1), dofs a and b.
void add_inner(InnerMotion& inner, Eigen::Index component, Eigen::Index a, const Vec3& x, double stiffness,
               double m, double l) {
  inner.stiffness(component, component) = 16.0 * stiffness / (3.0 * l);
  inner.mass(component, component) = 8.0 / 15.0 * m * l;
  inner.coupling.block<1, 3>(component, a) = m * l / 3.0 * x.transpose();
  inner.coupling.block<1, 3>(component, a + 6) = m * l / 3.0 * x.transpose();
  inner.strain_mass.block<1, 3>(component, a) = -std::sqrt(m * l / 12.0) * x.transpose();
  inner.strain_mass.block<1, 3>(component, a + 6) = std::sqrt(m * l / 12.0) * x.transpose();
}

/// Global axes. Neither shear nor rotary inertia nor an axial force has a part in it.
InnerMotion uniform_inner_motion(const BeamConstants& c, const Vec3& x, double l) {
  InnerMotion inner{Eigen::Matrix2d::Zero(), Eigen::Matrix2d::Zero(), Eigen::Matrix<double, 2, 12>::Zero(),
                    Eigen::Matrix<double, 2, 12>::Zero()};
  add_inner(inner, 0, 0, x, c.axial, c.mass_axial, l);
  add_inner(inner, 1, 3, x, c.torsion, c.inertia_x, l);
  return inner;
}

/// Rows over the twelve dofs.
template <class Rows> void turn_to_global_axes(Rows& rows, const Eigen::Matrix3d& axes) {
  for (Eigen::Index j = 0; j < 12; j += 3)
    rows.template middleCols<3>(j) = (rows.template middleCols<3>(j) * axes).eval();
}

/// Of a symmetric matrix; symmetric to the last digit.
Matrix12 in_global_axes(const Matrix12& matrix, const Eigen::Matrix3d& axes) {
  Matrix12 turned;
  for (int i = 0; i < 12; i += 3)
    for (int j = i; j < 12; j += 3) {
      const Eigen::Matrix3d half = matrix.block<3, 3>(i, j) * axes, block = axes.transpose() * half;
      turned.block<3, 3>(i, j) = i == j ? Eigen::Matrix3d(0.5 * (block + block.transpose())) : block;
      if (i != j)
        turned.block<3, 3>(j, i) = block.transpose();
    }
  return turned;
}

} // namespace

BeamElement::BeamElement(const Vec3& a, const Vec3& b, const BeamProperty& property,
                         const std::optional<Vec3>& middle, const std::array<double, 2>& along)
    : property_(property), along_(along), axis_(a, b, middle),
      axes_(frame_along((b - a).normalized(), property.orientation, a, b)), chord_((b - a).norm()) {
  if (!property.orientation)
    check_orientation(a, b, property.section);
  if (!property.orientation && property.taper)
    check_orientation(a, b, property.taper->section);
  elastic_ = is_plain(axis_, property) ? uniform_stiffness(beam_constants(property), chord_)
                                       : flexible().stiffness();
  stiffness_ = elastic_;
  const double force = axial_force(property, along);
  if (force == 0.0)
    return;
  if (!axis_.is_straight())
    throw core::Error(fmt::format("{}: axial_force = {:g} N in an arc, where a force along the axis is in no "
                                  "equilibrium; give it to straight beams only",
                                  beam_text(a, b), force));
  stiffness_ += force * flexible().slope_spread();
  string_ = force / chord_;
}

BeamElement::BeamElement(const Model& model, const Beam& beam)
    : BeamElement(model.node(beam.a), model.node(beam.b),
                  model.properties[static_cast<std::size_t>(beam.property)], beam.middle, beam.along) {}

Matrix12 BeamElement::stiffness() const {
  const Shapes t = deformation_matrix({chord_, 0.0, 0.0});
  Matrix12 k = t.transpose() * stiffness_ * t;
  for (const int d : {1, 2}) {
    k(d, d) += string_;
    k(d + 6, d + 6) += string_;
    k(d, d + 6) -= string_;
    k(d + 6, d) -= string_;
  }
  return in_global_axes(k, axes_);
}

Matrix12 BeamElement::mass() const {
  return in_global_axes(is_plain(axis_, property_) ? uniform_mass(beam_constants(property_), chord_)
                                                   : flexible().mass(),
                        axes_);
}

InnerMotion BeamElement::inner_motion() const {
  if (axis_.is_straight() && !property_.taper)
    return uniform_inner_motion(beam_constants(property_), axes_.row(0), chord_);
  InnerMotion inner = flexible().inner_motion();
  turn_to_global_axes(inner.coupling, axes_);
  turn_to_global_axes(inner.strain_mass, axes_);
  return inner;
}

Vector6 BeamElement::deformation(const Vector12& u) const {
  const Vec3 d = axes_ * (u.segment<3>(6) - u.segment<3>(0));
  const Vec3 ra = axes_ * u.segment<3>(3);
  Vector6 e;
  e << d.x(), d.y() - chord_ * ra.z(), d.z() + chord_ * ra.y(), axes_ * (u.segment<3>(9) - u.segment<3>(3));
  return e;
}

Vec3 BeamElement::across(const Vector12& u) const {
  const Vec3 d = u.segment<3>(6) - u.segment<3>(0), x = axes_.row(0);
  return d - x * x.dot(d);
}

double BeamElement::twice_strain_energy(const Vector12& displacement) const {
  const Vector6 e = deformation(displacement);
  return e.dot(stiffness_ * e) + string_ * across(displacement).squaredNorm();
}

Vector12 BeamElement::elastic_force(const Vector12& displacement) const {
  const Vector6 at_b = stiffness_ * deformation(displacement);
  const Vec3 force = axes_.transpose() * at_b.head<3>(), moment = axes_.transpose() * at_b.tail<3>();
  const Vec3 span = chord_ * axes_.row(0).transpose();
  const Vec3 pull = string_ * across(displacement);
  Vector12 result;
  result << -force - pull, -moment - span.cross(force), force + pull, moment;
  return result;
}

Shapes BeamElement::shapes(double share) const {
  Shapes shapes = flexible().shapes(share * axis_.length());
  for (int i = 0; i < 6; i += 3)
    for (int j = 0; j < 12; j += 3)
      shapes.block<3, 3>(i, j) = (axes_.transpose() * shapes.block<3, 3>(i, j) * axes_).eval();
  return shapes;
}

Eigen::Matrix3d BeamElement::section_axes(double share) const {
  const double length = axis_.length();
  return frame_along(axis_.tangent(share * length), property_.orientation, axis_.point(0.0),
                     axis_.point(length));
}

Vector6 BeamElement::section_forces(const Vector12& displacement, double share) const {
  const Vector6 at_b = elastic_ * deformation(displacement);
  const Vec3 force = axes_.transpose() * at_b.head<3>(), moment = axes_.transpose() * at_b.tail<3>();
  const double length = axis_.length();
  const Vec3 arm = axis_.point(length) - axis_.point(share * length);
  const Eigen::Matrix3d axes = section_axes(share);
  Vector6 forces;
  forces << axes * force, axes * (moment + arm.cross(force));
  return forces;
}

Vector6 BeamElement::end_forces(const Vector12& held, bool at_b) const {
  const Eigen::Matrix3d axes = section_axes(at_b ? 1.0 : 0.0);
  const Eigen::Index first = at_b ? 6 : 0;
  Vector6 forces;
  forces << axes * held.segment<3>(first), axes * held.segment<3>(first + 3);
  return at_b ? forces : Vector6(-forces); // the element is the part beyond a
}

Vector12 BeamElement::line_force(const Vec3& force_per_length) const {
  Vector12 result = Vector12::Zero();
  for (const auto& [share, weight] : gauss_points)
    result += weight * axis_.length() * shapes(share).topRows<3>().transpose() * force_per_length;
  return result;
}

} // namespace fretwork::fem
