// SPDX-License-Identifier: GPL-3.0-or-later
#include "folder.hpp"
#include <gtest/gtest.h>

namespace fretwork::study::canonical_text_test {
namespace {

std::string canonical(const std::string& text, const std::vector<std::string>& tables,
                      const std::vector<std::string>& overrides = {}) {
  const Folder folder;
  return canonical_text(folder.write("study.toml", text), overrides, tables);
}

TEST(CanonicalText, SortsKeysAndWritesSeventeenDigits) {
  EXPECT_EQ(canonical("[mesh]\nscale = 0.1\nfile = \"a.msh\"\n", {"mesh"}),
            "mesh = {file = \"a.msh\", scale = 0.10000000000000001}\n");
}

TEST(CanonicalText, DoesNotDependOnCommentsOrderOrFormat) {
  const std::string one =
      "[mesh]\nfile = \"a.msh\"\nscale = 2.0\n[modes]\ncount = 3\n[[loads]]\ngroup=\"p\"\nconstant=10\n";
  const std::string two =
      "# comment\nloads = [{constant = 1e1, group = 'p'}]\n\n[modes] # here\ncount = 3\n\n[mesh]\n"
      "scale=2\nfile = \"a.msh\"\n";
  EXPECT_EQ(canonical(one, {"mesh", "modes", "loads"}), canonical(two, {"loads", "mesh", "modes"}));
}

TEST(CanonicalText, HoldsOnlyTheTablesAsked) {
  const std::string text = "[mesh]\nfile = \"a.msh\"\n[modes]\ncount = 3\n";
  EXPECT_EQ(canonical(text, {"modes", "contacts"}), "modes = {count = 3}\n");
}

TEST(CanonicalText, LeavesOutHowOftenCheckpointsAreWritten) {
  EXPECT_EQ(canonical("[output]\nimpacts = 3\ncheckpoint = 5\n", {"output"}), "output = {impacts = 3}\n");
  EXPECT_EQ(canonical("[output]\ncheckpoint = 5\n", {"output"}), canonical("title = \"a\"\n", {"output"}));
}

TEST(CanonicalText, HoldsTheOverrides) {
  const std::string text = "[modes]\ncount = 3\n";
  EXPECT_EQ(canonical(text, {"modes"}, {"modes.count=4"}), "modes = {count = 4}\n");
  EXPECT_EQ(canonical(text, {"modes"}, {"modes.count=3"}), canonical(text, {"modes"}));
}

TEST(CanonicalText, TellsValuesApartThatDifferInTheLastDigit) {
  EXPECT_NE(canonical("[mesh]\nscale = 0.1\n", {"mesh"}),
            canonical("[mesh]\nscale = 0.10000000000000002\n", {"mesh"}));
  EXPECT_NE(canonical("[mesh]\nscale = \"1\"\n", {"mesh"}), canonical("[mesh]\nscale = 1\n", {"mesh"}));
}

TEST(CanonicalText, EscapesStrings) {
  EXPECT_EQ(canonical("title = \"a\\\"b\\\\c\\n\"\n[mesh]\n", {"title"}), "title = \"a\\\"b\\\\c\\u000A\"\n");
}

TEST(CanonicalText, IsTomlThatGivesTheSameTextAgain) {
  const std::vector<std::string> tables{"title",      "mesh",   "materials", "sections",    "beams",
                                        "restraints", "masses", "springs",   "ties",        "modes",
                                        "contacts",   "loads",  "gravity",   "base_motion", "initial",
                                        "transient",  "output"};
  const std::string text = canonical(full_study, tables);
  EXPECT_EQ(canonical(text, tables), text);
  EXPECT_EQ(read_text(text).contacts.size(), 2u);
}

TEST(CanonicalText, HoldsTheRowsOfATableFile) {
  const std::string text = "[[loads]]\ngroup = \"p\"\ntable = \"force.csv\"\n";
  const Folder folder;
  const auto file = folder.write("study.toml", text);
  folder.write("force.csv", "t,F\n0,1\n0.5,2\n");
  EXPECT_EQ(canonical_text(file, {}, {"loads"}), "loads = [{group = \"p\", table = [[0, 1], [0.5, 2]]}]\n");
  folder.write("force.csv", "t,F\n0,1\n0.5,3\n");
  EXPECT_EQ(canonical_text(file, {}, {"loads"}), "loads = [{group = \"p\", table = [[0, 1], [0.5, 3]]}]\n");
}

} // namespace
} // namespace fretwork::study::canonical_text_test
