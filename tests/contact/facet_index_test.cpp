// SPDX-License-Identifier: GPL-3.0-or-later
// The nearest facet itself is tested through the gaps and normals of profiles; here: exact ties.
#include "contact/facet_index.hpp"
#include <gtest/gtest.h>

using namespace fretwork;
using contact::FacetIndex;
using contact::PlanePoint;

TEST(FacetIndex, LowestOfEquallyNearFacetsCounts) {
  // a square of 4 x 64 facets whose coordinates, and so all distances of these nodes, are exact
  std::vector<PlanePoint> vertices;
  const PlanePoint corners[] = {{1, -1}, {1, 1}, {-1, 1}, {-1, -1}, {1, -1}};
  for (int side = 0; side < 4; ++side)
    for (int k = 0; k < 64; ++k)
      vertices.push_back({corners[side].y + k * (corners[side + 1].y - corners[side].y) / 64,
                          corners[side].z + k * (corners[side + 1].z - corners[side].z) / 64});
  const FacetIndex index(vertices);
  EXPECT_EQ(index.nearest(0.0, 0.0), 31u); // the middle of the first side, where facets 31 and 32 meet
  EXPECT_EQ(index.nearest(-0.5, 0.5), 64u + 47u);
  EXPECT_EQ(index.nearest(-0.5, -0.5), 128u + 47u);
  EXPECT_EQ(index.nearest(0.5, -0.5), 15u); // before its equal of the last side
  EXPECT_EQ(index.nearest(3.0, -3.0), 0u);  // the corner of the first and the last facet
}
