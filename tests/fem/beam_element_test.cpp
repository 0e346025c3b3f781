// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/symmetric.hpp"
#include "expect_error.hpp"
#include "fem/beam_element.hpp"
#include "model_builder.hpp"
#include <Eigen/Geometry>

namespace beam_element_test {

using namespace fretwork;
using namespace fretwork::tests;
using fem::Matrix12;
using fem::Vector12;

namespace {

constexpr double round_off = 1e-13; // of sums of a dozen terms, relative to the largest

fem::BeamProperty flat_bar() {
  fem::BeamProperty p{{2.1e11, 0.3, 7800.0}, fem::rectangle_section(0.03, 0.01)};
  p.added_mass = 0.4;
  p.orientation = Vec3(0.1, 1.0, -0.3);
  return p;
}

const Vec3 a(0.3, -0.2, 0.7), b(1.1, 0.5, 0.2);

Vector12 rigid(const Vec3& translation, const Vec3& rotation) {
  Vector12 u;
  u << translation + rotation.cross(a), rotation, translation + rotation.cross(b), rotation;
  return u;
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

Matrix12 turned(const Matrix12& x, const Eigen::Matrix3d& r) {
  Matrix12 out;
  for (int i = 0; i < 12; i += 3)
    for (int j = 0; j < 12; j += 3)
      out.block<3, 3>(i, j) = r * x.block<3, 3>(i, j) * r.transpose();
  return out;
}

/// Tip displacement of a cantilever of one element under a tip load (6 values).
Eigen::Matrix<double, 6, 1> tip(const fem::BeamProperty& p, const Vec3& end,
                                const Eigen::Matrix<double, 6, 1>& load) {
  const Matrix12 k = fem::BeamElement(Vec3::Zero(), end, p).stiffness();
  return core::Cholesky(k.bottomRightCorner<6, 6>()).solve(load);
}

} // namespace

TEST(BeamElement, IsSymmetric) {
  const fem::BeamElement e(a, b, flat_bar());
  EXPECT_TRUE(e.stiffness() == e.stiffness().transpose());
  EXPECT_TRUE(e.mass() == e.mass().transpose());
}

TEST(BeamElement, HasSixRigidMotionsAndNoMore) {
  const fem::BeamElement e(a, b, flat_bar());
  for (int i = 0; i < 3; ++i) {
    EXPECT_LT((e.stiffness() * rigid(Vec3::Unit(i), Vec3::Zero())).norm(), round_off * e.stiffness().norm());
    EXPECT_LT((e.stiffness() * rigid(Vec3::Zero(), Vec3::Unit(i))).norm(), round_off * e.stiffness().norm());
  }
  const Eigen::VectorXd values = core::symmetric_eigenvalues(e.stiffness());
  EXPECT_LT(std::abs(values[5]), round_off * values[11]);
  EXPECT_GT(values[6], 1e-6 * values[11]); // slenderness squared is 1e-4
}

TEST(BeamElement, MovesItsMassInATranslation) {
  auto p = flat_bar();
  const double length = (b - a).norm();
  const double lineic = p.material.density * p.section.area;
  const Vec3 axis = (b - a) / length;
  const Vec3 across = axis.unitOrthogonal();
  const auto mass_along = [&](const Vec3& d) {
    const Vector12 u = rigid(d, Vec3::Zero());
    return u.dot(fem::BeamElement(a, b, p).mass() * u);
  };
  EXPECT_NEAR(mass_along(across) / ((lineic + p.added_mass) * length), 1.0, round_off);
  EXPECT_NEAR(mass_along(axis) / (lineic * length), 1.0, round_off);
  p.added_mass_direction = fem::AddedMass::all;
  EXPECT_NEAR(mass_along(axis) / ((lineic + p.added_mass) * length), 1.0, round_off);
}

TEST(BeamElement, HasTheInertiaOfASlenderBarInARotation) {
  auto p = flat_bar();
  p.added_mass = 0.0;
  const double length = (b - a).norm(), mass = p.material.density * p.section.area * length;
  const Vec3 axis = (b - a) / length, across = axis.unitOrthogonal(), centre = 0.5 * (a + b);
  const auto inertia = [&](const Vec3& r) {
    const Vector12 u = rigid(-r.cross(centre), r);
    return u.dot(fem::BeamElement(a, b, p).mass() * u);
  };
  EXPECT_NEAR(inertia(across) / (mass * length * length / 12.0), 1.0, 1e-12); // no rotary inertia of bending
  EXPECT_NEAR(inertia(axis) / (p.material.density * p.section.polar_inertia * length), 1.0,
              1e-9); // 1e-4 of the other
}

TEST(BeamElement, HasAPositiveMass) {
  EXPECT_TRUE(core::Cholesky(fem::BeamElement(a, b, flat_bar()).mass()).is_positive_definite());
}

// Bending in the plane of x and y with iz, about z; in x-z with iy, ry = -duz/dx.
TEST(BeamElement, BendsTwistsAndStretchesAsTheTextbookSays) {
  auto p = flat_bar();
  p.orientation = Vec3::UnitY();
  constexpr double length = 0.8, force = 3.0;
  const double e = p.material.young_modulus, g = e / 2.6;
  const Vec3 end(length, 0, 0);
  const auto unit = [&](int dof) {
    return Eigen::Matrix<double, 6, 1>(force * Eigen::Matrix<double, 6, 1>::Unit(dof));
  };
  const auto along_y = tip(p, end, unit(1)), along_z = tip(p, end, unit(2));
  EXPECT_NEAR(along_y[1] / (force * std::pow(length, 3) / (3 * e * p.section.iz)), 1.0, round_off);
  EXPECT_NEAR(along_y[5] / (force * length * length / (2 * e * p.section.iz)), 1.0, round_off);
  EXPECT_NEAR(along_z[2] / (force * std::pow(length, 3) / (3 * e * p.section.iy)), 1.0, round_off);
  EXPECT_NEAR(along_z[4] / (-force * length * length / (2 * e * p.section.iy)), 1.0, round_off);
  EXPECT_NEAR(tip(p, end, unit(0))[0] / (force * length / (e * p.section.area)), 1.0, round_off);
  EXPECT_NEAR(tip(p, end, unit(3))[3] / (force * length / (g * p.section.torsion_constant)), 1.0, round_off);
}

TEST(BeamElement, TurnsWithTheFrame) {
  auto p = flat_bar();
  const Eigen::Matrix3d r = (Eigen::AngleAxisd(0.7, Vec3(1, 2, -1).normalized())).toRotationMatrix();
  const fem::BeamElement e(a, b, p);
  p.orientation = r * *p.orientation;
  const fem::BeamElement f(r * a, r * b, p);
  EXPECT_LT(difference(f.stiffness(), turned(e.stiffness(), r)), round_off);
  EXPECT_LT(difference(f.mass(), turned(e.mass(), r)), round_off);
}

TEST(BeamElement, DoesNotKnowItsDirection) {
  const fem::BeamElement e(a, b, flat_bar()), f(b, a, flat_bar());
  EXPECT_LT(difference(ends_swapped(f.stiffness()), e.stiffness()), round_off);
  EXPECT_LT(difference(ends_swapped(f.mass()), e.mass()), round_off);
}

TEST(BeamElement, NeedsNoOrientationWhereTheSectionHasNoDirection) {
  auto p = tube_property();
  const fem::BeamElement free(a, b, p);
  p.orientation = Vec3(-0.3, 0.2, 0.9);
  const fem::BeamElement turned(a, b, p);
  EXPECT_LT(difference(free.stiffness(), turned.stiffness()), round_off);
  EXPECT_LT(difference(free.mass(), turned.mass()), round_off);
}

TEST(FrameAlong, IsRightHandedWithYInThePlaneOfTheOrientation) {
  const Vec3 guide(0.1, 1.0, -0.3);
  const Eigen::Matrix3d axes = fem::frame_along((b - a).normalized(), guide, a, b);
  EXPECT_LT((axes * axes.transpose() - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff(), round_off);
  EXPECT_NEAR(axes.determinant(), 1.0, round_off);
  EXPECT_LT((axes.row(0).transpose() - (b - a).normalized()).norm(), round_off);
  EXPECT_NEAR(axes.row(2).dot(guide.transpose()), 0.0, round_off);
  EXPECT_GT(axes.row(1).dot(guide.transpose()), 0.0);
}

TEST(BeamStrains, GiveTheEnergyAndTheForceOfTheStiffness) {
  const auto p = flat_bar();
  const fem::BeamElement beam(a, b, p);
  const Matrix12 k = beam.stiffness();
  for (int dof = 0; dof < 12; ++dof) {
    Vector12 u = Vector12::LinSpaced(0.1, 1.3) * 1e-3;
    u[dof] += 2e-3;
    EXPECT_NEAR(beam.twice_strain_energy(u) / u.dot(k * u), 1.0, 1e-12);
    EXPECT_LT((beam.elastic_force(u) - k * u).norm(), round_off * (k * u).norm());
  }
}

TEST(BeamElement, NamesWhatItCannotBuild) {
  auto p = flat_bar();
  expect_error([&] { (void)fem::BeamElement(a, a, p); },
               {"beam from (0.3, -0.2, 0.7)", "no length", "merge"});
  p.orientation = b - a;
  expect_error([&] { (void)fem::BeamElement(a, b, p); },
               {"beam from", "orientation (0.8, 0.7, -0.5)", "along the beam"});
  p.orientation = Vec3::Zero();
  expect_error([&] { (void)fem::BeamElement(a, b, p); }, {"orientation (0, 0, 0)", "or zero"});
  p.orientation.reset();
  expect_error([&] { (void)fem::BeamElement(a, b, p); },
               {"iy = 2.5e-09", "iz = 2.25e-08", "give orientation"});
}

} // namespace beam_element_test
