// SPDX-License-Identifier: GPL-3.0-or-later
// The lists of cells: never without the nearest facet, and short wherever nodes are.
#include "contact/facet_cells.hpp"
#include "uniform.hpp"
#include <algorithm>
#include <gtest/gtest.h>
#include <limits>

namespace facet_cells_test {

using namespace fretwork;
using contact::Facet;
using contact::FacetCells;

namespace {

constexpr double turn = 2.0 * std::numbers::pi;
constexpr double round_off = 1e-15; // of squared distances of order 1
constexpr int many = 10000;

double squared_distance(const Facet& f, double y, double z) {
  const contact::PlanePoint p = foot(f, y, z);
  return (y - p.y) * (y - p.y) + (z - p.z) * (z - p.z);
}

std::vector<Facet> polygon(auto radius) {
  std::vector<Facet> facets;
  std::vector<contact::PlanePoint> v;
  for (int k = 0; k < many; ++k) {
    const double angle = turn * k / many, r = radius(angle);
    v.push_back({r * std::cos(angle), r * std::sin(angle)});
  }
  for (std::size_t k = 0; k < v.size(); ++k) {
    const auto a = v[k], b = v[(k + 1) % v.size()];
    const double y = b.y - a.y, z = b.z - a.z, length = std::sqrt(y * y + z * z);
    facets.push_back({a.y, a.z, y / length, z / length, length});
  }
  return facets;
}

FacetCells cells_of(const std::vector<Facet>& facets, double outermost) {
  std::vector<contact::FacetPair> pairs;
  for (std::size_t k = 0; k < facets.size(); k += 2)
    pairs.emplace_back(facets[k], facets[k + 1]);
  return {pairs, outermost};
}

void expect_nearest_listed(const std::vector<Facet>& facets, const FacetCells::Few& few, double y, double z) {
  double least = std::numeric_limits<double>::infinity(), least_listed = least;
  for (const Facet& f : facets)
    least = std::min(least, squared_distance(f, y, z));
  for (const std::uint32_t pair : few.pairs)
    for (std::size_t k = 2 * pair; k < 2 * pair + 2; ++k)
      least_listed = std::min(least_listed, squared_distance(facets[k], y, z));
  EXPECT_LE(least_listed, least + round_off) << y << " " << z;
}

contact::PlanePoint at_any_depth(const Facet& at, tests::Uniform& uniform) {
  const double share = uniform(0.0, 1.1);
  return {share * at.ay, share * at.az};
}

contact::PlanePoint next_to_the_wall(const Facet& at, tests::Uniform& uniform) {
  const double along = uniform(0.0, at.length), share = uniform(0.99, 1.01);
  return {share * (at.ay + along * at.uy), share * (at.az + along * at.uz)};
}

/// Mean number of facets to look at, of nodes somewhere; where the nearest may be any facet all count.
double mean_list(const std::vector<Facet>& facets, double outermost, auto node) {
  constexpr int nodes = 500;
  const FacetCells cells = cells_of(facets, outermost);
  tests::Uniform uniform(3);
  double sum = 0.0;
  for (int i = 0; i < nodes; ++i) {
    const Facet& at = facets[static_cast<std::size_t>(uniform(0.0, 1.0) * many)];
    const auto [y, z] = node(at, uniform);
    const FacetCells::Few few = cells.near(y, z);
    if (few.known) {
      expect_nearest_listed(facets, few, y, z);
      sum += 2.0 * static_cast<double>(few.pairs.size()) / nodes;
    } else {
      sum += static_cast<double>(many) / nodes;
    }
  }
  return sum;
}

double mean_list(const std::vector<Facet>& facets, double outermost) {
  return mean_list(facets, outermost, at_any_depth);
}

constexpr double short_list =
    13.0; // facets: a short list, now and then a longer one, and the long lists of the middle

} // namespace

TEST(FacetCells, ListTheNearestOfARoundHoleAndFewMore) {
  EXPECT_LT(mean_list(polygon([](double) { return 1.0; }), std::numbers::sqrt2), short_list);
}

TEST(FacetCells, ListTheNearestOfASmoothHoleAndFewMore) {
  EXPECT_LT(mean_list(polygon([](double angle) { return 0.7 + 0.4 * std::cos(3.0 * angle); }), 1.4),
            short_list);
}

TEST(FacetCells, ListTheNearestOfSpikesAndFewMore) {
  tests::Uniform uniform(7);
  EXPECT_LT(mean_list(polygon([&](double) { return uniform(0.9, 1.1); }), 1.6), short_list);
}

TEST(FacetCells, ListTheNearestOfDeepSpikesAndFewMore) {
  tests::Uniform uniform(9); // flanks face each other at no distance: what no single point of one can tell
  EXPECT_LT(mean_list(polygon([&](double) { return uniform(0.1, 1.0); }), 1.4), short_list);
}

TEST(FacetCells, ListFewNextToUnevenWalls) {
  // cells that are long and narrow among spikes, and small ones of a wall that is thin for the cells it is in
  tests::Uniform uniform(11);
  EXPECT_LT(mean_list(polygon([&](double) { return uniform(0.9, 1.1); }), 1.6, next_to_the_wall), short_list);
  double radius = 1.0;
  EXPECT_LT(mean_list(polygon([&](double) { return radius *= 1.0 + uniform(-0.005, 0.005); }), 3.0,
                      next_to_the_wall),
            short_list);
}

TEST(FacetCells, ListTheNearestOffTheOriginAndFewMore) {
  EXPECT_LT(mean_list(polygon([](double angle) { // round, about a point 0.3 away
                        return std::sqrt(1.0 - std::pow(0.3 * std::sin(angle), 2)) - 0.3 * std::cos(angle);
                      }),
                      1.7),
            short_list);
}

TEST(FacetCells, ListTheNearestOnTheirBorders) {
  tests::Uniform uniform(5);
  const std::vector<Facet> facets = polygon([&](double) { return uniform(0.9, 1.1); });
  constexpr double outermost = 1.6,
                   reach = 1.5 * outermost; // of the cells: borders are at parts of it by powers of two
  const FacetCells cells = cells_of(facets, outermost);
  for (int i = 0; i < 400; ++i) {
    const double parts = std::ldexp(1.0, 2 + i % 9);
    const double t = std::floor(uniform(0.0, parts + 1.0)) / parts,
                 m = reach * std::floor(uniform(1.0, parts)) / parts;
    const double y = (i % 2 ? -m : m) * (1.0 - t), z = (i % 4 < 2 ? -m : m) * t;
    const FacetCells::Few few = cells.near(y, z);
    ASSERT_TRUE(few.known) << y << " " << z;
    expect_nearest_listed(facets, few, y, z);
  }
}

TEST(FacetCells, TellWhereTheyKnowNotAll) {
  const FacetCells cells = cells_of(polygon([](double) { return 1.0; }), std::numbers::sqrt2);
  EXPECT_FALSE(cells.near(0.0, 0.0).known);
  EXPECT_FALSE(cells.near(1e9, 0.0).known);
  EXPECT_FALSE(cells.near(std::numeric_limits<double>::quiet_NaN(), 0.0).known);
  constexpr double infinite = std::numeric_limits<double>::infinity();
  for (const double y : {0.0, -0.0, 1e9, infinite, -infinite, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_FALSE(cells.near(y, 0.0).pairs.empty()) << y;
    EXPECT_FALSE(cells.near(y, infinite).pairs.empty()) << y;
  }
}

} // namespace facet_cells_test
