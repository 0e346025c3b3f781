// SPDX-License-Identifier: GPL-3.0-or-later
// Against a plain look at all facets, where there are too many for the tests of profiles; and exact ties.
#include "contact/facet_index.hpp"
#include "contact/support_shapes.hpp"
#include "uniform.hpp"
#include <algorithm>
#include <array>
#include <gtest/gtest.h>
#include <limits>

namespace facet_index_test {

using namespace fretwork;
using contact::Facet;
using contact::FacetIndex;
using contact::PlanePoint;

namespace {

constexpr double turn = 2.0 * std::numbers::pi;

std::vector<PlanePoint> polygon(int n, auto radius) {
  std::vector<PlanePoint> vertices;
  for (int k = 0; k < n; ++k) {
    const double angle = turn * k / n, r = radius(angle);
    vertices.push_back({r * std::cos(angle), r * std::sin(angle)});
  }
  return vertices;
}

/// A quatrefoil hole of lands and lobes, facets of very different length, over the tube's room at the lands.
std::vector<PlanePoint> broached() {
  const double t = 9.5e-3, room = 2e-4;
  std::vector<PlanePoint> vertices =
      contact::BroachedSpace(t, {t + room, t + 3e-3, 4, turn / 20.0}).outline(400);
  for (PlanePoint& v : vertices)
    v = {v.y / 3e-3, v.z / 3e-3};
  return vertices;
}

/// Four straight sides of n/4 facets: neighbours in one line, far parts at the same distance.
double square(double angle) { return 1.0 / std::max(std::abs(std::cos(angle)), std::abs(std::sin(angle))); }
double trefoil(double angle) { return 0.7 + 0.4 * std::cos(3.0 * angle); }
/// Two wide lobes with a passage of 0.04 between them: the walls of the passage are rivals.
double waist(double angle) { return 0.02 + std::abs(std::cos(angle)); }
double star(double angle) {
  return 1.0 + 0.2 * std::sin(5.0 * angle + 1.0) + 0.1 * std::sin(23.0 * angle) +
         0.02 * std::sin(211.0 * angle);
}

/// As the index rounds it: exact ties are exact.
double squared_distance(const Facet& f, double y, double z) {
  return contact::distance2(contact::FacetPair(f, f), y, z)[0];
}

/// Of equals the one of lowest number.
void expect_nearest(const FacetIndex& index, double y, double z) {
  std::uint32_t nearest = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::uint32_t k = 0; k < index.size(); ++k)
    if (const double d = squared_distance(index[k], y, z); d < least) {
      least = d;
      nearest = k;
    }
  ASSERT_EQ(index.nearest(y, z), nearest) << y << " " << z;
}

/// Nodes between two of which the nearest facet changes, to the last bit.
void expect_nearest_at_changes(const FacetIndex& index, PlanePoint a, PlanePoint b) {
  const std::uint32_t first = index.nearest(a.y, a.z);
  const auto between = [&] { return PlanePoint{0.5 * (a.y + b.y), 0.5 * (a.z + b.z)}; };
  for (PlanePoint p = between(); (p.y != a.y || p.z != a.z) && (p.y != b.y || p.z != b.z); p = between()) {
    expect_nearest(index, p.y, p.z);
    (index.nearest(p.y, p.z) == first ? a : b) = p;
  }
}

/// Nodes on both sides at all depths, in the middle, and far away.
void expect_nearest_everywhere(const std::vector<PlanePoint>& vertices, std::uint64_t seed) {
  const int nodes = vertices.size() > 10000 ? 100 : 600; // each is held against all facets
  const FacetIndex index(vertices);
  tests::Uniform uniform(seed);
  for (int i = 0; i < nodes; ++i) {
    const auto v =
        vertices[static_cast<std::size_t>(uniform(0.0, 1.0) * static_cast<double>(vertices.size()))];
    const double depth = uniform.scale(1e-6, 1.0), share = i % 2 == 0 ? 1.0 - depth : 1.0 + depth;
    expect_nearest(index, share * v.y, share * v.z);
    expect_nearest(index, uniform(-1.8, 1.8), uniform(-1.8, 1.8));
  }
  for (int i = 0; i < nodes / 60; ++i)
    expect_nearest_at_changes(index, {uniform(-0.9, 0.9), uniform(-0.9, 0.9)},
                              {uniform(-0.9, 0.9), uniform(-0.9, 0.9)});
  for (int i = 0; i < nodes / 10; ++i) {
    const double angle = uniform(0.0, turn), r = i == 0 ? 0.0 : uniform.scale(1e-12, 0.01);
    expect_nearest(index, r * std::cos(angle), r * std::sin(angle));
  }
}

} // namespace

