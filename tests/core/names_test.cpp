// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/names.hpp"
#include <chrono>
#include <gtest/gtest.h>

namespace names_test {

using namespace fretwork::core;

TEST(NearestName, FindsASlipOfTheHand) {
  const std::vector<std::string> names = {"gap", "offset", "origin", "normal_stiffness"};
  EXPECT_EQ(nearest_name("gpa", names), "gap");
  EXPECT_EQ(nearest_name("Offset", names), "offset");
  EXPECT_EQ(nearest_name("normal_stifness", names), "normal_stiffness");
}

TEST(NearestName, CompletesABeginning) {
  EXPECT_EQ(nearest_name("trunc", {"truncated", "uniform"}), "truncated");
  EXPECT_EQ(nearest_name("normal", {"normal_stiffness", "normal_damping"}), "");
  EXPECT_EQ(nearest_name("stop.work", {"stop.work_rate", "stop.work_rate.error", "total.work_rate"}),
            "stop.work_rate");
  EXPECT_EQ(nearest_name("g", {"gap", "offset"}), "");
}

TEST(NearestName, SaysNothingWhereNothingResembles) {
  EXPECT_EQ(nearest_name("friction", {"gap", "offset"}), "");
  EXPECT_EQ(nearest_name("x", {}), "");
}

TEST(NearestName, TakesNoTimeForNamesOfMillionsOfLetters) {
  constexpr double most_seconds =
      2.0; // a comparison letter by letter takes 10 s with this name and these candidates
  const std::vector<std::string> keys(40, "normal_stiffness_of_the_contact");
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_EQ(nearest_name(std::string(5'000'000, 'k'), keys), "");
  EXPECT_LT(std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count(), most_seconds);
}

TEST(ListNames, QuotesAndCutsLongLists) {
  EXPECT_EQ(list_names({}), "none");
  EXPECT_EQ(list_names({"a", "b"}), "\"a\", \"b\"");
  EXPECT_EQ(list_names({"a", "b", "c"}, 2), "\"a\", \"b\" and 1 more");
}

TEST(NameHelp, GivesTheNearestAndTheList) {
  EXPECT_EQ(name_help("endz", {"ends", "leg"}), "; did you mean \"ends\"? existing: \"ends\", \"leg\"");
  EXPECT_EQ(name_help("middle", {"ends"}, "groups"), "; groups: \"ends\"");
}

TEST(Fits, StarStandsForAnyCharactersAndQuestionMarkForOne) {
  EXPECT_TRUE(fits("tsp12", "tsp*"));
  EXPECT_TRUE(fits("tsp", "tsp*"));
  EXPECT_TRUE(fits("tsp1.gap", "*.gap"));
  EXPECT_TRUE(fits("tsp1", "tsp?"));
  EXPECT_FALSE(fits("tsp12", "tsp?"));
  EXPECT_FALSE(fits("avb1", "tsp*"));
  EXPECT_FALSE(fits("tsp1", ""));
}

} // namespace names_test
