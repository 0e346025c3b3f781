// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/facet_index.hpp"
#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace fretwork::contact {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr std::uint32_t scan_limit = 16;   // facets: a scan is then as fast as any search
constexpr double round_off = 1e-13;        // of the polygon's width: above what rounding does to a distance
constexpr double nearly_one = 1.0 - 1e-14; // of nodes far away rounding moves all distances
constexpr std::uint32_t full_span = 3;     // a span of level l has 2^(3 + 2 l) facets

constexpr std::uint32_t pack_size = 2; // what every processor of the kind has
typedef double Pack __attribute__((vector_size(pack_size * sizeof(double))));

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

FacetIndex::FacetIndex(std::span<const PlanePoint> vertices) {
  facets_.reserve(vertices.size());
  for (std::size_t k = 0; k < vertices.size(); ++k)
    facets_.push_back(facet_between(vertices[k], vertices[(k + 1) % vertices.size()]));
  constexpr double far = 1e300; // m: squared, beyond all numbers
  const Facet none{far, far, 1.0, 0.0, 0.0};
  for (std::size_t k = 0; k < facets_.size() + pack_size; ++k) {
    const Facet& f = k < facets_.size() ? facets_[k] : none;
    const double values[] = {f.ay, f.az, f.uy, f.uz, f.length};
    for (std::size_t i = 0; i < lanes_.size(); ++i)
      lanes_[i].push_back(values[i]);
  }
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
  cells_ = FacetCells(facets_, outermost);
}

void FacetIndex::build_boxes(std::span<const PlanePoint> vertices, double rounding) {
  const std::uint32_t n = size();
  for (std::uint32_t bits = full_span; (1u << bits) < n; bits += 2) {
    std::vector<Box>& level = boxes_.emplace_back();
    for (std::uint32_t first = 0; first < n; first += 1u << bits)
      level.push_back(box_round(vertices, first, std::min(first + (1u << bits), n), rounding));
  }
}

/// Of equals the one of lowest number: distance2 of a pack of facets at once: a run may look at some facets more.
FacetIndex::Best FacetIndex::nearest_of(std::span<const FacetCells::Run> runs, double y, double z) const {
  Pack least = Pack{} + infinity, number{};
  for (const FacetCells::Run run : runs) {
    Pack k = static_cast<double>(run.first) + Pack{0.0, 1.0};
    for (std::uint32_t i = run.first; i < run.end; i += pack_size, k += pack_size) {
      Pack ay, az, uy, uz, length; // runs begin anywhere: not aligned
      std::memcpy(&ay, &lanes_[0][i], sizeof ay);
      std::memcpy(&az, &lanes_[1][i], sizeof az);
      std::memcpy(&uy, &lanes_[2][i], sizeof uy);
      std::memcpy(&uz, &lanes_[3][i], sizeof uz);
      std::memcpy(&length, &lanes_[4][i], sizeof length);
      const Pack wy = y - ay, wz = z - az, inner = wy * uy + wz * uz;
      const Pack after = inner > 0.0 ? inner : Pack{}, along = after < length ? after : length;
      const Pack ry = wy - along * uy, rz = wz - along * uz, d2 = ry * ry + rz * rz;
      number = d2 < least ? k : number;
      least = d2 < least ? d2 : least;
    }
  }
  std::size_t lane = 0;
  for (std::size_t i = 1; i < pack_size; ++i)
    if (least[i] < least[lane] || (least[i] == least[lane] && number[i] < number[lane]))
      lane = i;
  return {least[lane], static_cast<std::uint32_t>(number[lane])};
}

/// Replaces `best` by the nearest facet of all, or one of lower number as near.
void FacetIndex::search(double y, double z, Best& best) const {
  best.distance2 = std::nextafter(best.distance2, infinity);
  std::uint32_t k = 0;
  std::size_t level = boxes_.size() - 1;
  while (k < size()) {
    if (nearly_one * distance2(boxes_[level][k >> span_bits(level)], y, z) < best.distance2) {
      if (level > 0) {
        --level;
        continue;
      }
      for (std::uint32_t j = k; j < std::min(k + (1u << full_span), size()); ++j)
        if (const double d2 = distance2(facets_[j], y, z); d2 < best.distance2)
          best = {d2, j};
    }
    k += 1u << span_bits(level);
    while (level + 1 < boxes_.size() && (k & ((1u << span_bits(level + 1)) - 1u)) == 0)
      ++level;
  }
}

std::uint32_t FacetIndex::nearest(double y, double z) const {
  if (size() <= scan_limit) {
    const FacetCells::Run all{0, size()};
    return nearest_of({&all, 1}, y, z).facet;
  }
  const FacetCells::Few few = cells_.near(y, z);
  Best best = nearest_of(few.runs, y, z);
  if (!few.all)
    search(y, z, best);
  return best.facet;
}

} // namespace fretwork::contact
