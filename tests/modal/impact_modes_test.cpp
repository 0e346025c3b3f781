// SPDX-License-Identifier: GPL-3.0-or-later
#include "modal/impact_modes.hpp"
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

namespace fretwork::modal::impact_modes_test {
namespace {

constexpr double round_off = 1e-13; ///< of some powers and roots

TEST(ImpactModes, ContactsOnAnInfiniteBeamVibrateAtItsClosedForm) {
  constexpr double bending = 496.0, mass = 2.0;
  for (const double stiffness : {1e5, 1e6, 1e7}) {
    const double exact =
        std::sqrt(bending / mass) * std::pow(stiffness / (2.0 * std::numbers::sqrt2 * bending), 2.0 / 3.0);
    EXPECT_NEAR(contact_frequency(stiffness, point_receptance(bending, mass, BeamPoint::interior)), exact,
                round_off * exact);
  }
}

TEST(ImpactModes, TheEndOfABeamYieldsFourTimesAsMuch) {
  EXPECT_DOUBLE_EQ(point_receptance(496.0, 2.0, BeamPoint::end),
                   4.0 * point_receptance(496.0, 2.0, BeamPoint::interior));
}

TEST(ImpactModes, TwoEqualBeamsVibrateLikeOneOnTwiceTheStiffness) {
  const double one = point_receptance(496.0, 2.0, BeamPoint::interior);
  EXPECT_DOUBLE_EQ(contact_frequency(1e6, one + one), contact_frequency(2e6, one));
}

TEST(ImpactModes, ContactFrequenciesNeededFallWithThePowersOfWhatIsLeftOut) {
  EXPECT_DOUBLE_EQ(contact_frequencies_needed(0.01, false), 7.0);
  EXPECT_DOUBLE_EQ(contact_frequencies_needed(0.01, true), 3.0);
  // a thousandfold error of a static flexibility is a hundredfold frequency; 128 times of its inertia, fourfold
  EXPECT_NEAR(contact_frequencies_needed(1e-5, false), 700.0, 700.0 * round_off);
  EXPECT_NEAR(contact_frequencies_needed(0.01 / 128.0, true), 12.0, 12.0 * round_off);
}

TEST(ImpactModes, ReachOneModeOfTheSpanBeyond) {
  constexpr double bending = 496.0, mass = 1.0, length = 1.0;
  const double span = clamped_span_frequency(length, bending, mass);
  EXPECT_NEAR(span, 22.373285448 * std::sqrt(bending), 1e-9 * span) << "ten printed digits of the root";
  EXPECT_DOUBLE_EQ(modes_needed_up_to(0.0, span, 0.01, false), span) << "a soft contact";
  // modes of a pinned span are pi/l apart in the root of their frequency: some are beyond the contact's multiple
  const double first = std::numbers::pi * std::numbers::pi * std::sqrt(bending);
  for (double contact = 0.1 * first; contact < 10.0 * first; contact *= 1.1) {
    const double limit = modes_needed_up_to(contact, span, 0.01, false);
    const double highest = std::floor(std::sqrt(limit / first)); // the number of the last mode below
    EXPECT_GE(highest * highest * first, 7.0 * contact);
  }
}

} // namespace
} // namespace fretwork::modal::impact_modes_test
