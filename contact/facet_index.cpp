// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/facet_index.hpp"
#include <algorithm>
#include <cmath>
#include <limits>

namespace fretwork::contact {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr std::uint32_t scan_limit = 16; // facets: a scan is then as fast as any search
constexpr std::uint32_t exempt = 4;      // neighbours on each side that a clearance leaves out
constexpr std::uint32_t spare = 1;       // facets by which the guess may be wrong
constexpr std::uint32_t half_window = exempt + 1 + spare; // 1: a corner stands for both its facets
constexpr double squares_per_facet = 2.0; // the guess errs with the square of their width: by as many facets
                                          // whatever their number
constexpr double surround = 0.25;         // of the polygon's width: what the grid has to spare on each side
constexpr double opening = 1.0 / 12;  // length over distance of a span whose bound is taken for its clearance
constexpr double sharp = 0.1;         // cosine of a turn beyond which a node may be on both sides of a facet
constexpr double margin = 1.0 - 1e-3; // of the clearance: others are then farther by more than round-off
constexpr double round_off = 1e-13;   // of the polygon's width: above what rounding does to a distance
constexpr std::uint32_t full_span = 3; // a span of level l has 2^(3 + 2 l) facets

std::uint32_t span_bits(std::size_t level) { return full_span + 2 * static_cast<std::uint32_t>(level); }

Facet facet_between(PlanePoint a, PlanePoint b) {
  const double y = b.y - a.y, z = b.z - a.z, length = std::sqrt(y * y + z * z);
  return {a.y, a.z, y / length, z / length, length};
}

inline double distance2(const Facet& f, double y, double z) {
  const double wy = y - f.ay, wz = z - f.az;
  const double along = std::min(std::max(wy * f.uy + wz * f.uz, 0.0), f.length);
  const double ry = wy - along * f.uy, rz = wz - along * f.uz;
  return ry * ry + rz * rz;
}

/// In the axes of facet f: from its start along it, and to its left.
inline PlanePoint seen_from(const Facet& f, double y, double z) {
  const double wy = y - f.ay, wz = z - f.az;
  return {wy * f.uy + wz * f.uz, wz * f.uy - wy * f.uz};
}

inline double height_over(const Facet& f, double y, double z) { return seen_from(f, y, z).z; }

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

FacetIndex::Box box_of(const Facet& f) {
  const double half = 0.5 * f.length;
  return {f.ay + half * f.uy, f.az + half * f.uz, f.uy, f.uz, half, 0.0};
}

/// Least |x - q|^2 / (2 x.z) over x from a to b, a.z and b.z >= 0: (s + 2 e + c/s) / (2 rise) in s, from where
/// the line meets z = 0.
double least_on(PlanePoint a, PlanePoint b, double q) {
  const auto at = [&](double share) {
    const double y = a.y - q + share * (b.y - a.y), z = a.z + share * (b.z - a.z);
    return z > 0.0 ? (y * y + z * z) / (2.0 * z) : infinity;
  };
  const double rise = b.z - a.z, run = b.y - a.y;
  double least = std::min(at(0.0), at(1.0));
  if (rise != 0.0) {
    const double foot = -a.z / rise, y = a.y - q + foot * run; // share and place at which z = 0
    const double inner = foot + std::copysign(std::abs(y) / std::sqrt(run * run + rise * rise), rise);
    if (inner > 0.0 && inner < 1.0)
      least = std::min(least, at(inner));
  }
  return least;
}

/// The same over all q of a facet from 0 to `length`; a and b in its axes, what lies on its right left out.
double least_between(PlanePoint a, PlanePoint b, double length) {
  if (a.z <= 0.0 && b.z <= 0.0)
    return infinity;
  const double share = a.z / (a.z - b.z);
  if (a.z < 0.0)
    a = {a.y + share * (b.y - a.y), 0.0};
  else if (b.z < 0.0)
    b = {a.y + share * (b.y - a.y), 0.0};
  const double least = std::min(least_on(a, b, 0.0), least_on(a, b, length));
  const bool over_it = std::min(a.y, b.y) < length && std::max(a.y, b.y) > 0.0;
  return over_it ? std::min(least, 0.5 * std::min(a.z, b.z)) : least;
}

} // namespace

