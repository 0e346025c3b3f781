// SPDX-License-Identifier: GPL-3.0-or-later
// The lists of cells: never without the nearest facet, and short wherever nodes are.
#include "contact/facet_cells.hpp"
#include "uniform.hpp"
#include <algorithm>
#include <gtest/gtest.h>
#include <limits>

using namespace fretwork;
using contact::Facet;
using contact::FacetCells;

namespace {

constexpr double turn = 2.0 * std::numbers::pi;
constexpr double round_off = 1e-15; // of squared distances of order 1
constexpr int many = 10000;

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

/// Mean number of facets to look at, of nodes at any depth; those without a whole list count as all.
double mean_list(const std::vector<Facet>& facets, double outermost) {
  constexpr int nodes = 500;
  const FacetCells cells(facets, outermost);
  tests::Uniform uniform(3);
  double sum = 0.0;
  for (int i = 0; i < nodes; ++i) {
    const Facet& at = facets[static_cast<std::size_t>(uniform(0.0, 1.0) * many)];
    const double share = uniform(0.0, 1.1), y = share * at.ay, z = share * at.az;
    const FacetCells::Few few = cells.near(y, z);
    double least = std::numeric_limits<double>::infinity(), least_listed = least;
    for (const Facet& f : facets)
      least = std::min(least, distance2(f, y, z));
    for (const auto [first, end] : few.runs)
      for (std::uint32_t k = first; k < end; ++k)
        least_listed = std::min(least_listed, distance2(facets[k], y, z));
    if (few.all) {
      EXPECT_LE(least_listed, least + round_off) << y << " " << z;
      for (const auto [first, end] : few.runs)
        sum += static_cast<double>(end - first) / nodes;
    } else {
      sum += static_cast<double>(many) / nodes;
    }
  }
  return sum;
}

constexpr double few = 40.0; // facets: a short list, gaps filled, and one node in a thousand without a list

} // namespace

TEST(FacetCells, ListTheNearestOfARoundHoleAndFewMore) {
  EXPECT_LT(mean_list(polygon([](double) { return 1.0; }), std::numbers::sqrt2), few);
}

TEST(FacetCells, ListTheNearestOfASmoothHoleAndFewMore) {
  EXPECT_LT(mean_list(polygon([](double angle) { return 0.7 + 0.4 * std::cos(3.0 * angle); }), 1.4), few);
}

TEST(FacetCells, ListTheNearestOfSpikesAndFewMore) {
  tests::Uniform uniform(7);
  EXPECT_LT(mean_list(polygon([&](double) { return uniform(0.9, 1.1); }), 1.6), few);
}

TEST(FacetCells, TellWhereTheyKnowNotAll) {
  const FacetCells cells(polygon([](double) { return 1.0; }), std::numbers::sqrt2);
  EXPECT_FALSE(cells.near(0.0, 0.0).all);
  EXPECT_FALSE(cells.near(1e9, 0.0).all);
  EXPECT_FALSE(cells.near(std::numeric_limits<double>::quiet_NaN(), 0.0).all);
  EXPECT_FALSE(cells.near(0.0, 0.0).runs.empty());
}
