// SPDX-License-Identifier: GPL-3.0-or-later
// Forces and moments in the sections of a beam: statics in closed form, the curvature of a mode, preload, arcs.
#include "core/symmetric.hpp"
#include "fem/beam_element.hpp"
#include "fem/beam_point.hpp"
#include "model_builder.hpp"
#include <Eigen/Geometry>

namespace section_forces_test {

using namespace fretwork;
using namespace fretwork::tests;
using fem::BeamElement;
using fem::Vector12;
using fem::Vector6;

namespace {

constexpr double round_off = 1e-11; // of an inverse of order 6 whose stiffnesses differ by 1e4
constexpr std::array shares{0.0, 0.25, 0.5, 1.0};

/// Held at a, loaded at b (N, N m).
Vector12 loaded_at_b(const BeamElement& e, const Vector6& load) {
  Vector12 u = Vector12::Zero();
  u.tail<6>() = core::Cholesky(e.stiffness().bottomRightCorner<6, 6>()).solve(load);
  return u;
}

fem::BeamProperty flat_bar() {
  fem::BeamProperty p{{2.1e11, 0.3, 7800.0}, fem::rectangle_section(0.03, 0.01)};
  p.orientation = Vec3::UnitY();
  return p;
}

/// N Vy Vz T My Mz
Vector6 forces(double n, double vy, double vz, double t, double my, double mz) {
  Vector6 out;
  out << n, vy, vz, t, my, mz;
  return out;
}

void expect_equal(const Vector6& is, const Vector6& expected, const std::string& what) {
  EXPECT_LT((is - expected).norm(), round_off * (1.0 + expected.norm())) << what << ": " << is.transpose();
}

} // namespace

// v = F x^2 (3 L - x) / (6 EIz), so that Mz = EIz v'' = F (L - x) and Vy = -EIz v''' = F; w likewise, My = -EIy w''.
TEST(SectionForces, OfACantileverAreThoseOfItsTipLoads) {
  const double length = 0.8;
  const BeamElement e(Vec3::Zero(), Vec3(length, 0, 0), flat_bar());
  const auto of = [&](int dof, double share) {
    return e.section_forces(loaded_at_b(e, 10.0 * Vector6::Unit(dof)), share);
  };
  for (const double share : shares) {
    const double moment = 10.0 * length * (1.0 - share);
    expect_equal(of(0, share), forces(10, 0, 0, 0, 0, 0), "axial force");
    expect_equal(of(1, share), forces(0, 10, 0, 0, 0, moment), "force along y");
    expect_equal(of(2, share), forces(0, 0, 10, 0, -moment, 0), "force along z");
    expect_equal(of(3, share), forces(0, 0, 0, 10, 0, 0), "torque");
    expect_equal(of(4, share), forces(0, 0, 0, 0, 10, 0), "moment about y");
    expect_equal(of(5, share), forces(0, 0, 0, 0, 0, 10), "moment about z");
  }
}

TEST(SectionForces, AreTheStrainsTimesTheStiffnesses) {
  const double length = 0.8;
  const fem::BeamProperty p = flat_bar();
  const BeamElement e(Vec3::Zero(), Vec3(length, 0, 0), p);
  const double young = p.material.young_modulus, shear = young / 2.6;
  Vector12 u = Vector12::Zero(); // u = x/1000, v = x^2/100, w = x^2/50, rx = x/20
  u.tail<6>() << 1e-3 * length, 1e-2 * length * length, 2e-2 * length * length, 0.05 * length, -4e-2 * length,
      2e-2 * length;
  const Vector6 expected =
      forces(1e-3 * young * p.section.area, 0, 0, 0.05 * shear * p.section.torsion_constant,
             -4e-2 * young * p.section.iy, 2e-2 * young * p.section.iz);
  for (const double share : shares)
    EXPECT_LT((e.section_forces(u, share) - expected).norm(), round_off * young * p.section.area * 1e-3);
}

TEST(SectionForces, BalanceALoadAtTheEndOfAnyBeam) {
  const Vec3 a(0.3, -0.2, 0.7), b(1.1, 0.5, 0.2), middle(0.6, 0.4, 0.55);
  fem::BeamProperty shears = flat_bar(), tapers = flat_bar();
  shears.section.shear = fem::ShapeShear{};
  tapers.taper = fem::Taper{fem::rectangle_section(0.045, 0.012)};
  Vector6 load;
  load << 10, -20, 30, 4, 5, -6;
  const Vec3 force = load.head<3>(), moment = load.tail<3>();
  for (const BeamElement& e :
       {BeamElement(a, b, flat_bar()), BeamElement(a, b, shears), BeamElement(a, b, tapers),
        BeamElement(a, b, flat_bar(), middle), BeamElement(a, b, tube_property(), middle)}) {
    const Vector12 u = loaded_at_b(e, load);
    for (const double share : shares) {
      const Eigen::Matrix3d axes = e.section_axes(share);
      const double s = share * e.axis().length();
      EXPECT_LT((axes * axes.transpose() - Eigen::Matrix3d::Identity()).norm(), 1e-14);
      EXPECT_LT((axes.row(0).transpose() - e.axis().tangent(s)).norm(), 1e-14);
      EXPECT_NEAR(axes.determinant(), 1.0, 1e-14);
      const Vec3 arm = b - e.axis().point(s);
      Vector6 expected;
      expected << axes * force, axes * (moment + arm.cross(force));
      expect_equal(e.section_forces(u, share), expected, "share " + std::to_string(share));
    }
  }
}

TEST(SectionForces, OfARigidMotionVanish) {
  const BeamElement e(Vec3(0.3, -0.2, 0.7), Vec3(1.1, 0.5, 0.2), tube_property(), Vec3(0.6, 0.4, 0.55));
  const Vec3 turn(0.1, -0.2, 0.3);
  Vector12 u;
  u << Vec3(1, 2, 3) + turn.cross(e.axis().point(0)), turn,
      Vec3(1, 2, 3) + turn.cross(e.axis().point(e.axis().length())), turn;
  const double scale = 2e11 * tube_property().section.area;
  EXPECT_LT(e.section_forces(u, 0.3).norm(), 1e-14 * scale);
}

TEST(SectionForces, LeaveThePreloadOut) {
  fem::BeamProperty p = flat_bar();
  const BeamElement plain(Vec3::Zero(), Vec3(0.8, 0, 0), p);
  p.axial_force = 5e3;
  const BeamElement taut(Vec3::Zero(), Vec3(0.8, 0, 0), p);
  const Vector12 u = Vector12::LinSpaced(0.1, 1.3) * 1e-3;
  EXPECT_EQ(taut.section_forces(u, 0.5), plain.section_forces(u, 0.5));
}

// The first mode of a cantilever, w = cosh kx - cos kx - c (sinh kx - sin kx), kL = 1.8751: the moment of its interpolation tends to
// EI w'' in the middle of elements with order 2, as (k h)^2/24.
TEST(SectionForces, ConvergeToTheMomentOfAModeWithOrderTwo) {
  constexpr double k = 1.875104068711961; // L = 1 m
  const double c = (std::cosh(k) + std::cos(k)) / (std::sinh(k) + std::sin(k));
  const auto w = [&](double x, int derivative) {
    const double even = derivative < 2 ? -1.0 : 1.0; // of the trigonometric part
    const double hyperbolic = derivative % 2 == 0 ? std::cosh(k * x) - c * std::sinh(k * x)
                                                  : std::sinh(k * x) - c * std::cosh(k * x);
    const double circular =
        derivative % 2 == 0 ? std::cos(k * x) - c * std::sin(k * x) : -std::sin(k * x) - c * std::cos(k * x);
    return std::pow(k, derivative) * (hyperbolic + even * circular);
  };
  const fem::BeamProperty p = tube_property();
  const double ei = p.material.young_modulus * p.section.iz;
  const auto error = [&](int elements) {
    double largest = 0.0;
    for (int i = 0; i < elements; ++i) {
      const double h = 1.0 / elements, x = i * h;
      fem::BeamProperty turned = p;
      turned.orientation = Vec3::UnitY();
      const BeamElement e(Vec3(x, 0, 0), Vec3(x + h, 0, 0), turned);
      Vector12 u = Vector12::Zero();
      u(1) = w(x, 0), u(5) = w(x, 1), u(7) = w(x + h, 0), u(11) = w(x + h, 1);
      largest = std::max(largest, std::abs(e.section_forces(u, 0.5)(5) / ei - w(x + 0.5 * h, 2)));
    }
    return largest / w(0.0, 2); // of the moment at the root
  };
  double last = error(4);
  EXPECT_NEAR(last / (k * k / 16.0 / 24.0), 1.0,
              0.2); // the largest deflection of the mode is as large as w'' / k^2 at the root
  for (const int elements : {8, 16, 32, 64}) {
    const double here = error(elements);
    EXPECT_NEAR(std::log2(last / here), 2.0, 0.15) << elements;
    last = here;
  }
}

} // namespace section_forces_test
