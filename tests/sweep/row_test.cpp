// SPDX-License-Identifier: GPL-3.0-or-later
// A row reads back bit for bit, and every change of its line is noticed.
#include "sweep/row.hpp"
#include <cmath>
#include <gtest/gtest.h>
#include <limits>

namespace fretwork::sweep::row_test {
namespace {

Row example() {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  return {17, "0123456789abcdef", Outcome::done, {0.1, -1.0 / 3.0, 5e-324, infinity, std::nan(""), 12.0}, ""};
}

std::string without_end(std::string line) {
  line.pop_back();
  return line;
}

TEST(Row, ReadsBackBitForBit) {
  const auto read = row_of(without_end(line_of(example())));
  ASSERT_TRUE(read);
  EXPECT_EQ(read->number, 17);
  EXPECT_EQ(read->identity, "0123456789abcdef");
  ASSERT_EQ(read->values.size(), example().values.size());
  for (std::size_t i = 0; i < read->values.size(); ++i)
    if (!std::isnan(example().values[i])) {
      EXPECT_EQ(read->values[i], example().values[i]) << i;
    }
  EXPECT_TRUE(std::isnan(read->values[4]));
}

TEST(Row, KeepsTheMessageOfAFailureOnOneLine) {
  const std::string line = line_of({3, "0123456789abcdef", Outcome::failed, {}, "two\nlines | and a bar"});
  EXPECT_EQ(line.find('\n'), line.size() - 1);
  const auto read = row_of(without_end(line));
  ASSERT_TRUE(read);
  EXPECT_EQ(read->outcome, Outcome::failed);
  EXPECT_EQ(read->message, "two lines | and a bar");
}

TEST(Row, EveryChangedCharacterIsNoticed) {
  const std::string line = without_end(line_of(example()));
  for (std::size_t i = 0; i < line.size(); ++i) {
    std::string changed = line;
    changed[i] = changed[i] == '1' ? '2' : '1';
    EXPECT_FALSE(row_of(changed)) << i;
    EXPECT_FALSE(row_of(line.substr(0, i))) << i;
  }
}

} // namespace
} // namespace fretwork::sweep::row_test
