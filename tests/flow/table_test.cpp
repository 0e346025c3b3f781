// SPDX-License-Identifier: GPL-3.0-or-later
#include "../fem/expect_error.hpp"
#include "flow/table.hpp"
#include <cmath>
#include <limits>

namespace fretwork::flow::table_test {
namespace {

constexpr double unbounded = std::numeric_limits<double>::infinity();

TEST(FlowTable, IsLinearBetweenRowsAndHeldBeyond) {
  const Table<double> table{{1.0, 2.0, 4.0}, {10.0, 20.0, 0.0}};
  EXPECT_EQ(table.at(1.0), 10.0);
  EXPECT_EQ(table.at(1.25), 12.5);
  EXPECT_EQ(table.at(2.0), 20.0);
  EXPECT_EQ(table.at(3.5), 5.0);
  EXPECT_EQ(table.at(4.0), 0.0);
  EXPECT_EQ(table.at(0.0), 10.0);
  EXPECT_EQ(table.at(9.0), 0.0);
  EXPECT_EQ(Table<double>::constant(3.0).at(-7.0), 3.0);
  const Table<core::Vec3> vectors{{0.0, 1.0}, {core::Vec3(1, 0, 0), core::Vec3(0, 2, 0)}};
  EXPECT_EQ(vectors.at(0.5), core::Vec3(0.5, 1.0, 0.0));
}

TEST(FlowTable, NamesTheRowThatIsWrong) {
  const auto check = [](Table<double> table) {
    return [table] { check_values(table, 0.0, 1.0, "zone \"a\": alpha"); };
  };
  tests::expect_error(check({{}, {}}), {"zone \"a\": alpha: 0 positions and 0 values", "at least one row"});
  tests::expect_error(check({{0.0, 1.0}, {1.0}}), {"2 positions and 1 values"});
  tests::expect_error(check({{0.0, 1.0, 1.0}, {0, 0, 0}}),
                      {"row 3 at s = 1 m does not come after row 2 at 1 m", "sort"});
  tests::expect_error(check({{0.0, std::nan("")}, {0, 0}}), {"row 2 has s = nan"});
  tests::expect_error(check({{0.0, 1.0}, {0, 1.5}}), {"row 2 at s = 1 m has the value 1.5", "from 0 to 1"});
  tests::expect_error(
      [] {
        check_values(Table<double>{{0.0}, {-1.0}}, 0.0, unbounded, "x");
      },
      {"value -1", ">= 0"});
  tests::expect_error(
      [] {
        check_values(Table<core::Vec3>{{0.0}, {core::Vec3(0, std::nan(""), 0)}}, "u");
      },
      {"u: row 1 at s = 0 m is not finite", "three components"});
}

} // namespace
} // namespace fretwork::flow::table_test