FacetIndex::FacetIndex(std::span<const PlanePoint> vertices) {
  facets_.reserve(vertices.size());
  for (std::size_t k = 0; k < vertices.size(); ++k)
    facets_.push_back(facet_between(vertices[k], vertices[(k + 1) % vertices.size()]));
  if (size() <= scan_limit)
    return;
  PlanePoint low = vertices[0], high = vertices[0];
  for (const PlanePoint& v : vertices) {
    low = {std::min(low.y, v.y), std::min(low.z, v.z)};
    high = {std::max(high.y, v.y), std::max(high.z, v.z)};
  }
  const double width = std::max(high.y - low.y, high.z - low.z), side = (1.0 + 2.0 * surround) * width;
  columns_ = static_cast<std::uint32_t>(std::ceil(std::sqrt(squares_per_facet * size())));
  corner_ = {0.5 * (low.y + high.y - side), 0.5 * (low.z + high.z - side)};
  squares_per_metre_ = columns_ / side;
  build_boxes(vertices, round_off * width);
  build_clearances();
  build_grid();
}

void FacetIndex::build_boxes(std::span<const PlanePoint> vertices, double rounding) {
  const std::uint32_t n = size();
  for (std::uint32_t bits = full_span; (1u << bits) < n; bits += 2) {
    std::vector<Box>& level = boxes_.emplace_back();
    for (std::uint32_t first = 0; first < n; first += 1u << bits)
      level.push_back(box_round(vertices, first, std::min(first + (1u << bits), n), rounding));
  }
}

void FacetIndex::build_clearances() {
  const std::uint32_t n = size();
  std::vector<Clearance> own(n);
  for (std::uint32_t k = 0; k < n; ++k)
    own[k] = clearance_of(k);
  clearances_ = own;
  for (std::uint32_t k = 0; k < n; ++k)
    for (const std::uint32_t other : {(k == 0 ? n : k) - 1, k + 1 == n ? 0 : k + 1}) {
      const double cosine = facets_[k].uy * facets_[other].uy + facets_[k].uz * facets_[other].uz;
      const double half = std::sqrt(std::max(0.0, 0.5 * (1.0 + cosine)));
      Clearance both{std::min(own[k][0], own[other][0]), std::min(own[k][1], own[other][1])};
      if (cosine < sharp)
        both[0] = both[1] = std::min(both[0], both[1]);
      for (int side = 0; side < 2; ++side)
        clearances_[k][side] = std::min(clearances_[k][side], margin * half * both[side]);
    }
}

/// Of one facet, its ends left to its neighbours.
FacetIndex::Clearance FacetIndex::clearance_of(std::uint32_t k) const {
  const Facet& f = facets_[k];
  const double half = 0.5 * f.length, my = f.ay + half * f.uy, mz = f.az + half * f.uz;
  Clearance clearance{infinity, infinity};
  // whether a part of the polygon inside a capsule needs no closer look: |x - q| >= gap, x.z <= rise
  // whether a part of the polygon inside a box needs no closer look: |x - q| >= gap, x.z <= rise
  const auto settled = [&](const Box& box) {
    const double gap = std::sqrt(distance2(box, my, mz)) - half;
    if (!(gap > 0.0))
      return false;
    const double middle = height_over(f, box.y, box.z);
    const double extent = box.along * std::abs(f.uy * box.uz - f.uz * box.uy) +
                          box.across * std::abs(f.uy * box.uy + f.uz * box.uz);
    const double rise = extent + middle, fall = extent - middle;
    const Clearance least{rise > 0.0 ? gap * gap / (2.0 * rise) : infinity,
                          fall > 0.0 ? gap * gap / (2.0 * fall) : infinity};
    if (least[0] >= clearance[0] && least[1] >= clearance[1])
      return true;
    if (2.0 * (box.along + box.across) > opening * gap)
      return false;
    clearance = {std::min(clearance[0], least[0]), std::min(clearance[1], least[1])};
    return true;
  };
  const auto look = [&](std::uint32_t j) {
    const Facet& other = facets_[j];
    const PlanePoint a = seen_from(f, other.ay, other.az),
                     b = seen_from(f, other.ay + other.length * other.uy, other.az + other.length * other.uz);
    clearance[0] = std::min(clearance[0], least_between(a, b, f.length));
    clearance[1] = std::min(clearance[1], least_between({a.y, -a.z}, {b.y, -b.z}, f.length));
  };
  const std::uint32_t n = size(), next = exempt + 1;
  look(k + next < n ? k + next : k + next - n); // often the least: most spans are then passed over
  look(k < next ? k + n - next : k - next);
  visit_spans(settled, [&](std::uint32_t first, std::uint32_t end) {
    for (std::uint32_t j = first; j < end; ++j) {
      const std::uint32_t apart = j > k ? j - k : k - j;
      if (std::min(apart, n - apart) > exempt && !settled(box_of(facets_[j])))
        look(j);
    }
  });
  return clearance;
}