TEST(FacetIndex, LeastOfEightIsTheFirstOfEquals) {
  using contact::Pack;
  const Pack high{7.0, 9.0};
  for (std::uint32_t place = 0; place < 8; ++place)
    for (std::uint32_t equal = place; equal < 8; ++equal) {
      std::array<Pack, 4> values{high, high, high, high};
      values[place / 2][place % 2] = values[equal / 2][equal % 2] = 0.5;
      const contact::Found found = contact::least_of(values[0], values[1], values[2], values[3]);
      EXPECT_EQ(found.number, place);
      EXPECT_EQ(found.value, 0.5);
    }
  const Pack none = Pack{} + std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(contact::least_of(none, none, none, none).number, 0u);
}

TEST(FacetIndex, LeastOfManyIsThatOfLowestNumberOfEquals) {
  using contact::Pack;
  for (const double other : {0.5, 0.25, 1.0})
    for (std::uint32_t first : {0u, 1u})
      for (std::uint32_t second : {2u, 3u}) {
        contact::Least least;
        Pack a{9.0, 9.0}, b = a;
        a[first] = 0.5;
        b[second - 2] = other;
        least.see(a, contact::numbers_from(0));
        least.see(b, contact::numbers_from(2));
        EXPECT_EQ(least.any().number, other < 0.5 ? second : first);
        EXPECT_EQ(least.number(), least.any().number);
        EXPECT_EQ(least.any().value, std::min(other, 0.5));
      }
}

/// A square of facets of one length on a grid: nodes on its axes and diagonals have up to eight as near, to the last bit.
TEST(FacetIndex, FindsTheLowestOfExactTies) {
  for (const int side : {8, 64, 512}) {
    std::vector<PlanePoint> vertices;
    const double step = 2.0 / side;
    for (const auto& [y, z, along_y, along_z] : {std::array{1.0, -1.0, 0.0, 1.0},
                                                 {1.0, 1.0, -1.0, 0.0},
                                                 {-1.0, 1.0, 0.0, -1.0},
                                                 {-1.0, -1.0, 1.0, 0.0}})
      for (int k = 0; k < side; ++k)
        vertices.push_back({y + k * step * along_y, z + k * step * along_z});
    const FacetIndex index(vertices);
    for (int i = -70; i <= 70; ++i) {
      const double at = i / 64.0;
      for (const auto& [y, z] : {std::array{at, at}, {at, -at}, {at, 0.0}, {0.0, at}, {at, 0.5}, {0.5, at}})
        expect_nearest(index, y, z);
    }
  }
}

TEST(FacetIndex, FindsTheNearestOfTenThousandFacets) {
  constexpr int many = 10000;
  expect_nearest_everywhere(polygon(many, [](double) { return 1.0; }), 1);
  expect_nearest_everywhere(polygon(many, square), 2);
  expect_nearest_everywhere(polygon(many, trefoil), 3);
  expect_nearest_everywhere(polygon(many, waist), 4);
  expect_nearest_everywhere(polygon(many, star), 5);
  expect_nearest_everywhere(broached(), 6);
}

