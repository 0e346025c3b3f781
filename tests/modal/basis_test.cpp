// SPDX-License-Identifier: GPL-3.0-or-later
#include "modal/basis.hpp"
#include <gtest/gtest.h>

namespace basis_test {

TEST(Basis, FindsTheRowsOfItsNodes) {
  fretwork::modal::Basis basis;
  basis.nodes = {2, 5, 9};
  EXPECT_EQ(basis.row_of(2), 0);
  EXPECT_EQ(basis.row_of(9), 12);
  EXPECT_EQ(basis.row_of(3), -1);
  EXPECT_EQ(basis.row_of(10), -1);
}

} // namespace basis_test
