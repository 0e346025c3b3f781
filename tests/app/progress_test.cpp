// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/progress.hpp"
#include <gtest/gtest.h>

namespace fretwork::app::test::progress_test {

TEST(Pace, OfARunThatGoesOnCountsOnlyItsOwnSteps) {
  Pace pace;
  EXPECT_FALSE(pace.left(0.80, 1.0)) << "nothing is known yet";
  EXPECT_FALSE(pace.left(0.80, 2.0));
  EXPECT_NEAR(*pace.left(0.85, 6.0), 15.0, 1e-9) << "5 % in 5 s: 15 % in 15 s";
}

TEST(Pace, OfARunFromTheStartIsThatOfAllSteps) {
  Pace pace;
  EXPECT_FALSE(pace.left(0.0, 0.0));
  EXPECT_NEAR(*pace.left(0.25, 10.0), 30.0, 1e-9);
}

} // namespace fretwork::app::test::progress_test
