// SPDX-License-Identifier: GPL-3.0-or-later
#include "folder.hpp"
#include "study/time_functions.hpp"
#include <gtest/gtest.h>

namespace fretwork::study {
namespace {

transient::Table read_rows(const std::string& text) {
  const Folder folder;
  return read_time_table(folder.write("t.csv", text));
}

std::string problem_of(const std::string& text) {
  try {
    (void)read_rows(text);
  } catch (const core::Error& error) {
    return error.what();
  }
  return {};
}

TEST(TimeTable, PassesOverHeaderCommentsAndEmptyLines) {
  const auto table = read_rows("# force of the test\ntime (s),force (N)\n\n0, 1.5\r\n  # middle\n1e-1 ,+2\n");
  EXPECT_EQ(table, (transient::Table{{0.0, 0.1}, {1.5, 2.0}}));
}

TEST(TimeTable, TakesAJumpAndAMissingHeaderAndLineEnd) {
  EXPECT_EQ(read_rows("0,1\n1,1\n1,-2"), (transient::Table{{0, 1, 1}, {1, 1, -2}}));
}

TEST(TimeTable, RefusesBadRowsWithTheirLine) {
  const std::pair<const char*, const char*> cases[] = {
      {"0,1\n\nt,F\n", "t.csv:3: \"t,F\": a row is two finite numbers, t,value"},
      {"t,F\nt,F\n", "t.csv:2: \"t,F\": a row is two finite numbers"},
      {"0 1\n", "t.csv:1: \"0 1\": a row is two finite numbers"},
      {"0\n", "t.csv:1: \"0\": a row is two finite numbers"},
      {"0,1,2\n", "t.csv:1: \"0,1,2\": a row is two finite numbers"},
      {"0,1\n1,\n", "t.csv:2: \"1,\": a row is two finite numbers"},
      {"0,1\n1,nan\n", "t.csv:2: \"1,nan\": a row is two finite numbers"},
      {"0,1\ninf,1\n", "t.csv:2: \"inf,1\": a row is two finite numbers"},
      {"0,1\n1,2 N\n", "t.csv:2: \"1,2 N\": a row is two finite numbers"},
      {"0,1\n2,1\n1,1\n", "t.csv:3: \"1,1\": the time decreases; sort the rows by time"},
      {"0,1\n0,2\n0,3\n", "t.csv:3: \"0,3\": a third row at the same time"},
      {"# nothing\n\n", "t.csv has no row; give rows t,value"},
      {"t,F\n", "t.csv has no row"}};
  for (const auto& [text, expected] : cases)
    EXPECT_NE(problem_of(text).find(expected), std::string::npos) << text << problem_of(text);
}

TEST(TimeTable, RefusesAFileThatIsNotThere) {
  const Folder folder;
  for (const auto& file : {folder.path() / "none.csv", folder.path()})
    EXPECT_THROW((void)read_time_table(file), core::Error);
}

TEST(TimeTable, StartsFromTheFolderOfTheStudy) {
  const Folder folder;
  folder.write("force.csv", "0,1\n2,3\n");
  const auto file = folder.write(
      "study.toml", contact("[[loads]]\ngroup = \"p\"\ndirection = [1, 0, 0]\ntable = \"force.csv\"\n"));
  EXPECT_EQ(read(file).loads[0].function, transient::TimeFunction(transient::Table{{0, 2}, {1, 3}}));
}

} // namespace
} // namespace fretwork::study
