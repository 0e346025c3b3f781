// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/facet_index.hpp"
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace fretwork::contact {

namespace {

constexpr std::uint32_t scan_limit = 8; // facets: a scan is then as fast as any search
constexpr int levels = 10;              // of cells: the smallest is the square over 4^10
constexpr std::uint32_t columns = 1u << (2 * levels);
constexpr double shell = 3.0;          // in widths of a cell: how near to the boundary it must be to be split
constexpr double surround = 0.25;      // of the polygon's width: what the square has to spare on each side
constexpr double round_off = 1e-13;    // of the square's side: above what rounding does to a distance
constexpr std::uint32_t full_span = 3; // a span of level l has 2^(3 + 2 l) facets

std::uint32_t span_bits(std::size_t level) { return full_span + 2 * static_cast<std::uint32_t>(level); }

Facet facet_between(PlanePoint a, PlanePoint b) {
  const double y = b.y - a.y, z = b.z - a.z, length = std::sqrt(y * y + z * z);
  return length > 0.0 ? Facet{a.y, a.z, y / length, z / length, length} : Facet{a.y, a.z, 1.0, 0.0, 0.0};
}

/// From the nearest point of the facet to (y, z).
inline PlanePoint arm(const Facet& f, double y, double z) {
  const double wy = y - f.ay, wz = z - f.az;
  const double along = std::min(std::max(wy * f.uy + wz * f.uz, 0.0), f.length);
  return {wy - along * f.uy, wz - along * f.uz};
}

inline double distance2(const Facet& f, double y, double z) {
  const PlanePoint w = arm(f, y, z);
  return w.y * w.y + w.z * w.z;
}

/// Column (or row) of a coordinate: the border's for what lies beyond it, 0 for NaN.
std::uint32_t column_of(double x) {
  return x >= columns ? columns - 1 : x > 0.0 ? static_cast<std::uint32_t>(x) : 0u;
}

/// The shortest cyclic range of n facets that holds all that are kept; kept[i] is facet first + i.
std::array<std::uint32_t, 2> hull(const std::vector<char>& kept, std::uint32_t first, std::uint32_t n) {
  const auto count = static_cast<std::uint32_t>(kept.size());
  const auto from = static_cast<std::uint32_t>(std::find(kept.begin(), kept.end(), 1) - kept.begin());
  std::uint32_t start = from, last = from, widest = 0;
  for (std::uint32_t i = from + 1; i < count; ++i)
    if (kept[i]) {
      if (i - last > widest) {
        widest = i - last;
        start = i;
      }
      last = i;
    }
  const std::uint32_t around =
      n - last + from; // the gap across the ends, closed up when the range was the whole polygon
  if (count < n || around >= widest)
    return {(first + from) % n, last - from + 1};
  return {(first + start) % n, n - widest + 1};
}

} // namespace

FacetIndex::FacetIndex(std::span<const PlanePoint> vertices) {
  facets_.reserve(vertices.size());
  for (std::size_t k = 0; k < vertices.size(); ++k)
    facets_.push_back(facet_between(vertices[k], vertices[(k + 1) % vertices.size()]));
  PlanePoint low = vertices[0], high = vertices[0];
  for (const PlanePoint& v : vertices) {
    low = {std::min(low.y, v.y), std::min(low.z, v.z)};
    high = {std::max(high.y, v.y), std::max(high.z, v.z)};
  }
  side_ = (1.0 + 2.0 * surround) * std::max(high.y - low.y, high.z - low.z);
  corner_ = {0.5 * (low.y + high.y - side_), 0.5 * (low.z + high.z - side_)};
  columns_per_metre_ = columns / side_;
  build_capsules(vertices);
  build_cells();
}

void FacetIndex::build_capsules(std::span<const PlanePoint> vertices) {
  const std::uint32_t n = size();
  for (std::uint32_t bits = full_span; (1u << bits) < n; bits += 2) {
    std::vector<Capsule>& level = capsules_.emplace_back();
    for (std::uint32_t first = 0; first < n; first += 1u << bits) {
      const std::uint32_t end = std::min(first + (1u << bits), n);
      Capsule capsule{facet_between(vertices[first], vertices[end % n]), 0.0};
      for (std::uint32_t k = first + 1; k < end; ++k)
        capsule.radius = std::max(capsule.radius, distance2(capsule.chord, vertices[k].y, vertices[k].z));
      capsule.radius = std::sqrt(capsule.radius) + round_off * side_;
      level.push_back(capsule);
    }
  }
}

void FacetIndex::build_cells() {
  struct Pending {
    std::uint32_t cell;
    PlanePoint middle;
    double half; ///< m, half the width of the cell
  };
  const PlanePoint middle{corner_.y + 0.5 * side_, corner_.z + 0.5 * side_};
  cells_.push_back({0, size(), 0});
  std::vector<Pending> level{{0, middle, 0.5 * side_}}, next;
  for (int depth = 0; depth < levels && !level.empty(); ++depth, level.swap(next), next.clear())
    for (const Pending& pending : level) {
      const Cell parent = cells_[pending.cell];
      const double half = 0.25 * pending.half;
      const Facet& guess = facets_[parent.guess];
      const double deepest = shell * 2.0 * pending.half;
      const bool far = depth > 0 && distance2(guess, pending.middle.y, pending.middle.z) > deepest * deepest;
      if (parent.count <= scan_limit || far)
        continue;
      cells_[pending.cell] = {static_cast<std::uint32_t>(cells_.size()), 0, parent.guess};
      for (int child = 0; child < 16; ++child) {
        const PlanePoint at{pending.middle.y + half * (2 * (child & 3) - 3),
                            pending.middle.z + half * (2 * (child >> 2) - 3)};
        next.push_back({static_cast<std::uint32_t>(cells_.size()), at, half});
        cells_.push_back(candidates(parent, at, half));
      }
    }
}

FacetIndex::Cell FacetIndex::candidates(const Cell& parent, PlanePoint middle, double half) const {
  half += round_off * side_; // a point may be put into the neighbouring cell by rounding
  const std::array<PlanePoint, 4> corners{{{-half, -half}, {half, -half}, {-half, half}, {half, half}}};
  std::array<std::uint32_t, 5> rivals;
  for (std::size_t i = 0; i < 4; ++i)
    rivals[i] = nearest_in(parent, middle.y + corners[i].y, middle.z + corners[i].z);
  rivals[4] = nearest_in(parent, middle.y, middle.z);
  std::array<std::array<double, 4>, 5> reached; // distance of corner i to rival g
  for (std::size_t g = 0; g < 5; ++g)
    for (std::size_t i = 0; i < 4; ++i)
      reached[g][i] =
          std::sqrt(distance2(facets_[rivals[g]], middle.y + corners[i].y, middle.z + corners[i].z)) +
          round_off * side_;

  const double depth = std::sqrt(distance2(facets_[rivals[4]], middle.y, middle.z));
  const double out_of_reach = depth + 2.0 * (std::numbers::sqrt2 * half + round_off * side_);
  std::vector<char> kept(parent.count, 0);
  for (std::uint32_t k = 0; k < parent.count; ++k) {
    const std::uint32_t facet = parent.first + k < size() ? parent.first + k : parent.first + k - size();
    const PlanePoint w = arm(facets_[facet], middle.y, middle.z);
    const double d2 = w.y * w.y + w.z * w.z;
    if (d2 > out_of_reach * out_of_reach)
      continue;
    if (!(d2 > 0.0)) {
      kept[k] = 1;
      continue;
    }
    const double distance = std::sqrt(d2);
    std::array<double, 4> bound;
    for (std::size_t i = 0; i < 4; ++i)
      bound[i] = distance + (w.y * corners[i].y + w.z * corners[i].z) / distance;
    kept[k] = std::none_of(reached.begin(), reached.end(), [&](const auto& r) {
      return r[0] < bound[0] && r[1] < bound[1] && r[2] < bound[2] && r[3] < bound[3];
    });
  }
  const auto [first, count] = hull(kept, parent.first, size());
  return {first, count, rivals[4]};
}

inline std::uint32_t FacetIndex::cell_of(std::uint32_t column, std::uint32_t row) const {
  std::uint32_t cell = 0;
  for (int shift = 2 * levels - 2; cells_[cell].count == 0; shift -= 2)
    cell = cells_[cell].first + ((column >> shift) & 3u) + 4u * ((row >> shift) & 3u);
  return cell;
}

inline void FacetIndex::scan(std::uint32_t first, std::uint32_t end, double y, double z, Best& best) const {
  for (std::uint32_t k = first; k < end; ++k) {
    const double d2 = distance2(facets_[k], y, z);
    if (d2 < best.distance2 || (d2 == best.distance2 && k < best.facet))
      best = {d2, k};
  }
}

/// Facets first to end, and some before and after them: spans are passed over or opened as a whole.
void FacetIndex::search(std::uint32_t first, std::uint32_t end, double y, double z, Best& best) const {
  std::uint32_t k = first & ~((1u << full_span) - 1u);
  std::size_t level = 0;
  double reach = std::sqrt(best.distance2);
  bool moved = true;
  while (k < end) {
    while (moved && level + 1 < capsules_.size() && (k & ((1u << span_bits(level + 1)) - 1u)) == 0)
      ++level;
    const Capsule& capsule = capsules_[level][k >> span_bits(level)];
    const double near = reach + capsule.radius;
    moved = distance2(capsule.chord, y, z) > near * near;
    if (!moved && level > 0) {
      --level;
      continue;
    }
    if (!moved) {
      scan(k, std::min(k + (1u << full_span), size()), y, z, best);
      reach = std::sqrt(best.distance2);
      moved = true;
    }
    k += 1u << span_bits(level);
  }
}

std::uint32_t FacetIndex::nearest_in(const Cell& cell, double y, double z) const {
  const std::uint32_t n = size(), end = cell.first + cell.count;
  if (cell.count <= scan_limit) {
    Best best{std::numeric_limits<double>::infinity(), cell.guess};
    if (end > n)
      scan(0, end - n, y, z, best);
    scan(cell.first, std::min(end, n), y, z, best);
    return best.facet;
  }
  Best best{distance2(facets_[cell.guess], y, z), cell.guess};
  if (end > n)
    search(0, end - n, y, z, best);
  search(cell.first, std::min(end, n), y, z, best);
  return best.facet;
}

std::uint32_t FacetIndex::nearest(double y, double z) const {
  const double column = (y - corner_.y) * columns_per_metre_, row = (z - corner_.z) * columns_per_metre_;
  const Cell& cell = cells_[cell_of(column_of(column), column_of(row))];
  const bool within = column >= 0.0 && column < columns && row >= 0.0 && row < columns;
  return nearest_in(within ? cell : Cell{0, size(), cell.guess}, y, z);
}

} // namespace fretwork::contact
