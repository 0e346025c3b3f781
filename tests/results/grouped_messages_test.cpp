// SPDX-License-Identifier: GPL-3.0-or-later
#include "results/grouped_messages.hpp"
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace fretwork::results::grouped_messages_test {
namespace {

using testing::ElementsAre;

TEST(GroupedMessages, BecomeOneWhereOnlyNamesAndNumbersDiffer) {
  EXPECT_THAT(grouped_messages({"contact \"a\": damping 3.5 N s/m", "the mesh is coarse",
                                "contact \"b\": damping 2e-3 N s/m", "contact \"c\": damping 10 N s/m"}),
              ElementsAre("contact \"a\", \"b\", \"c\": damping 2e-3 to 10 N s/m", "the mesh is coarse"));
}

TEST(GroupedMessages, NameTheFirstAndTheLastOfMany) {
  std::vector<std::string> messages;
  for (int i = 1; i <= 12; ++i)
    messages.push_back("contact \"h" + std::to_string(i) + "\" starts in contact");
  EXPECT_THAT(grouped_messages(messages), ElementsAre("contact \"h1\" ... \"h12\" (12) starts in contact"));
}

TEST(AlikeMessages, AreTogetherWhateverTheirNumber) {
  const auto alike = alike_messages({"gap = -1 m", "the mesh is coarse", "gap = -3 m", "gap = -2 m"});
  ASSERT_EQ(alike.size(), 2u);
  EXPECT_EQ(alike[0].text, "gap = -3 to -1 m");
  EXPECT_THAT(alike[0].members, ElementsAre(0, 2, 3));
  EXPECT_EQ(alike[1].text, "the mesh is coarse");
}

TEST(AlikeMessages, ListTheNamesOfAll) {
  const auto alike =
      alike_messages({"wear of \"a\", \"b\": deep", "wear of \"b\": deep", "wear of \"c\": deep"});
  ASSERT_EQ(alike.size(), 1u);
  EXPECT_EQ(alike[0].text, "wear of \"a\", \"b\", \"c\": deep");
}

// How many names a list shows does not make another message.
TEST(AlikeMessages, TakeListsThatAreNotInFull) {
  const auto alike = alike_messages(
      {"wear of \"a\", \"b\": 2 mm", "wear of \"b\", \"c\", \"d\" and 2 more: 3 mm", "wear of \"b\": 4 mm"});
  ASSERT_EQ(alike.size(), 1u);
  EXPECT_EQ(alike[0].text, "wear of \"a\" ... \"d\" (4 or more): 2 to 4 mm");
  const std::string alone = "wear of \"a\", \"b\", \"c\" and 1 more: 2 mm";
  EXPECT_EQ(alike_messages({alone, alone}).at(0).text, alone);
  EXPECT_EQ(alike_messages({"\"a\" and 1 more", "\"b\" and 3 more"}).at(0).text, "\"a\", \"b\" and more");
  EXPECT_EQ(alike_messages({"\"a\" and 1 other", "\"b\" and more"}).size(), 2u);
}

TEST(AlikeMessages, ShortenDrawnNumbers) {
  const auto alike = alike_messages({"gap = -7.277111634167311e-05 m", "gap = -1.4197483085923992e-05 m"});
  EXPECT_EQ(alike.at(0).text, "gap = -7.27711e-05 to -1.41975e-05 m");
}

TEST(GroupedMessages, OfTwoStandByThemselves) {
  const std::vector<std::string> messages{"stability \"a\": margin 0.4 in mode 1",
                                          "stability \"b\": margin 0.1 in mode 2"};
  EXPECT_EQ(grouped_messages(messages), messages);
}

TEST(GroupedMessages, KeepWhatDiffersInWords) {
  const std::vector<std::string> messages{"contact \"a\" opens", "contact \"a\" closes", "contact a opens",
                                          "3 contacts", "three contacts"};
  EXPECT_EQ(grouped_messages(messages), messages);
}

TEST(GroupedMessages, ThatAreEqualAreSaidOnce) {
  EXPECT_THAT(grouped_messages({"x_1 = 2 m2", "x_1 = 2 m2"}), ElementsAre("x_1 = 2 m2"));
}

TEST(GroupedMessages, MayHoldNamesOfAnyLength) {
  const std::string name = '"' + std::string(1'000'000, 'a') + '"';
  EXPECT_THAT(grouped_messages({"contact " + name + " opens"}), ElementsAre("contact " + name + " opens"));
}

TEST(GroupedMessages, JoinRangesToOne) {
  EXPECT_THAT(grouped_messages({"damping 3 to 5 N s/m", "damping 4 N s/m", "damping 2.5 to 4.5 N s/m"}),
              ElementsAre("damping 2.5 to 5 N s/m"));
}

TEST(GroupedMessages, KeepSigns) {
  EXPECT_THAT(grouped_messages({"margin -0.3", "margin 0.2", "margin -1.5"}),
              ElementsAre("margin -1.5 to 0.2"));
}

TEST(GroupedMessages, KeepNumbersWithinWords) {
  EXPECT_THAT(grouped_messages({"a 1e5x 2.5e-3 7 mm", "a 1e5x 2e-3 3 mm", "a 1e5x 4e-3 9 mm"}),
              ElementsAre("a 1e5x 2e-3 to 4e-3 3 to 9 mm"));
}

} // namespace
} // namespace fretwork::results::grouped_messages_test