TEST(FacetIndex, FindsTheNearestOfSpikesAndOfUnevenFacets) {
  tests::Uniform uniform(7);
  expect_nearest_everywhere(polygon(3000, [&](double) { return uniform(0.9, 1.1); }), 8);
  expect_nearest_everywhere(polygon(3000, [&](double) { return uniform(1.0, 1.0 + 1e-6); }), 9);
  std::vector<PlanePoint> vertices; // facets of length 1e-6 to 0.1
  for (double angle = 0.0; angle < turn; angle += uniform.scale(1e-6, 0.1))
    vertices.push_back({std::cos(angle), std::sin(angle)});
  expect_nearest_everywhere(vertices, 10);
}

TEST(FacetIndex, FindsTheNearestOfIrregularHolesOfAnySize) {
  std::uint64_t seed = 20;
  for (const int n : {1001, 10000, 100000}) {
    tests::Uniform uniform(seed);
    expect_nearest_everywhere(polygon(n, [&](double) { return uniform(0.2, 1.0); }), ++seed); // deep spikes
    double radius = 1.0; // a walk: corners at all scales
    expect_nearest_everywhere(
        polygon(n, [&](double) { return radius *= 1.0 + uniform(-1.0, 1.0) / std::sqrt(n); }), ++seed);
    expect_nearest_everywhere(polygon(n,
                                      [](double angle) { // an ellipse, five times as long as wide
                                        return 1.0 / std::hypot(std::cos(angle), 5.0 * std::sin(angle));
                                      }),
                              ++seed);
  }
}

TEST(FacetIndex, FindsTheNearestNextToCorners) {
  tests::Uniform uniform(31);
  const std::vector<PlanePoint> vertices = polygon(10000, [&](double) { return uniform(0.9, 1.1); });
  const FacetIndex index(vertices);
  for (int i = 0; i < 1000; ++i) {
    const PlanePoint v = vertices[static_cast<std::size_t>(uniform(0.0, 10000.0))];
    const double angle = uniform(0.0, turn), r = i % 10 == 0 ? 0.0 : uniform.scale(1e-15, 1e-3);
    expect_nearest(index, v.y + r * std::cos(angle), v.z + r * std::sin(angle));
  }
}

TEST(FacetIndex, FindsTheNearestForAnyNumberOfFacets) {
  for (int n = 3; n < 80; ++n) // about the numbers at which the search takes over, and spans are not full
    expect_nearest_everywhere(polygon(n, trefoil), static_cast<std::uint64_t>(n));
}

TEST(FacetIndex, TakesNodesThatAreFarOrNoNumber) {
  const FacetIndex index(polygon(1000, trefoil));
  for (const double far : {1e3, 1e9, 1e100, 1e150})
    EXPECT_LE(std::min(index.nearest(far, 0.0), 1000 - index.nearest(far, 0.0)), 1u); // the lobe along y
  EXPECT_LT(index.nearest(std::numeric_limits<double>::quiet_NaN(), 0.0), 1000u);
  EXPECT_LT(index.nearest(0.0, std::numeric_limits<double>::infinity()), 1000u);
}

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

TEST(FacetIndex, FindsTheNearestWhereAllAreNearlyAsNear) {
  constexpr int many = 10000;
  std::vector<PlanePoint> centred = polygon(many, [](double) { return 1.0; }), shifted = centred;
  for (PlanePoint& v : shifted)
    v.y += 0.3;
  const FacetIndex about_the_origin(centred), about_a_point(shifted);
  tests::Uniform uniform(11);
  for (int i = 0; i < 300; ++i) {
    const double angle = uniform(0.0, turn), r = uniform.scale(1e-9, 0.1);
    expect_nearest(about_the_origin, r * std::cos(angle), r * std::sin(angle));
    expect_nearest(about_a_point, 0.3 + r * std::cos(angle), r * std::sin(angle));
  }
}

} // namespace facet_index_test
