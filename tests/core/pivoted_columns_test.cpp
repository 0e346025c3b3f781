// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pivoted_columns.hpp"
#include <cmath>
#include <gtest/gtest.h>

namespace pivoted_columns_test {

using fretwork::core::pivoted_columns;

// The second column is twice the first, the third stands out of their direction by 0.5.
TEST(PivotedColumns, ComeByTheirDistanceFromThoseBeforeThem) {
  constexpr double round_off = 1e-14;
  Eigen::MatrixXd a(4, 3);
  a << 1, 2, 3, 0, 0, 0.5, 0, 0, 0, 0, 0, 0;
  const auto found = pivoted_columns(a);
  EXPECT_EQ(found.order(0), 2); // the longest
  EXPECT_EQ(found.order(1), 1);
  EXPECT_NEAR(std::abs(found.pivots(0)), std::hypot(3.0, 0.5), round_off);
  EXPECT_NEAR(std::abs(found.pivots(1)), 2.0 * 0.5 / std::hypot(3.0, 0.5), round_off);
  EXPECT_NEAR(found.pivots(2), 0.0, round_off);
  ASSERT_EQ(found.q.rows(), 4);
  ASSERT_EQ(found.q.cols(), 4);
  EXPECT_LT((found.q.transpose() * found.q - Eigen::Matrix4d::Identity()).cwiseAbs().maxCoeff(), round_off);
  EXPECT_LT((found.q.rightCols(2).transpose() * a).cwiseAbs().maxCoeff(),
            round_off); // no column has a part there
}

} // namespace pivoted_columns_test
