// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/symmetric.hpp"
#include "expect_error.hpp"
#include "fem/beam_element.hpp"
#include "fem/beam_point.hpp"
#include "fem/fields.hpp"
#include "model_builder.hpp"
#include <Eigen/Geometry>
#include <numbers>

namespace arc_element_test {

using namespace fretwork;
using namespace fretwork::tests;
using fem::BeamElement;
using fem::Matrix12;
using fem::Matrix6;
using fem::Vector12;
using std::numbers::pi;

namespace {

constexpr double round_off = 1e-12; // of integrals and an inverse of order 6
using fem::Vector6;

/// An oblique circle.
const Vec3 u = Vec3(1.0, 2.0, -0.5).normalized(), v = u.cross(Vec3(0.2, 0.3, 1.0)).normalized();
constexpr double radius = 0.8;
Vec3 on_circle(double t) { return Vec3(0.2, 0.1, -0.3) + radius * (std::cos(t) * u + std::sin(t) * v); }

/// A flat bar whose y axis is that of the circle.
fem::BeamProperty flat_bar() {
  fem::BeamProperty p{{2.1e11, 0.3, 7800.0}, fem::rectangle_section(0.03, 0.01)};
  p.added_mass = 0.4;
  p.orientation = u.cross(v);
  return p;
}

BeamElement arc(double from, double to, const fem::BeamProperty& p) {
  return {on_circle(from), on_circle(to), p, on_circle(0.5 * (from + to))};
}

Vector12 rigid(const BeamElement& e, const Vec3& translation, const Vec3& rotation) {
  const Vec3 a = e.axis().point(0.0), b = e.axis().point(e.axis().length());
  Vector12 field;
  field << translation + rotation.cross(a), rotation, translation + rotation.cross(b), rotation;
  return field;
}

double difference(const Matrix12& x, const Matrix12& y) {
  return (x - y).cwiseAbs().maxCoeff() / y.cwiseAbs().maxCoeff();
}

Matrix12 ends_swapped(const Matrix12& x) {
  Matrix12 out;
  out << x.bottomRightCorner<6, 6>(), x.bottomLeftCorner<6, 6>(), x.topRightCorner<6, 6>(),
      x.topLeftCorner<6, 6>();
  return out;
}

/// What a load does at b while a is held.
Vector6 tip(const BeamElement& e, const Vector6& load) {
  return core::Cholesky(e.stiffness().bottomRightCorner<6, 6>()).solve(load);
}

/// Two elements in a row, their common node left free: K of the ends.
Matrix12 condensed(const BeamElement& first, const BeamElement& second) {
  const Matrix12 k = first.stiffness(), l = second.stiffness();
  const Matrix6 middle = k.bottomRightCorner<6, 6>() + l.topLeftCorner<6, 6>();
  Eigen::Matrix<double, 6, 12> to_ends;
  to_ends << k.bottomLeftCorner<6, 6>(), l.topRightCorner<6, 6>();
  Matrix12 ends = Matrix12::Zero();
  ends.topLeftCorner<6, 6>() = k.topLeftCorner<6, 6>();
  ends.bottomRightCorner<6, 6>() = l.bottomRightCorner<6, 6>();
  const core::Cholesky factor(middle);
  for (Eigen::Index end = 0; end < to_ends.cols(); ++end)
    ends.col(end) -= to_ends.transpose().lazyProduct(factor.solve(to_ends.col(end)));
  return ends;
}

} // namespace

// Timoshenko, Strength of Materials II, chapter 2: a quarter of a ring held at one end, by Castigliano.
TEST(ArcElement, DeflectsAsAQuarterRing) {
  const auto p = tube_property();
  const double e = p.material.young_modulus, ei = e * p.section.iy, ea = e * p.section.area,
               gj = e / 2.6 * p.section.torsion_constant, r = radius;
  const Vec3 a(r, 0, 0), b(0, r, 0), m = r / std::sqrt(2.0) * Vec3(1, 1, 0);
  const BeamElement quarter(a, b, p, m); // its tangent at b is -x
  const auto load = [](int dof) { return Vector6(Vector6::Unit(dof)); };
  const double r3 = r * r * r;
  EXPECT_NEAR(tip(quarter, load(1))[1] / (pi * r3 / (4 * ei) + pi * r / (4 * ea)), 1.0, round_off);
  EXPECT_NEAR(tip(quarter, load(0))[0] / ((3 * pi / 4 - 2) * r3 / ei + pi * r / (4 * ea)), 1.0, round_off);
  EXPECT_NEAR(tip(quarter, load(2))[2] / (r3 * (pi / (4 * ei) + (3 * pi / 4 - 2) / gj)), 1.0, round_off);
  EXPECT_NEAR(tip(quarter, load(5))[5] / (pi * r / (2 * ei)), 1.0, round_off);
  EXPECT_NEAR(tip(quarter, load(3))[3] / (pi * r / 4 * (1 / ei + 1 / gj)), 1.0, round_off);
}

TEST(ArcElement, IsStaticallyExact) { // one element is as good as two, wherever it is parted
  for (const double angle : {0.2, 1.0, 2.0})
    for (const double share : {0.5, 0.3})
      for (const auto& p : {tube_property(), flat_bar()}) {
        const double middle = 0.3 + share * angle, end = 0.3 + angle;
        const Matrix12 one = arc(0.3, end, p).stiffness();
        EXPECT_LT(difference(condensed(arc(0.3, middle, p), arc(middle, end, p)), one), 100 * round_off)
            << angle << " " << share; // parts are the stiffer, and lose digits when they are joined
      }
}

TEST(ArcElement, TwistsASectionThatFollowsAnObliqueOrientation) {
  auto p = flat_bar();
  p.orientation = Vec3(0.3, -0.4, 1.0);
  constexpr double quadrature = 1e-8; // the twist along the axis is no polynomial
  const Matrix12 one = arc(0.3, 1.3, p).stiffness();
  EXPECT_LT(difference(condensed(arc(0.3, 0.8, p), arc(0.8, 1.3, p)), one), quadrature);
  EXPECT_GT(difference(arc(0.3, 1.3, flat_bar()).stiffness(), one), 1e-2);
}

TEST(ArcElement, HasSixRigidMotionsAndTheirMass) {
  const auto p = tube_property();
  const BeamElement e = arc(0.3, 1.5, p);
  const Matrix12 k = e.stiffness(), m = e.mass();
  for (int i = 0; i < 3; ++i) {
    EXPECT_LT((k * rigid(e, Vec3::Unit(i), Vec3::Zero())).norm(), round_off * k.norm());
    EXPECT_LT((k * rigid(e, Vec3::Zero(), Vec3::Unit(i))).norm(), round_off * k.norm());
    EXPECT_NEAR(e.twice_strain_energy(rigid(e, Vec3::Ones(), Vec3::Unit(i))), 0.0, 1e-18 * k.norm());
  }
  const double lineic = p.material.density * p.section.area;
  const Vector12 slide = rigid(e, Vec3::UnitX(), Vec3::Zero());
  EXPECT_NEAR(slide.dot(m * slide) / (lineic * radius * 1.2), 1.0, round_off);
  // about the axis of the circle every point moves along the tangent
  const Vec3 axis = u.cross(v), middle(0.2, 0.1, -0.3);
  const Vector12 spin = rigid(e, -axis.cross(middle), axis);
  EXPECT_NEAR(spin.dot(m * spin) / (lineic * radius * 1.2 * radius * radius), 1.0, round_off);
  EXPECT_TRUE(core::Cholesky(m).is_positive_definite());
}

TEST(ArcElement, DoesNotKnowItsDirection) {
  const auto p = flat_bar();
  const BeamElement e = arc(0.3, 1.5, p), f = arc(1.5, 0.3, p);
  EXPECT_LT(difference(ends_swapped(f.stiffness()), e.stiffness()), round_off);
  EXPECT_LT(difference(ends_swapped(f.mass()), e.mass()), round_off);
}

TEST(ArcElement, GivesTheEnergyAndTheForceOfItsStiffness) {
  const BeamElement e = arc(0.3, 1.5, flat_bar());
  const Matrix12 k = e.stiffness();
  const Vector12 field = Vector12::LinSpaced(0.1, 1.3) * 1e-3;
  EXPECT_NEAR(e.twice_strain_energy(field) / field.dot(k * field), 1.0, round_off);
  EXPECT_LT((e.elastic_force(field) - k * field).norm(), round_off * (k * field).norm());
}

TEST(ArcElement, TendsToTheStraightOne) {
  fem::BeamProperty p{{2.1e11, 0.3, 7800.0}, fem::rectangle_section(0.4, 0.3)};
  p.orientation = Vec3(0.1, 1.0, -0.3);
  // traction bends an arc: by its angle, times the square of its slenderness, over 80 at most
  constexpr double slope = 3.0;
  const Vec3 a(0.3, -0.2, 0.7), b(1.1, 0.5, 0.2);
  const Vec3 aside = (b - a).cross(Vec3::UnitX()).normalized();
  const BeamElement straight(a, b, p);
  for (double angle = 1e-1; angle > 0.5e-8; angle *= 0.1) {
    const Vec3 middle = 0.5 * (a + b) + 0.5 * (b - a).norm() * std::tan(angle / 4) * aside;
    const BeamElement arc(a, b, p, middle);
    EXPECT_LT(difference(arc.stiffness(), straight.stiffness()), slope * angle + round_off) << angle;
    EXPECT_LT(difference(arc.mass(), straight.mass()), slope * angle + round_off) << angle;
    EXPECT_GT(difference(arc.stiffness(), straight.stiffness()), angle > 2e-8 ? 1e-3 * angle : -1.0);
  }
}

// The integrals of the general beam give the closed forms of the straight one.
TEST(FlexibleBeam, IsTheUniformBeamOnAStraightAxis) {
  auto p = flat_bar();
  p.orientation = Vec3::UnitY();
  const Vec3 a = Vec3::Zero(), b(0.9, 0.0, 0.0);
  const fem::FlexibleBeam beam(fem::BeamAxis(a, b, std::nullopt), Eigen::Matrix3d::Identity(), p);
  const BeamElement element(a, b, p);
  const fem::Shapes t = fem::deformation_matrix(b);
  EXPECT_LT(difference(t.transpose() * beam.stiffness() * t, element.stiffness()), round_off);
  EXPECT_LT(difference(beam.mass(), element.mass()), round_off);
}

TEST(ArcElement, CarriesALineForceToItsEnds) {
  const BeamElement e = arc(0.3, 1.5, flat_bar());
  const Vec3 force(10.0, -20.0, 5.0), spin(0.3, -0.4, 0.5);
  const Vector12 ends = e.line_force(force);
  const double length = e.axis().length();
  EXPECT_LT((ends.segment<3>(0) + ends.segment<3>(6) - length * force).norm(),
            round_off * length * force.norm());
  Vec3 moment = Vec3::Zero(); // of the line force about the origin, by the trapezoidal rule
  constexpr int steps = 4000;
  for (int i = 0; i <= steps; ++i)
    moment +=
        (i == 0 || i == steps ? 0.5 : 1.0) * length / steps * e.axis().point(length * i / steps).cross(force);
  EXPECT_NEAR(ends.dot(rigid(e, Vec3::Zero(), spin)) / moment.dot(spin), 1.0, 1e-7); // its second order
  // deflection at b under the line force: exact, as two elements find it
  const BeamElement first = arc(0.3, 1.0, flat_bar()), second = arc(1.0, 1.5, flat_bar());
  Eigen::Matrix<double, 12, 12> k = Matrix12::Zero();
  k.topLeftCorner<6, 6>() = first.stiffness().bottomRightCorner<6, 6>();
  k += second.stiffness();
  Vector12 load = second.line_force(force);
  load.head<6>() += first.line_force(force).tail<6>();
  const Vector6 expected = core::Cholesky(k).solve(load).tail<6>();
  EXPECT_LT((tip(e, ends.tail<6>()) - expected).norm(), 1e-10 * expected.norm()); // a solve of order 12
}

TEST(ArcElement, MovesItsPointsAsNodesThereWithoutLoad) {
  fem::Model model;
  model.nodes = {on_circle(0.3), on_circle(1.5)};
  model.properties = {flat_bar()};
  model.beams = {{0, 1, 0, on_circle(0.8)}};
  const Vector12 ends = (Vector12() << 1, 2, -1, 0.3, 0.2, -0.5, -2, 0.5, 1, 0.7, -0.1, 0.4).finished();
  for (const double s : {0.2, 0.5, 0.8}) {
    const double t = 0.3 + 1.2 * s;
    const Matrix12 left = arc(0.3, t, flat_bar()).stiffness(), right = arc(t, 1.5, flat_bar()).stiffness();
    const Matrix6 own = left.bottomRightCorner<6, 6>() + right.topLeftCorner<6, 6>();
    const Vector6 free = -core::Cholesky(own).solve(left.bottomLeftCorner<6, 6>() * ends.head<6>() +
                                                    right.topRightCorner<6, 6>() * ends.tail<6>());
    const fem::BeamPoint point = fem::point_on(model, model.beams[0], s);
    const Vec3 found = point.motion[0].weights * ends.head<6>() + point.motion[1].weights * ends.tail<6>();
    EXPECT_LT((found - free.head<3>()).norm(), 1e-10 * free.head<3>().norm()) << s; // a solve of order 6
    EXPECT_LT((point.place - on_circle(t)).norm(), round_off);
  }
  EXPECT_LT((fem::point_along(model, 0, -u, 0.5 * radius, "x").place - on_circle(0.8)).norm(), round_off)
      << "distances are along the arc";
}

TEST(ArcElement, CountsItsLengthInTheMassOfAModel) {
  fem::Model model;
  model.nodes = {on_circle(0.0), on_circle(pi)};
  model.properties = {tube_property()};
  model.beams = {{0, 1, 0, on_circle(1.0)}};
  const auto& p = model.properties[0];
  EXPECT_NEAR(fem::total_mass(model) / (p.material.density * p.section.area * pi * radius), 1.0, round_off);
  const Eigen::VectorXd slide = fem::translation_field(model, Vec3::UnitZ());
  EXPECT_NEAR(slide.dot(fem::mass_times(model, slide)) / fem::total_mass(model), 1.0, round_off);
}

} // namespace arc_element_test
