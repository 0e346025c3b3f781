// SPDX-License-Identifier: GPL-3.0-or-later
#include "../fem/expect_error.hpp"
#include "flow/added_mass.hpp"
#include <cmath>

namespace fretwork::flow::added_mass_test {
namespace {

constexpr double printed = 0.5e-6;   ///< six decimals
constexpr double round_off = 1e-14;  ///< relative, of a few products
constexpr double diameter = 0.01905; ///< m

double coefficient(Arrangement arrangement, double pitch_ratio) {
  return added_mass_coefficient(confinement_ratio({arrangement, pitch_ratio * diameter}, diameter));
}

TEST(AddedMass, HasTheReferenceValues) {
  for (const Arrangement triangles : {Arrangement::triangle, Arrangement::rotated_triangle}) {
    EXPECT_NEAR(coefficient(triangles, 1.44), 1.412156, printed);
    EXPECT_NEAR(coefficient(triangles, 1.5), 1.358473, printed);
  }
  for (const Arrangement squares : {Arrangement::square, Arrangement::rotated_square}) {
    EXPECT_NEAR(coefficient(squares, 1.44), 1.317415, printed);
    EXPECT_NEAR(coefficient(squares, 1.5), 1.277461, printed);
  }
}

TEST(AddedMass, OfASingleTubeIsTheFluidThatItDisplaces) {
  EXPECT_EQ(coefficient(Arrangement::single, 0.0), 1.0);
  EXPECT_TRUE(std::isinf(confinement_ratio({}, diameter)));
}

TEST(AddedMass, OfABundleIsThatOfItsCircle) {
  // potential flow between the tube and a circle of diameter De: (De^2 + D^2)/(De^2 - D^2)
  const Bundle bundle{Arrangement::square, 1.44 * diameter};
  const double d = diameter, de = confinement_ratio(bundle, d) * d;
  const double expected = (de * de + d * d) / (de * de - d * d);
  EXPECT_NEAR(added_mass_coefficient(de / d), expected, round_off * expected);
}

TEST(AddedMass, RefusesTubesThatNearlyTouch) {
  tests::expect_error(
      [] {
        (void)confinement_ratio({Arrangement::square, 1.05 * 0.02}, 0.02);
      },
      {"pitch = 0.021 m", "diameter 0.02 m", "P/D = 1.05", "above 1.05 diameters"});
  EXPECT_GT(confinement_ratio({Arrangement::square, 1.051 * 0.02}, 0.02), 1.0);
  tests::expect_error(
      [] {
        (void)pitch_ratio({Arrangement::triangle, std::nan("")}, 0.02);
      },
      {"pitch = nan"});
  tests::expect_error([] { (void)pitch_ratio({}, 0.02); },
                      {"a single tube has no pitch", "name the arrangement"});
}

} // namespace
} // namespace fretwork::flow::added_mass_test
