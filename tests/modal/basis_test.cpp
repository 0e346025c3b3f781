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

TEST(Basis, IsFoundByItsNodes) {
  std::vector<fretwork::modal::Basis> bases(2);
  bases[0].nodes = {2, 5, 9};
  bases[1].nodes = {3, 4};
  EXPECT_EQ(structure_of(bases, 9), 0u);
  EXPECT_EQ(structure_of(bases, 3), 1u);
  EXPECT_EQ(structure_of(bases, 6), std::nullopt);
  EXPECT_EQ(structure_of(bases, -1), std::nullopt);
  EXPECT_EQ(fretwork::modal::structure_of({}, 2), std::nullopt);
}

} // namespace basis_test
