// SPDX-License-Identifier: GPL-3.0-or-later
#include "folder.hpp"
#include "study/time_functions.hpp"
#include <gtest/gtest.h>

namespace fretwork::study::time_table_test {
namespace {

signals::Table read_rows(const std::string& text) {
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
  EXPECT_EQ(table, (signals::Table{{0.0, 0.1}, {1.5, 2.0}}));
}

TEST(TimeTable, TakesAJumpAndAMissingHeaderAndLineEnd) {
  EXPECT_EQ(read_rows("0,1\n1,1\n1,-2"), (signals::Table{{0, 1, 1}, {1, 1, -2}}));
}

TEST(TimeTable, TakesOtherSeparatorsDecimalCommasAndARowOfUnits) {
  const signals::Table expected{{0.0, 0.5}, {1.25, -2.0}};
  EXPECT_EQ(read_rows("time,force\ns,N\n0,1.25\n0.5,-2\n"), expected);
  EXPECT_EQ(read_rows("Zeit;Kraft\n[s];[N]\n0,0;1,25\n0,5;-2\n"), expected);
  EXPECT_EQ(read_rows("t\tF\n0\t1.25\n0.5\t-2\n"), expected);
  EXPECT_EQ(read_rows("t F\n  0   1.25 \n0.5 \t-2\n"), expected);
  EXPECT_EQ(read_rows("0; 1.25\n0.5; -2\n"), expected);
}

TEST(TimeTable, IsScaled) {
  const auto function = [](const std::string& keys) {
    return read_text(contact("[[loads]]\ngroup = \"p\"\ndirection = [1, 0, 0]\n" + keys)).loads[0].function;
  };
  EXPECT_EQ(function("table = [[0, 1], [1, -3]]\nscale = 2.5\n"),
            signals::TimeFunction(signals::Table{{0, 1}, {2.5, -7.5}}));
  EXPECT_NE(message_of(contact("[[loads]]\ngroup = \"p\"\ndirection = [1, 0, 0]\nconstant = 1\nscale = 2\n"))
                .find("scale = 2: belongs to a table"),
            std::string::npos);
}

const std::string accelerogram = "PEER NGA STRONG MOTION DATABASE RECORD\nSomewhere, 1/1/2000\n"
                                 "ACCELERATION TIME SERIES IN UNITS OF G\n";

TEST(Accelerogram, IsReadInMetresPerSecondSquared) {
  const Folder folder;
  const auto motion = [&](const std::string& sampling) {
    folder.write("quake.AT2", accelerogram + sampling + "\n .1000E+00 -.2000E+00\n  0.0  1.0 .5\n");
    return read(folder.write(
                    "study.toml",
                    contact("[[base_motion]]\ndirection = [1, 0, 0]\ntable = \"quake.AT2\"\nscale = 2\n")))
        .base_motions[0]
        .acceleration;
  };
  for (const char* sampling : {"NPTS=     5, DT=   .0050 SEC,", "    5    0.0050    NPTS, DT"}) {
    const auto table = std::get<signals::Table>(motion(sampling));
    ASSERT_EQ(table.time.size(), 5u) << sampling;
    EXPECT_DOUBLE_EQ(table.time[4], 0.02);
    EXPECT_DOUBLE_EQ(table.value[1], -2.0 * 0.2 * 9.80665);
    EXPECT_DOUBLE_EQ(table.value[3], 2.0 * 9.80665);
  }
}

TEST(Accelerogram, ThatIsNoneIsRefused) {
  const Folder folder;
  const auto problem = [&](const std::string& text, const char* table) {
    folder.write("q.at2", text);
    try {
      (void)read(folder.write("study.toml",
                              contact(std::string(table) + "direction = [1, 0, 0]\ntable = \"q.at2\"\n")));
    } catch (const core::Error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  const char* base = "[[base_motion]]\n";
  const auto says = [&](const std::string& text, const std::string& expected, const char* table) {
    const std::string found = problem(text, table);
    EXPECT_NE(found.find(expected), std::string::npos) << found;
  };
  says("a\nb\n", "has not the four lines of header", base);
  says("a\nb\nVELOCITY IN CM/S\nNPTS= 1, DT= .1\n1\n", "values IN UNITS OF G are expected", base);
  says(accelerogram + "1 2 3\n1\n", "NPTS and DT are expected", base);
  for (const std::string& points : {std::string(1'000'000, '1'), std::string("1e300"), std::string("-1")})
    says(accelerogram + "NPTS= " + points + ", DT= .1\n1\n", "NPTS and DT are expected", base);
  says(accelerogram + std::string(1'000'000, ' ') + "\n1\n", "NPTS and DT are expected", base);
  says(accelerogram + "NPTS= 3, DT= .1 SEC\n1 2\n", "has 2 values, and its header says 3", base);
  says(accelerogram + "NPTS= 1, DT= .1 SEC\nx\n", "\"x\" is no finite number", base);
  says(accelerogram + "NPTS= 1, DT= .1 SEC\n1\n", "is an accelerogram, and a table in N is expected",
       "[[loads]]\ngroup = \"p\"\n");
}

TEST(TimeTable, RefusesBadRowsWithTheirLine) {
  const std::pair<const char*, const char*> cases[] = {
      {"0,1\n\nt,F\n", "t.csv:3: \"t,F\": a row is two finite numbers, t,value"},
      {"t,F\ns,N\nt,F\n", "t.csv:3: \"t,F\": a row is two finite numbers"},
      {"0 1 2\n", "t.csv:1: \"0 1 2\": a row is two finite numbers"},
      {"0,5,1\n", "t.csv:1: \"0,5,1\": a row is two finite numbers"},
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
  EXPECT_EQ(read(file).loads[0].function, signals::TimeFunction(signals::Table{{0, 2}, {1, 3}}));
}

} // namespace
} // namespace fretwork::study::time_table_test
