// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/progress.hpp"
#include <algorithm>
#include <gtest/gtest.h>
#include <string>

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

std::string lines_of(bool wanted) {
  testing::internal::CaptureStderr(); // to a file
  {
    Progress progress(wanted, std::chrono::milliseconds(0));
    progress.stage("transient");
    for (int i = 1; i <= 1000; ++i)
      progress.update(0.001 * i, 0.002 * i);
  }
  return testing::internal::GetCapturedStderr();
}

TEST(Progress, InAFileIsALineForEachHundredthAtMost) {
  const std::string text = lines_of(true);
  EXPECT_EQ(text.find('\r'), std::string::npos) << "nothing of a terminal";
  const auto lines = std::count(text.begin(), text.end(), '\n');
  EXPECT_GT(lines, 50);
  EXPECT_LE(lines, 100);
  EXPECT_TRUE(text.starts_with("transient   1.0 %   t = 0.02 s")) << text;
  EXPECT_TRUE(lines_of(false).empty());
}

} // namespace fretwork::app::test::progress_test
