// SPDX-License-Identifier: GPL-3.0-or-later
// Lines of the terminal on fluidelastic laws of a run.
#include "results/flow_text.hpp"
#include "results/write.hpp"
#include "synthetic.hpp"
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace fretwork::results::law_motion_test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

LawAtWork law(const std::string& tube, double growth) { return {{tube}, 6, {growth, 100.0}, 4.0, 0.02}; }
LawAtWork unstable(const std::string& tube, const std::vector<std::string>& together) {
  LawAtWork out = law(tube, 1.0);
  out.motion = LawMotion{
      LawMotion::Place{true, "stop", 'z', 1e-4, 2e-4, 20.0, 1.0}, 1.0, post::Growth{}, together, {}};
  post::PowerBalance& power = out.motion->power;
  power.fluid = {5e-3, 1e-4};
  power.modal_damping = {4e-3, 1e-6};
  power.contact_damping = {1e-3, 1e-4};
  power.friction = {1e-9, 1e-12};
  return out;
}

TEST(LawMotionLines, AreTwoOfALawThatIsUnstableAndOneOfTheOthers) {
  RunResults results;
  EXPECT_TRUE(law_motion_lines(results).empty());
  results.laws = {law("T1", -1.0), unstable("T2", {"T2"}), law("T3", -2.0)};
  EXPECT_THAT(
      law_motion_lines(results),
      ElementsAre("\"T2\", unstable without contacts: contact \"stop\" moves along z_loc by 0.1 mm rms, "
                  "0.2 mm at most (1 % of the diameter), at 20 Hz, V/(f D) = 10; does not grow",
                  "\"T2\", powers in mW: fluid 5.00+-0.10 = modal damping 4 + contact damping 1.00+-0.10",
                  "\"T1\", \"T3\": stable without contacts"));
}

TEST(LawMotionLines, SayWhatGrowsAndWhatIsNotKnown) {
  RunResults results;
  results.laws = {unstable("T1", {"T1"})};
  LawMotion& motion = *results.laws[0].motion;
  motion.growth = post::Growth{2.0, 0.1, 3.0, true};
  motion.place->frequency.reset();
  EXPECT_THAT(law_motion_lines(results)[0],
              HasSubstr("(1 % of the diameter); STILL GROWS by 2.00+-0.10 1/s"));
  motion.growth.reset();
  motion.place.reset();
  EXPECT_THAT(law_motion_lines(results)[0], testing::EndsWith(": no contact or observed node moves"));
}

TEST(LawMotionLines, ShowThePowersOfTubesThatRunTogetherOnce) {
  RunResults results;
  const std::vector<std::string> together{"T1", "T2", "T3", "T4", "T5"};
  for (const std::string& tube : together)
    results.laws.push_back(unstable(tube, together));
  const std::vector<std::string> lines = law_motion_lines(results);
  ASSERT_EQ(lines.size(), 6u);
  EXPECT_THAT(lines[1], HasSubstr("\"T1\", \"T2\", \"T3\" and 2 more, powers in mW"));
  EXPECT_THAT(lines[5], "and 1 more in summary.json");
}

TEST(LawMotionLines, StandInTheTableOfARun) {
  RunResults results = made_up({.contacts = 1});
  results.laws = {unstable("T1", {"T1"})};
  EXPECT_THAT(terminal_table(results), HasSubstr("  law         \"T1\", unstable without contacts"));
}

} // namespace
} // namespace fretwork::results::law_motion_test