void FacetIndex::build_grid() {
  const std::uint32_t n = size();
  std::vector<double> feet( // numbers of facets, with the share that lies before the foot
      static_cast<std::size_t>(columns_) * columns_);
  Best best{0.0, 0};
  for (std::uint32_t row = 0; row < columns_; ++row)
    for (std::uint32_t i = 0; i < columns_; ++i) {
      const std::uint32_t column = row % 2 == 0 ? i : columns_ - 1 - i; // the last foot is a good first guess
      const double y = corner_.y + (column + 0.5) / squares_per_metre_,
                   z = corner_.z + (row + 0.5) / squares_per_metre_;
      best.distance2 = distance2(facets_[best.facet], y, z);
      search(y, z, best);
      const Facet& f = facets_[best.facet];
      const double along = std::min(std::max(seen_from(f, y, z).y, 0.0), f.length);
      feet[row * columns_ + column] = best.facet + along / f.length;
    }
  // the smaller of the changes to both sides: the larger one may be a jump to another part of the polygon
  const auto change = [&](std::uint32_t at, std::uint32_t place, std::uint32_t stride) {
    double least = infinity;
    for (const int side : {-1, 1})
      if (side < 0 ? place > 0 : place + 1 < columns_) {
        const double difference = side * (feet[at + side * static_cast<int>(stride)] - feet[at]);
        const double cyclic = difference - n * std::round(difference / n);
        least = std::abs(cyclic) < std::abs(least) ? cyclic : least;
      }
    return static_cast<float>(least);
  };
  grid_.reserve(feet.size());
  for (std::uint32_t row = 0; row < columns_; ++row)
    for (std::uint32_t column = 0; column < columns_; ++column) {
      const std::uint32_t at = row * columns_ + column;
      grid_.push_back({static_cast<float>(feet[at]), change(at, column, 1), change(at, row, columns_)});
    }
}

std::uint32_t FacetIndex::expected(double y, double z) const {
  const double last = columns_ - 1.0;
  // beyond the grid its border's square, and 0 for NaN
  const double column = std::min(std::max(0.0, (y - corner_.y) * squares_per_metre_), last + 0.999),
               row = std::min(std::max(0.0, (z - corner_.z) * squares_per_metre_), last + 0.999);
  const auto i = static_cast<std::uint32_t>(column), j = static_cast<std::uint32_t>(row);
  const Guess& guess = grid_[j * columns_ + i];
  const double facet = guess.facet + guess.by_column * (column - i - 0.5) + guess.by_row * (row - j - 0.5);
  const double n = size(), wrapped = facet < 0.0 ? facet + n : facet >= n ? facet - n : facet;
  return wrapped >= 0.0 && wrapped < n ? static_cast<std::uint32_t>(wrapped) : 0u;
}

/// The first of equals counts.
inline void FacetIndex::scan(std::uint32_t first, std::uint32_t end, double y, double z, Best& best) const {
  for (std::uint32_t k = first; k < end; ++k) {
    const double d2 = distance2(facets_[k], y, z);
    if (d2 < best.distance2)
      best = {d2, k};
  }
}

/// Facets first to end and some about them: spans are passed over or looked at one facet after the other.
template <class Pass, class Look> void FacetIndex::visit_spans(const Pass& pass, const Look& look) const {
  std::uint32_t k = 0;
  std::size_t level = boxes_.size() - 1;
  while (k < size()) {
    if (!pass(boxes_[level][k >> span_bits(level)])) {
      if (level > 0) {
        --level;
        continue;
      }
      look(k, std::min(k + (1u << full_span), size()));
    }
    k += 1u << span_bits(level);
    while (level + 1 < boxes_.size() && (k & ((1u << span_bits(level + 1)) - 1u)) == 0)
      ++level;
  }
}

/// Replaces `best` by the nearest facet of all, or one of lower number as near.
void FacetIndex::search(double y, double z, Best& best) const {
  best.distance2 = std::nextafter(best.distance2, infinity);
  visit_spans([&](const Box& box) { return distance2(box, y, z) >= best.distance2; },
              [&](std::uint32_t first, std::uint32_t end) { scan(first, end, y, z, best); });
}

std::uint32_t FacetIndex::nearest(double y, double z) const {
  const std::uint32_t n = size();
  Best best{infinity, 0};
  if (n <= scan_limit) {
    scan(0, n, y, z, best);
    return best.facet;
  }
  const std::uint32_t middle = expected(y, z);
  const std::uint32_t first = middle < half_window ? middle + n - half_window : middle - half_window,
                      end = first + 2 * half_window + 1;
  if (end > n)
    scan(0, end - n, y, z, best);
  scan(first, std::min(end, n), y, z, best);

  const std::uint32_t away = best.facet > middle ? best.facet - middle : middle - best.facet;
  const bool flanked = std::min(away, n - away) <= spare;
  const double clear = clearances_[best.facet][height_over(facets_[best.facet], y, z) < 0.0];
  if (!(flanked && best.distance2 < clear * clear))
    search(y, z, best);
  return best.facet;
}

} // namespace fretwork::contact
