// SPDX-License-Identifier: GPL-3.0-or-later
// Elements whose section and masses change along their axis.
#include "core/symmetric.hpp"
#include "expect_error.hpp"
#include "fem/beam_constants.hpp"
#include "fem/beam_element.hpp"
#include "model_builder.hpp"

namespace taper_test {

using namespace fretwork;
using namespace fretwork::tests;
using fem::BeamElement;
using std::numbers::pi;

namespace {

constexpr double round_off = 1e-12;  // of integrals and an inverse of order 6
constexpr double quadrature = 1e-11; // 8 points of a section that grows by half
constexpr double length = 0.8;
const Vec3 origin = Vec3::Zero(), end(length, 0.0, 0.0);
constexpr double thick = 0.06, thin = 0.04;

/// A truncated cone, thick at a.
fem::BeamProperty cone() {
  fem::BeamProperty p{{2.1e11, 0.3, 7800.0}, fem::circle_section(thick)};
  p.taper = fem::Taper{fem::circle_section(thin)};
  return p;
}

Eigen::Matrix<double, 6, 1> tip(const BeamElement& e, int dof) {
  return core::Cholesky(e.stiffness().bottomRightCorner<6, 6>()).solve(Eigen::VectorXd::Unit(6, dof));
}

double relative(const fem::Matrix12& a, const fem::Matrix12& b) {
  return (a - b).cwiseAbs().maxCoeff() / b.cwiseAbs().maxCoeff();
}

} // namespace

// x from the tip, I = I1 (1 + c x/L)^4: int x^2/(E I) dx = L^3 d1^3 / (3 E I1 d0^3); int dx/(E A) = L/(E A1) d1/d0;
// int dx/(G J) = L/(3 G J1) (1 - (d1/d0)^3) / (d0/d1 - 1).
TEST(Taper, DeflectsAsTheClosedFormOfTheTruncatedCone) {
  const BeamElement e(origin, end, cone());
  const fem::Section at_tip = fem::circle_section(thin);
  const double young = 2.1e11, ratio = thin / thick;
  EXPECT_NEAR(tip(e, 1)[1] / (std::pow(length * ratio, 3) / (3 * young * at_tip.iz)), 1.0, quadrature);
  EXPECT_NEAR(tip(e, 0)[0] / (length / (young * at_tip.area) * ratio), 1.0, quadrature);
  EXPECT_NEAR(tip(e, 3)[3] / (length * (1 - std::pow(ratio, 3)) * 2.6 /
                              (3 * young * at_tip.torsion_constant * (1 / ratio - 1))),
              1.0, quadrature);
}

TEST(Taper, WeighsWhatTheBodyWeighs) {
  auto p = cone();
  p.added_mass = 2.0;
  p.taper->added_mass = 5.0;
  const auto pulled = [](int d) {
    fem::Vector12 u = fem::Vector12::Zero();
    u[d] = u[6 + d] = 1.0;
    return u;
  };
  const fem::Matrix12 m = BeamElement(origin, end, p).mass();
  const double body = 7800.0 * pi / 12.0 * length * (thick * thick + thick * thin + thin * thin);
  EXPECT_NEAR(pulled(0).dot(m * pulled(0)) / body, 1.0, round_off);
  EXPECT_NEAR(pulled(1).dot(m * pulled(1)) / (body + 3.5 * length), 1.0, round_off);
  fem::Model model;
  model.nodes = {origin, end};
  model.properties = {p};
  model.beams = {{0, 1, 0}};
  EXPECT_NEAR(fem::total_mass(model) / (body + 3.5 * length), 1.0, round_off);
}

TEST(Taper, FillsTheBoreWithFluid) {
  fem::BeamProperty p{{2e11, 0.3, 8000.0}, fem::pipe_section(0.05, 0.01)};
  p.taper = fem::Taper{fem::pipe_section(0.04, 0.01)};
  p.fluid = p.taper->fluid = {1000.0, 500.0, 2.0};
  const fem::BeamConstants middle = fem::beam_constants(p, 0.5);
  EXPECT_NEAR(middle.mass_transverse,
              8000 * pi * 0.01 * 0.035 + pi / 4 * (1000 * 0.025 * 0.025 + 2 * 500 * 0.045 * 0.045),
              round_off);
}

TEST(Taper, OfNothingIsTheUniformBeam) {
  auto p = cone(), q = cone();
  p.taper.reset();
  q.taper->section = q.section;
  const BeamElement uniform(origin, end, p), tapered(origin, end, q);
  EXPECT_LT(relative(tapered.stiffness(), uniform.stiffness()), round_off);
  EXPECT_LT(relative(tapered.mass(), uniform.mass()), round_off);
}

TEST(Taper, IsTheSameFromTheOtherEnd) {
  auto p = cone(), q = cone();
  std::swap(q.section, q.taper->section);
  const fem::Matrix12 forward = BeamElement(origin, end, p, std::nullopt, {0.2, 0.7}).stiffness(),
                      backward = BeamElement(origin, end, q, std::nullopt, {0.8, 0.3}).stiffness();
  EXPECT_LT(relative(forward, backward), round_off);
}

// A rectangle keeps its widths in proportion to none of its constants.
TEST(Taper, ChangesSizesNotConstants) {
  const fem::Section a = fem::rectangle_section(0.02, 0.01), b = fem::rectangle_section(0.04, 0.01),
                     middle = fem::between(a, b, 0.5);
  EXPECT_NEAR(middle.iz / (0.01 * std::pow(0.03, 3) / 12), 1.0, round_off);
  EXPECT_NEAR(middle.torsion_constant / fem::rectangle_section(0.03, 0.01).torsion_constant, 1.0, round_off);
  const fem::Section given{1, 2, 3, 4, 5}, other{3, 4, 5, 6, 7}, half = fem::between(given, other, 0.5);
  EXPECT_EQ(half, (fem::Section{2, 3, 4, 5, 6}));
}

TEST(Taper, NeedsSectionsOfAKind) {
  fem::Model model;
  model.nodes = {origin, end};
  model.fixed = {0, 0};
  model.properties = {cone()};
  model.beams = {{0, 1, 0}};
  model.properties[0].taper->section = fem::pipe_section(0.05, 0.01);
  expect_error([&] { (void)fem::structures(model); },
               {"beam property 0", "its two sections differ in shape"});
  model.properties[0] = cone();
  model.properties[0].taper->section.rotary_inertia = true;
  expect_error([&] { (void)fem::structures(model); }, {"rotary_inertia"});
  model.properties[0] = cone();
  model.properties[0].taper->added_mass = -1.0;
  expect_error([&] { (void)fem::structures(model); }, {"beam property 0: added_mass = -1"});
  model.properties[0] = cone();
  model.properties[0].section = model.properties[0].taper->section = {1, 1, 1, 1, 1};
  model.properties[0].fluid.outside = 1000.0;
  expect_error([&] { (void)fem::structures(model); }, {"neither a pipe nor a circle"});
  model.properties[0].fluid = {};
  model.properties[0].section.shear = fem::ShapeShear{};
  expect_error([&] { (void)fem::structures(model); }, {"no formula for the shear"});
}

} // namespace taper_test
