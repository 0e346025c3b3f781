// SPDX-License-Identifier: GPL-3.0-or-later
#include "expect_messages.hpp"

namespace fretwork::study::messages_tables_test {
namespace {

TEST(Messages, OfTablesInTime) {
  const std::string table = "table = [[0, 1], [1, 1], [1, 2.5]]";
  expect_messages({
      {table,
       "table = [[1, 1], [0, 1]]",
       {"loads.foot.table[1] = [0, 1]: the time decreases; sort the rows by time"}},
      {table,
       "table = [[1, 1], [1, 2], [1, 3]]",
       {"loads.foot.table[2] = [1, 3]: a third row at the same time"}},
      {table, "table = [1, 2]", {"loads.foot.table[0] = 1: an array of numbers (2 in N m) is expected"}},
      {table,
       "table = [[1, 2, 3]]",
       {"loads.foot.table[0] = [1, 2, 3]: an array of numbers (2 in N m) is expected, not of 3"}},
      {table,
       "table = \"none.csv\"",
       {"loads.foot.table = \"none.csv\": file none.csv does not exist; check the path (relative paths start "
        "from "
        "the study's folder)"}},
      {table,
       "table = \"study.toml\"",
       {"loads.foot.table = \"study.toml\": study.toml:3: ", "a row is two finite numbers, t,value"}},
      {table, "table = \"\"", {"loads.foot.table = \"\": the string is empty"}},
  });
}

TEST(Messages, ShowOnlyTheBeginningOfALongValue) {
  const std::string message =
      message_of("[mesh]\nfile = \"a.msh\"\nscale = \"" + std::string(500, 'x') + "\"\n");
  EXPECT_EQ(message, "study.toml:3: mesh.scale = \"" + std::string(59, 'x') +
                         "...: a number > 0 is expected, not a string");
}

} // namespace
} // namespace fretwork::study::messages_tables_test
