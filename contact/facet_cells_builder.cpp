// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/facet_cells_builder.hpp"
#include <cmath>
#include <iterator>
#include <utility>

namespace fretwork::contact {

namespace {

constexpr double rounding = 1e-13; // of squared distances, and of distances
// A list is worth another cut if it is longer than short_list by more than this over its share of a quadrant and over the number of all pairs: walls are thin, but nodes are there,
constexpr double worth = 0.5;
// and if the cuts on the way have not left most of the lists in both parts; no more cuts than this in any case.
constexpr double most_growth = 500.0;
constexpr std::uint32_t deepest = 64;
// Cells of the grid: more would not stay in the cache, and cut what runs across them into many.
constexpr double cells_per_facet = 1.0, most_grid_cells = 8192.0;
constexpr std::uint32_t most_strips = 5; // 2^5
constexpr int halvings = 3;              // of cells to look at their lists closely
constexpr std::size_t weighed = 1000;    // pairs to choose the grid by

} // namespace

double FacetCells::Builder::Line::operator()(PlanePoint p) const {
  return static_cast<double>(a) * p.y + static_cast<double>(b) * p.z - static_cast<double>(c);
}

PlanePoint FacetCells::Builder::Region::middle() const {
  PlanePoint sum{0.0, 0.0};
  for (const PlanePoint& p : corners.all())
    sum = {sum.y + p.y, sum.z + p.z};
  const double number = static_cast<double>(corners.number);
  return {sum.y / number, sum.z / number};
}

/// Of a quadrant, about: by t and m, in which the middle of a hole counts as much as its wall.
double FacetCells::Builder::Region::share() const {
  const auto v = corners.all();
  double twice = 0.0;
  for (std::size_t k = 2; k < v.size(); ++k)
    twice += (v[k - 1].y - v[0].y) * (v[k].z - v[0].z) - (v[k].y - v[0].y) * (v[k - 1].z - v[0].z);
  const PlanePoint p = middle();
  return 0.5 * std::abs(twice) / (std::abs(p.y) + std::abs(p.z));
}

/// Middle of t or m.
double FacetCells::Builder::Region::middle_of(std::size_t which) const {
  return static_cast<double>(low[which] + (std::uint64_t{1} << (word - 1 - bits[which]))) / units;
}

double FacetCells::Builder::Split::cost() const {
  const auto a = static_cast<double>(lists[0].size()), b = static_cast<double>(lists[1].size());
  return a * a + b * b;
}

FacetCells::Builder::Builder(std::span<const FacetPair> pairs, FacetCells& cells)
    : pairs_(pairs.begin(), pairs.end()), out_(cells) {
  for (FacetPair& p : pairs_)
    p.ay *= cells.per_metre_, p.az *= cells.per_metre_, p.length *= cells.per_metre_;
  const double grid_cells =
      std::min(most_grid_cells, cells_per_facet * 2.0 * static_cast<double>(pairs.size()));
  grid_bits_ = static_cast<std::uint32_t>(std::max(0.0, std::log2(grid_cells / 4.0)));
}

void FacetCells::Builder::build() {
  List all(pairs_.size());
  for (std::uint32_t k = 0; k < all.size(); ++k)
    all[k] = k;
  std::array<Region, 4> quadrants;
  for (std::uint32_t quadrant = 0; quadrant < 4; ++quadrant) {
    const double y = quadrant & 1u ? -1.0 : 1.0, z = quadrant & 2u ? -1.0 : 1.0;
    quadrants[quadrant].quadrant = quadrant;
    for (const PlanePoint p : {PlanePoint{y * least, 0.0}, {y, 0.0}, {0.0, z}, {0.0, z * least}})
      quadrants[quadrant].corners.add(p);
  }
  const List some = sample(all, weighed);
  for (const Region& r : quadrants)
    weigh(some, r);
  const double sum = weights_[0] + weights_[1], t_share = sum > 0.0 ? weights_[0] / sum : 0.0;
  out_.start_bits_[0] = static_cast<std::uint32_t>(std::round(t_share * grid_bits_));
  out_.start_bits_[1] = grid_bits_ - out_.start_bits_[0];
  for (std::size_t k = 0; k < 2; ++k)
    out_.start_numbers_[k] = 1u << out_.start_bits_[k];
  out_.starts_.resize(std::size_t{4} << grid_bits_);
  for (const Region& r : quadrants)
    fill(all, r);
}

/// A long list thinned out, to choose by: enough to tell what a cut would leave.
FacetCells::Builder::List FacetCells::Builder::sample(const List& list, std::size_t number) {
  const std::size_t step = (list.size() + number - 1) / number;
  List some;
  for (std::size_t k = 0; k < list.size(); k += step)
    some.push_back(list[k]);
  return some;
}

/// The number of the place.
std::size_t FacetCells::Builder::look(PlanePoint at, const List& list) {
  if (looked_ == places_.size())
    places_.emplace_back();
  Place& place = places_[looked_];
  place.at = at;
  place.distances.resize(list.size());
  Least least_of;
  Pack numbers = numbers_from(0);
  for (std::size_t i = 0; i < list.size(); ++i, numbers += 2.0) {
    const Pack d2 = distance2(pairs_[list[i]], at.y, at.z);
    place.distances[i] = d2;
    least_of.see(d2, numbers);
  }
  const std::uint32_t n = least_of.number();
  place.pair = list[n / 2];
  place.nearest = pairs_[place.pair][n % 2];
  place.foot = foot(place.nearest, at.y, at.z);
  return looked_++;
}

void FacetCells::Builder::look_at_corners(const Region& r, const List& list) {
  looked_ = 0;
  for (const PlanePoint& p : r.corners.all())
    look(p, list);
}

/// The pairs of the list that may have the nearest facet in a cell with these corners.
FacetCells::Builder::List FacetCells::Builder::needed_in(const Some<std::size_t>& corners,
                                                         const List& list) const {
  const std::size_t n = corners.number;
  std::array<const Place*, most_corners> v;
  PlanePoint middle{0.0, 0.0};
  for (std::size_t k = 0; k < n; ++k) {
    v[k] = &places_[corners.of[k]];
    middle = {middle.y + v[k]->at.y / static_cast<double>(n), middle.z + v[k]->at.z / static_cast<double>(n)};
  }
  // distances from corner k to the foot of corner g and to the facet nearest to corner g
  std::array<Pack, most_corners * most_corners> to_foot, to_facet;
  for (std::size_t g = 0; g < n; ++g)
    for (std::size_t k = 0; k < n; ++k) {
      const PlanePoint at = v[k]->at, p = v[g]->foot, q = foot(v[g]->nearest, at.y, at.z);
      to_foot[g * n + k] = Pack{} + (squared(at.y - p.y, at.z - p.z) + rounding);
      to_facet[g * n + k] = Pack{} + (std::sqrt(squared(at.y - q.y, at.z - q.z)) + rounding);
    }
  std::array<Pack, most_corners> of_pair;
  const auto beaten_by = [&](const auto& rivals) {
    auto beaten = Pack{} != Pack{};
    for (std::size_t g = 0; g < n; ++g) {
      auto by_this = rivals[g * n] <= of_pair[0];
      for (std::size_t k = 1; k < n; ++k)
        by_this &= rivals[g * n + k] <= of_pair[k];
      beaten |= by_this;
      if (beaten[0] && beaten[1])
        break;
    }
    return beaten;
  };
  List needed;
  needed.reserve(list.size());
  for (std::size_t i = 0; i < list.size(); ++i) {
    if (std::any_of(v.begin(), v.begin() + n, [&](const Place* at) { return at->pair == list[i]; })) {
      needed.push_back(list[i]); // nearest at a corner: no need to ask
      continue;
    }
    for (std::size_t k = 0; k < n; ++k)
      of_pair[k] = v[k]->distances[i];
    auto beaten = beaten_by(to_foot);
    if (beaten[0] && beaten[1])
      continue;
    // the tangent of the distance, at the middle
    const FacetPair& f = pairs_[list[i]];
    const Pack wy = middle.y - f.ay, wz = middle.z - f.az, inner = wy * f.uy + wz * f.uz;
    const Pack after = inner > 0.0 ? inner : Pack{}, along = after < f.length ? after : f.length;
    const Pack ry = wy - along * f.uy, rz = wz - along * f.uz, d2 = ry * ry + rz * rz;
    const Pack d{std::sqrt(d2[0]), std::sqrt(d2[1])}, per = d > 0.0 ? 1.0 / d : Pack{};
    for (std::size_t k = 0; k < n; ++k)
      of_pair[k] = d + per * (ry * (v[k]->at.y - middle.y) + rz * (v[k]->at.z - middle.z));
    beaten |= beaten_by(to_facet);
    if (!(beaten[0] && beaten[1]))
      needed.push_back(list[i]);
  }
  return needed;
}

/// What the grid is to be like: most of all where lists are long.
void FacetCells::Builder::weigh(const List& list, const Region& r) {
  if (r.bits[0] + r.bits[1] == grid_bits_ || !long_enough(list, r)) {
    for (std::size_t k = 0; k < 2; ++k)
      weights_[k] += r.bits[k] * static_cast<double>(list.size());
    return;
  }
  const Split s = halve(list, r, {grid_bits_, grid_bits_});
  for (std::size_t k = 0; k < 2; ++k)
    weigh(s.lists[k], s.parts[k]);
}

void FacetCells::Builder::fill(const List& list, const Region& r) {
  const Bits& bits = out_.start_bits_;
  if (r.bits != bits && long_enough(list, r)) {
    const Split s = halve(list, r, bits);
    for (std::size_t k = 0; k < 2; ++k)
      fill(s.lists[k], s.parts[k]);
    return;
  }
  const Cell cell = make(looked_at_closely(list, r, halvings), r);
  const std::size_t t = r.low[0] >> (word - bits[0]), m = r.low[1] >> (word - bits[1]);
  for (std::size_t i = t; i < t + (std::size_t{1} << (bits[0] - r.bits[0])); ++i)
    for (std::size_t j = m; j < m + (std::size_t{1} << (bits[1] - r.bits[1])); ++j)
      out_.starts_[((std::size_t{r.quadrant} << bits[0] | i) << bits[1]) + j] = cell;
}

/// To be worth another cut.
bool FacetCells::Builder::long_enough(const List& list, const Region& r) const {
  return list.size() > short_list && r.depth < deepest && r.growth <= most_growth && r.corners.number >= 3 &&
         r.corners.number <= most_corners - 4 &&
         static_cast<double>(list.size() - short_list) * r.share() * static_cast<double>(pairs_.size()) >
             worth;
}

FacetCells::Cell FacetCells::Builder::make(const List& list, const Region& r) {
  return long_enough(list, r) ? cut(list, r) : keep(list);
}

/// In strips along the way to the nearest facet, across it, or between two parts of the polygon, whichever leaves less.
FacetCells::Cell FacetCells::Builder::cut(const List& list, const Region& r) {
  const List some = sample(list, sampled);
  look_at_corners(r, some);
  const std::size_t corners = r.corners.number;
  const PlanePoint g = r.middle(), p = places_[look(g, some)].foot;
  Some<PlanePoint> normals;
  if (p.y != g.y || p.z != g.z) {
    normals.add({g.z - p.z, p.y - g.y});
    normals.add({p.y - g.y, p.z - g.z});
  }
  double widest = 1.0;
  PlanePoint between{0.0, 0.0};
  for (std::size_t k = 0; k < corners; ++k)
    for (std::size_t j = 0; j < k; ++j) {
      const Place &u = places_[k], &v = places_[j];
      const double uy = u.foot.y - u.at.y, uz = u.foot.z - u.at.z, vy = v.foot.y - v.at.y,
                   vz = v.foot.z - v.at.z;
      const double cosine = (uy * vy + uz * vz) / std::sqrt(squared(uy, uz) * squared(vy, vz));
      if (cosine < widest)
        widest = cosine, between = {v.foot.y - u.foot.y, v.foot.z - u.foot.z};
    }
  if (between.y != 0.0 || between.z != 0.0)
    normals.add(between);

  Split best;
  PlanePoint normal{0.0, 0.0};
  double least_cost = 0.0;
  for (const PlanePoint& n : normals.all()) {
    const double scale = 1.0 / std::sqrt(squared(n.y, n.z));
    const Line line{static_cast<float>(n.y * scale), static_cast<float>(n.z * scale), 0.0f};
    double low = line(r.corners.of[0]), high = low;
    for (const PlanePoint& q : r.corners.all())
      low = std::min(low, line(q)), high = std::max(high, line(q));
    Split s = split(line, 0.5 * (low + high), r, some);
    if (least_cost == 0.0 || s.cost() < least_cost)
      best = std::move(s), normal = {n.y * scale, n.z * scale}, least_cost = best.cost();
  }
  if (least_cost == 0.0)
    return keep(list);
  // as many strips as make lists short at this rate, and twice that: cells are small, and lists a little too long slow
  const double whole = static_cast<double>(list.size()),
               left = std::sqrt(0.5 * least_cost) / static_cast<double>(some.size());
  std::uint32_t bits = 1;
  if (left < 0.75) {
    const double halves = std::log(static_cast<double>(short_list) / whole) / std::log(left);
    bits = std::min(most_strips, 1 + static_cast<std::uint32_t>(std::max(1.0, std::round(halves))));
  }
  const double number = 1u << bits;
  double low = 0.0, high = 0.0;
  for (std::size_t k = 0; k < corners; ++k) {
    const PlanePoint& q = r.corners.of[k];
    const double value = normal.y * q.y + normal.z * q.z;
    low = k == 0 ? value : std::min(low, value), high = k == 0 ? value : std::max(high, value);
  }
  const double scale = number / (high - low);
  if (!(scale < 1e9))
    return keep(list);
  const Line line{static_cast<float>(scale * normal.y), static_cast<float>(scale * normal.z),
                  static_cast<float>(scale * low)};
  const std::size_t first = out_.cells_.size();
  out_.cells_.resize(first + (std::size_t{1} << bits));
  make_strips(static_cast<std::uint32_t>(first), 1u << bits, line, 0.0, list, r);
  return {{std::bit_cast<std::uint32_t>(line.a), std::bit_cast<std::uint32_t>(line.b),
           std::bit_cast<std::uint32_t>(line.c),
           bits << Cell::number_bits | static_cast<std::uint32_t>(first)}};
}

void FacetCells::Builder::make_strips(std::uint32_t first, std::uint32_t number, const Line& line, double low,
                                      const List& list, const Region& r) {
  if (number == 1 || list.size() <= short_list || r.corners.number < 3 ||
      r.corners.number > most_corners - 4) {
    const Cell cell = number == 1 ? make(looked_at_closely(list, r, halvings), r) : keep(list);
    std::fill_n(out_.cells_.begin() + first, number, cell);
    return;
  }
  look_at_corners(r, list);
  const std::uint32_t half = number / 2;
  const Split s = split(line, low + half, r, list);
  make_strips(first, half, line, low, s.lists[0], s.parts[0]);
  make_strips(first + half, half, line, low + half, s.lists[1], s.parts[1]);
}

FacetCells::Cell FacetCells::Builder::keep(const List& list) {
  Cell cell;
  if (list.size() <= few) {
    for (std::size_t k = 0; k < few; ++k)
      cell.words[k] = list[std::min(k, list.size() - 1)];
    return cell;
  }
  std::vector<std::uint32_t>& lists = out_.lists_;
  cell.words[3] = Cell::long_list << Cell::number_bits | static_cast<std::uint32_t>(lists.size());
  lists.push_back(static_cast<std::uint32_t>(list.size()));
  lists.insert(lists.end(), list.begin(), list.end());
  return cell;
}

} // namespace fretwork::contact
