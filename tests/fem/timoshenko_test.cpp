// SPDX-License-Identifier: GPL-3.0-or-later
// Shear, rotary inertia and axial force of the element.
#include "core/symmetric.hpp"
#include "expect_error.hpp"
#include "fem/beam_element.hpp"
#include "model_builder.hpp"

namespace timoshenko_test {

using namespace fretwork;
using namespace fretwork::tests;
using fem::BeamElement;
using fem::Matrix12;
using fem::Vector12;
using std::numbers::pi;

namespace {

constexpr double round_off = 1e-12; // of integrals and an inverse of order 6
constexpr double length = 0.8;
const Vec3 origin = Vec3::Zero(), end(length, 0.0, 0.0);

fem::BeamProperty bar() {
  fem::BeamProperty p{{2.1e11, 0.3, 7800.0}, fem::rectangle_section(0.06, 0.04)};
  p.orientation = Vec3::UnitY();
  return p;
}

fem::BeamProperty shearing_bar() {
  auto p = bar();
  p.section.shear = fem::ShearCoefficients{0.8, 0.7};
  return p;
}

/// Motion of b under a unit force or moment there, a held.
Eigen::Matrix<double, 6, 1> tip(const BeamElement& e, int dof) {
  return core::Cholesky(e.stiffness().bottomRightCorner<6, 6>()).solve(Eigen::VectorXd::Unit(6, dof));
}

fem::Section shearing(fem::Section section) {
  section.shear = fem::ShapeShear{};
  return section;
}

} // namespace

TEST(ShearCoefficients, AreThoseOfCowper) {
  constexpr double printed = 6e-4; // three digits, for nu = 0.3
  EXPECT_NEAR(fem::shear_coefficients(shearing(fem::circle_section(0.1)), 0.3)->y, 0.886, printed);
  EXPECT_NEAR(fem::shear_coefficients(shearing(fem::pipe_section(1.0, 1e-5)), 0.3)->z, 0.531,
              printed); // thin
  EXPECT_NEAR(fem::shear_coefficients(shearing(fem::rectangle_section(0.1, 0.3)), 0.3)->y, 0.850, printed);
  // a solid pipe is a circle
  EXPECT_NEAR(fem::shear_coefficients(shearing(fem::pipe_section(0.2, 0.1)), 0.2)->y,
              fem::shear_coefficients(shearing(fem::circle_section(0.2)), 0.2)->y, round_off);
  EXPECT_FALSE(fem::shear_coefficients(fem::circle_section(0.1), 0.3));
}

TEST(Shear, AddsToTheDeflectionWhatTheClosedFormSays) {
  const auto p = shearing_bar();
  const BeamElement e(origin, end, p);
  const double young = p.material.young_modulus, ga = young / 2.6 * p.section.area;
  const double bent = length * length * length / (3 * young);
  EXPECT_NEAR(tip(e, 1)[1] / (bent / p.section.iz + length / (0.8 * ga)), 1.0, round_off);
  EXPECT_NEAR(tip(e, 2)[2] / (bent / p.section.iy + length / (0.7 * ga)), 1.0, round_off);
}

TEST(Shear, DoesNotLockASlenderBeam) {
  const Vec3 far(1e4 * 0.06, 0.0, 0.0);
  constexpr double share = 1e-7; // of shear: some times 1/slenderness^2
  EXPECT_NEAR(tip(BeamElement(origin, far, shearing_bar()), 1)[1] /
                  tip(BeamElement(origin, far, bar()), 1)[1],
              1.0, share);
}

// A quarter of a ring held at one end, pulled by P at the other along its tangent. At the angle t from there: moment
// P R (1 - cos t), normal force P cos t, shear force P sin t; Castigliano.
TEST(Shear, IsCarriedByArcs) {
  auto p = tube_property();
  p.section.shear = fem::ShearCoefficients{0.5, 0.5};
  constexpr double radius = 0.1; // five diameters, so that shear counts
  const BeamElement e({radius, 0, 0}, {0, radius, 0}, p,
                      Vec3(radius / std::sqrt(2.0), radius / std::sqrt(2.0), 0));
  const double ei = p.material.young_modulus * p.section.iz, ea = p.material.young_modulus * p.section.area,
               kga = 0.5 * p.material.young_modulus / 2.6 * p.section.area;
  const double r3 = radius * radius * radius;
  const double exact = r3 / ei * (0.75 * pi - 2.0) + radius / ea * pi / 4.0 + radius / kga * pi / 4.0;
  EXPECT_NEAR(tip(e, 0)[0] / exact, 1.0, round_off);
}

TEST(RotaryInertia, IsThatOfASectionTurning) {
  auto p = bar();
  p.section.rotary_inertia = true;
  const Matrix12 with = BeamElement(origin, end, p).mass(), without = BeamElement(origin, end, bar()).mass();
  constexpr double left = 1e-9; // of a difference, a thousandth of the whole
  const auto turning = [&](const Vector12& u) { return u.dot(with * u) - u.dot(without * u); };
  Vector12 about_z, about_y; // through a
  about_z << 0, 0, 0, 0, 0, 1, 0, length, 0, 0, 0, 1;
  about_y << 0, 0, 0, 0, 1, 0, 0, 0, -length, 0, 1, 0;
  EXPECT_NEAR(turning(about_z) / (7800.0 * p.section.iz * length), 1.0, left);
  EXPECT_NEAR(turning(about_y) / (7800.0 * p.section.iy * length), 1.0, left);
}

// Hermite shapes: N/(30 L) [36, 3 L, 4 L^2, -L^2] (Przemieniecki, section 15.2).
TEST(AxialForce, HasTheGeometricStiffnessOfTheTextbook) {
  auto p = bar();
  p.axial_force = 5e3;
  const Matrix12 k = BeamElement(origin, end, p).stiffness() - BeamElement(origin, end, bar()).stiffness();
  const double unit = p.axial_force / (30.0 * length), l = length;
  constexpr double left = 1e-8; // of a difference
  EXPECT_NEAR(k(1, 1) / (36 * unit), 1.0, left);
  EXPECT_NEAR(k(7, 1) / (-36 * unit), 1.0, left);
  EXPECT_NEAR(k(1, 5) / (3 * l * unit), 1.0, left);
  EXPECT_NEAR(k(5, 5) / (4 * l * l * unit), 1.0, left);
  EXPECT_NEAR(k(5, 11) / (-l * l * unit), 1.0, left);
  EXPECT_NEAR(k(2, 4) / (-3 * l * unit), 1.0, left);
  EXPECT_NEAR(k(4, 10) / (-l * l * unit), 1.0, left);
  EXPECT_NEAR(k(0, 0) / unit, 0.0, left); // the axis is not stiffer
}

TEST(AxialForce, IsInTheEnergyAndTheForce) {
  auto p = shearing_bar();
  for (const double force : {-2e5, 3e6}) {
    p.axial_force = force;
    const BeamElement e({0.3, -0.2, 0.7}, {1.1, 0.5, 0.2}, p);
    const Matrix12 k = e.stiffness();
    const Vector12 u = Vector12::LinSpaced(0.1, 1.3) * 1e-3;
    EXPECT_NEAR(e.twice_strain_energy(u) / u.dot(k * u), 1.0, round_off);
    EXPECT_LT((e.elastic_force(u) - k * u).norm(), round_off * (k * u).norm());
  }
}

TEST(AxialForce, IsRefusedInAnArc) {
  auto p = tube_property();
  p.axial_force = 10.0;
  expect_error([&] { (void)BeamElement(origin, end, p, Vec3(0.4, 0.1, 0.0)); },
               {"beam from (0, 0, 0)", "axial_force = 10 N in an arc", "straight beams only"});
}

} // namespace timoshenko_test
