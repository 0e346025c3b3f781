// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/facet_index.hpp"
#include <algorithm>
#include <cmath>

namespace fretwork::contact {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr std::uint32_t scan_limit = 16;   // facets: a scan is then as fast as any search
constexpr double round_off = 1e-13;        // of the polygon's width: above what rounding does to a distance
constexpr double nearly_one = 1.0 - 1e-14; // of nodes far away rounding moves all distances
constexpr std::uint32_t full_span = 3;     // a span of level l has 2^(3 + 2 l) facets

std::uint32_t span_bits(std::size_t level) { return full_span + 2 * static_cast<std::uint32_t>(level); }

Facet facet_between(PlanePoint a, PlanePoint b) {
  const double y = b.y - a.y, z = b.z - a.z, length = std::sqrt(y * y + z * z);
  return {a.y, a.z, y / length, z / length, length};
}

inline double distance2(const FacetIndex::Box& b, double y, double z) {
  const double wy = y - b.y, wz = z - b.z;
  const double along = std::max(0.0, std::abs(wy * b.uy + wz * b.uz) - b.along);
  const double across = std::max(0.0, std::abs(wz * b.uy - wy * b.uz) - b.across);
  return along * along + across * across;
}

/// Along the principal axes of the vertices of facets first to end, `rounding` wider on all sides.
FacetIndex::Box box_round(std::span<const PlanePoint> vertices, std::uint32_t first, std::uint32_t end,
                          double rounding) {
  const auto vertex = [&](std::uint32_t k) { return vertices[k == vertices.size() ? 0 : k]; };
  const double number = end - first + 1.0;
  PlanePoint mean{0.0, 0.0};
  for (std::uint32_t k = first; k <= end; ++k)
    mean = {mean.y + vertex(k).y / number, mean.z + vertex(k).z / number};
  double yy = 0.0, yz = 0.0, zz = 0.0;
  for (std::uint32_t k = first; k <= end; ++k) {
    const double y = vertex(k).y - mean.y, z = vertex(k).z - mean.z;
    yy += y * y, yz += y * z, zz += z * z;
  }
  const double angle = 0.5 * std::atan2(2.0 * yz, yy - zz), c = std::cos(angle), s = std::sin(angle);
  PlanePoint low{infinity, infinity}, high{-infinity, -infinity};
  for (std::uint32_t k = first; k <= end; ++k) {
    const double along = c * vertex(k).y + s * vertex(k).z, across = c * vertex(k).z - s * vertex(k).y;
    low = {std::min(low.y, along), std::min(low.z, across)};
    high = {std::max(high.y, along), std::max(high.z, across)};
  }
  const double along = 0.5 * (low.y + high.y), across = 0.5 * (low.z + high.z);
  return {c * along - s * across,           s * along + c * across, c, s, 0.5 * (high.y - low.y) + rounding,
          0.5 * (high.z - low.z) + rounding};
}

} // namespace

FacetIndex::FacetIndex(std::span<const PlanePoint> vertices)
    : size_(static_cast<std::uint32_t>(vertices.size())) {
  std::vector<Facet> facets;
  facets.reserve(size_ + 1);
  for (std::size_t k = 0; k < vertices.size(); ++k)
    facets.push_back(facet_between(vertices[k], vertices[(k + 1) % vertices.size()]));
  constexpr double far = 1e300;                // m: squared, beyond all numbers
  facets.push_back({far, far, 1.0, 0.0, 0.0}); // to fill up the last pair
  for (std::uint32_t k = 0; k < size_; k += 2)
    pairs_.emplace_back(facets[k], facets[k + 1]);
  facets.pop_back();
  if (size() <= scan_limit)
    return;
  PlanePoint low = vertices[0], high = vertices[0];
  double outermost = 0.0;
  for (const PlanePoint& v : vertices) {
    low = {std::min(low.y, v.y), std::min(low.z, v.z)};
    high = {std::max(high.y, v.y), std::max(high.z, v.z)};
    outermost = std::max(outermost, std::abs(v.y) + std::abs(v.z));
  }
  build_boxes(vertices, round_off * std::max(high.y - low.y, high.z - low.z));
  cells_ = FacetCells(pairs_, outermost);
}

void FacetIndex::build_boxes(std::span<const PlanePoint> vertices, double rounding) {
  const std::uint32_t n = size();
  for (std::uint32_t bits = full_span; (1u << bits) < n; bits += 2) {
    std::vector<Box>& level = boxes_.emplace_back();
    for (std::uint32_t first = 0; first < n; first += 1u << bits)
      level.push_back(box_round(vertices, first, std::min(first + (1u << bits), n), rounding));
  }
}

/// By pairs: it may be at one facet more on both sides.
void FacetIndex::look_at(std::uint32_t first, std::uint32_t end, double y, double z, Least& distances) const {
  end = (end + 1) / 2;
  Pack numbers = numbers_from(first / 2 * 2);
  for (std::uint32_t i = first / 2; i < end; ++i, numbers += 2.0)
    distances.see(distance2(pairs_[i], y, z), numbers);
}

/// Squared distances of the nearest and its like; at least one of all is within the bound, m^2.
Least FacetIndex::search(double y, double z, double bound) const {
  Least distances;
  std::uint32_t k = 0;
  std::size_t level = boxes_.size() - 1;
  while (k < size()) {
    if (nearly_one * distance2(boxes_[level][k >> span_bits(level)], y, z) <= bound) {
      if (level > 0) {
        --level;
        continue;
      }
      look_at(k, std::min(k + (1u << full_span), size()), y, z, distances);
      bound = std::min(bound, distances.value());
    }
    k += 1u << span_bits(level);
    while (level + 1 < boxes_.size() && (k & ((1u << span_bits(level + 1)) - 1u)) == 0)
      ++level;
  }
  return distances;
}

std::uint32_t FacetIndex::nearest(double y, double z) const {
  Least distances;
  if (size() <= scan_limit) {
    look_at(0, size(), y, z, distances);
    return distances.number();
  }
  return nearest_in_cells(y, z);
}

std::uint32_t FacetIndex::nearest_in_cells(double y, double z) const {
  static_assert(FacetCells::few == 4);
  const FacetCells::Few few = cells_.near(y, z);
  const std::span<const std::uint32_t> list = few.pairs;
  const auto distances = [&](std::size_t k) { return distance2(pairs_[list[k]], y, z); };
  Found nearest =
      least_of(distances(0), distances(1), distances(2), distances(3)); // most lists are not longer
  if (list.size() > FacetCells::few) {
    Least others;
    Pack numbers = numbers_from(2 * FacetCells::few);
    for (std::size_t k = FacetCells::few; k < list.size(); ++k, numbers += 2.0)
      others.see(distances(k), numbers);
    const Found other = others.any();
    nearest.number = other.value < nearest.value ? other.number : nearest.number;
    nearest.value = std::min(nearest.value, other.value);
  }
  if (!few.known)
    return search(y, z, nearest.value).number();
  return 2 * list[nearest.number / 2] + nearest.number % 2;
}

} // namespace fretwork::contact
