// SPDX-License-Identifier: GPL-3.0-or-later
// Rows in files: appended, found in the order of cases, corrupt and foreign ones left out.
#include "core/error.hpp"
#include "core/temporary_directory.hpp"
#include "sweep/shard.hpp"
#include <fstream>
#include <gtest/gtest.h>
#include <string>

namespace fretwork::sweep::shard_test {
namespace {

std::string identity_of(std::int64_t number) { return short_digest(std::to_string(number)); }

Row row(std::int64_t number) {
  return {number, identity_of(number), Outcome::done, {static_cast<double>(number)}};
}

TEST(Shard, RowsOfAllFilesAreFoundInTheOrderOfCases) {
  const core::TemporaryDirectory folder;
  {
    ShardFile one(folder.path() / "1_of_2/rank_0.rows"), two(folder.path() / "2_of_2/rank_0.rows");
    for (const int number : {4, 2, 0})
      one.append(row(number));
    for (const int number : {3, 1, 2, 9})
      two.append(row(number));
  }
  const FoundRows found = read_rows(folder.path(), 5, identity_of);
  ASSERT_EQ(found.rows.size(), 5u);
  for (std::int64_t number = 0; number < 5; ++number)
    EXPECT_EQ(found.rows[static_cast<std::size_t>(number)].values, row(number).values);
  EXPECT_EQ(found.corrupt, 0);
}

TEST(Shard, AHalfLineOfAKilledProcessCostsItsRowOnly) {
  const core::TemporaryDirectory folder;
  const auto path = folder.path() / "rank_0.rows";
  ShardFile(path).append(row(0));
  const std::string half = line_of(row(1)).substr(0, 30);
  std::ofstream(path, std::ios::app) << half;
  ShardFile(path).append(row(2));
  const FoundRows found = read_rows(folder.path(), 3, identity_of);
  ASSERT_EQ(found.rows.size(), 2u);
  EXPECT_EQ(found.rows[1].number, 2);
  EXPECT_EQ(found.corrupt, 1);
}

TEST(Shard, RowsOfOtherInputsAreLeftOut) {
  const core::TemporaryDirectory folder;
  ShardFile(folder.path() / "rank_0.rows").append(row(0));
  const FoundRows found = read_rows(folder.path(), 1, [](std::int64_t) { return short_digest("other"); });
  EXPECT_TRUE(found.rows.empty());
  EXPECT_EQ(found.of_others, 1);
}

TEST(Shard, PartsCoverEveryCaseOnce) {
  for (std::int64_t number = 0; number < 100; ++number) {
    int owners = 0;
    for (int index = 1; index <= 7; ++index)
      owners += Shard{index, 7}.has(number) ? 1 : 0;
    EXPECT_EQ(owners, 1) << number;
  }
}

TEST(Shard, TextIsIOfN) {
  EXPECT_EQ(shard_of("2/8").index, 2);
  EXPECT_EQ(shard_of("2/8").count, 8);
  for (const char* wrong : {"", "2", "0/8", "9/8", "2/", "/8", "2/8x", "2/-1"})
    EXPECT_THROW((void)shard_of(wrong), core::Error) << wrong;
}

} // namespace
} // namespace fretwork::sweep::shard_test
