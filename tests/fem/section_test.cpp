// SPDX-License-Identifier: GPL-3.0-or-later
#include "expect_error.hpp"
#include "fem/section.hpp"
#include <cmath>
#include <limits>
#include <numbers>

namespace section_test {

using namespace fretwork;
using fretwork::tests::expect_error;
using std::numbers::pi;

namespace {
constexpr double round_off = 1e-14; // closed forms of a few operations
}

TEST(PipeSection, IsTheDifferenceOfTwoCircles) {
  const auto pipe = fem::pipe_section(0.02, 0.003);
  const auto outer = fem::circle_section(0.02), inner = fem::circle_section(0.014);
  EXPECT_NEAR(pipe.area / (outer.area - inner.area), 1.0, round_off);
  EXPECT_NEAR(pipe.iy / (outer.iy - inner.iy), 1.0, round_off);
  EXPECT_EQ(pipe.iy, pipe.iz);
  EXPECT_NEAR(pipe.torsion_constant / (2.0 * pipe.iy), 1.0, round_off);
  EXPECT_NEAR(pipe.polar_inertia / (2.0 * pipe.iy), 1.0, round_off);
}

TEST(PipeSection, IsSolidWhereTheWallIsHalfTheDiameter) {
  const auto pipe = fem::pipe_section(0.02, 0.01), circle = fem::circle_section(0.02);
  EXPECT_NEAR(pipe.area / circle.area, 1.0, round_off);
  EXPECT_NEAR(pipe.iz / circle.iz, 1.0, round_off);
}

TEST(CircleSection, HasTheClosedForms) {
  const auto s = fem::circle_section(2.0);
  EXPECT_NEAR(s.area / pi, 1.0, round_off);
  EXPECT_NEAR(s.iy / (pi / 4.0), 1.0, round_off);
  EXPECT_NEAR(s.torsion_constant / (pi / 2.0), 1.0, round_off);
}

TEST(RectangleSection, HasTheClosedForms) {
  const auto s = fem::rectangle_section(0.05, 0.01); // 0.05 along y
  EXPECT_NEAR(s.area / 5e-4, 1.0, round_off);
  EXPECT_NEAR(s.iz / (0.01 * std::pow(0.05, 3) / 12.0), 1.0, round_off);
  EXPECT_NEAR(s.iy / (0.05 * std::pow(0.01, 3) / 12.0), 1.0, round_off);
  EXPECT_NEAR(s.polar_inertia / (s.iy + s.iz), 1.0, round_off);
}

// Factors J / (a b^3) of the tables (Timoshenko and Goodier, section 109), printed with the digits used here.
TEST(RectangleSection, TwistsAsTheSaintVenantSeriesSays) {
  const auto factor = [](double ratio) {
    return fem::rectangle_section(ratio, 1.0).torsion_constant / ratio;
  };
  EXPECT_NEAR(factor(1.0), 0.140577, 5e-7);
  EXPECT_NEAR(factor(2.0), 0.228682, 5e-7);
  EXPECT_NEAR(factor(10.0), 0.312325, 1e-5);
  constexpr double thin = 1e-9; // (1 - 0.63025 b/a) / 3, the remaining terms are exponentially small
  EXPECT_NEAR(factor(1000.0), (1.0 - 0.63024830e-3) / 3.0, thin);
  EXPECT_DOUBLE_EQ(fem::rectangle_section(1.0, 3.0).torsion_constant,
                   fem::rectangle_section(3.0, 1.0).torsion_constant);
}

TEST(Sections, RefuseSizesThatMakeNone) {
  expect_error([] { (void)fem::pipe_section(0.0, 0.001); }, {"pipe", "outer_diameter = 0", "> 0"});
  expect_error([] { (void)fem::pipe_section(0.02, -0.001); }, {"pipe", "thickness = -0.001"});
  expect_error([] { (void)fem::pipe_section(0.02, 0.011); },
               {"0.011", "half of outer_diameter = 0.02", "circle"});
  expect_error([] { (void)fem::circle_section(std::numeric_limits<double>::quiet_NaN()); },
               {"circle", "diameter = nan"});
  expect_error([] { (void)fem::rectangle_section(-1.0, 1.0); }, {"height_y = -1"});
  expect_error([] { (void)fem::rectangle_section(1.0, std::numeric_limits<double>::infinity()); },
               {"height_z = inf"});
}

TEST(OuterFibreStress, AddsTractionAndBending) {
  const auto pipe = fem::pipe_section(0.02, 0.003);
  EXPECT_NEAR(*fem::outer_fibre_stress(pipe, -100.0, 3.0, -4.0) / (100.0 / pipe.area + 5.0 * 0.01 / pipe.iy),
              1.0, round_off);
  const auto bar = fem::rectangle_section(0.05, 0.01); // W = b h^2/6
  EXPECT_NEAR(*fem::outer_fibre_stress(bar, 100.0, -3.0, 4.0) /
                  (100.0 / 5e-4 + 3.0 / (0.05 * 0.01 * 0.01 / 6) + 4.0 / (0.01 * 0.05 * 0.05 / 6)),
              1.0, round_off);
  fem::Section general = bar;
  general.shape = std::monostate{};
  EXPECT_FALSE(fem::outer_fibre_stress(general, 100.0, 0.0, 0.0));
  EXPECT_EQ(fem::outer_radius(pipe), 0.01);
  EXPECT_EQ(fem::outer_radius(fem::circle_section(0.02)), 0.01);
  EXPECT_FALSE(fem::outer_radius(bar));
}

} // namespace section_test
