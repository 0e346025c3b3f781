// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/facet_cells.hpp"
#include <cmath>
#include <limits>

namespace fretwork::contact {

namespace {

constexpr std::uint32_t word = 32;              // bits of t and m
constexpr double units = 0x1p32;                // of t and m: 2^word
constexpr std::uint32_t all_units = 0xffffffff; // the last of them
constexpr double surround = 1.5;                // how far the cells reach, of the outermost vertex
constexpr double middle = 1e-5; // the same: nearer to the origin all facets may be equally near to rounding
constexpr double rounding =
    1e-14; // of a square of their reach: above what rounding does to that of a distance
constexpr std::size_t short_list = 16; // facets: a shorter list is not worth another halving
constexpr std::size_t long_list = 64;  // facets: a search costs less than a longer list
constexpr std::uint32_t short_gap = 4; // facets: to look at them costs less than another run
constexpr double worth =
    8.0; // a list is worth halving if, times its share of a quadrant and the number of all
         // facets, it is longer

using List = std::vector<std::uint32_t>;

/// A cell while it is made: its lowest t and m in units, and how many of their bits it has used.
struct Region {
  std::uint32_t quadrant;
  std::array<std::uint64_t, 2> low;
  std::array<std::uint32_t, 2> bits;

  [[nodiscard]] Region half(std::uint32_t across, bool upper) const {
    Region r = *this;
    ++r.bits[across];
    r.low[across] += upper ? std::uint64_t{1} << (word - r.bits[across]) : 0;
    return r;
  }
  /// t or m at its low end, middle or high end (0, 1, 2), of 1.
  [[nodiscard]] double at(std::size_t which, std::size_t place) const {
    return (static_cast<double>(low[which]) +
            static_cast<double>(place) * std::ldexp(0.5 * units, -static_cast<int>(bits[which]))) /
           units;
  }
  [[nodiscard]] double share() const { return std::ldexp(1.0, -static_cast<int>(bits[0] + bits[1])); }
};

} // namespace

class FacetCells::Builder {
public:
  Builder(std::span<const Facet> facets, FacetCells& cells)
      : facets_(facets), out_(cells), rounding_(rounding * cells.most_ * cells.most_) {}

  void build();

private:
  static constexpr std::size_t points = 9; ///< of a cell, 3 along t by 3 along m: the corners of its halves
  using Values = std::array<double, points>;
  /// Of the four halves (below and above across t, then across m): their corners among the points.
  static constexpr std::array<std::array<std::size_t, 4>, 4> corners = {
      {{0, 1, 6, 7}, {1, 2, 7, 8}, {0, 2, 3, 5}, {3, 5, 6, 8}}};

  void look(const List& list, const Region& r);
  [[nodiscard]] List needed_in(std::size_t half, const List& list) const;
  void fill(std::uint32_t cell, const List& list, const Region& r);
  void store(std::uint32_t cell, const List& list, Kind kind);
  void start_deep();

  std::span<const Facet> facets_;
  FacetCells& out_;
  double rounding_;
  // of the cell looked at
  Values y_{}, z_{};
  std::vector<Values> distances_;               // squared, of the facets of its list, m^2
  std::array<std::uint32_t, points> nearest_{}; // facet
  std::array<Values, points> feet_{}; // squared distances of points to feet of points, with rounding, m^2
  std::array<double, 2> bits_{};      // of t and m, summed over the cells that are not halved
};

FacetCells::FacetCells(std::span<const Facet> facets, double outermost)
    : least_(middle * outermost), most_(surround * outermost), per_metre_(units / most_) {
  Builder(facets, *this).build();
}

void FacetCells::Builder::build() {
  List all(facets_.size());
  for (std::uint32_t k = 0; k < all.size(); ++k)
    all[k] = k;
  out_.cells_.resize(4);
  for (std::uint32_t quadrant = 0; quadrant < 4; ++quadrant)
    fill(quadrant, all, {quadrant, {0, 0}, {0, 0}});
  start_deep();
}

/// Distances of the points of a cell to the facets of its list.
void FacetCells::Builder::look(const List& list, const Region& r) {
  const double sign_y = r.quadrant & 1u ? -1.0 : 1.0, sign_z = r.quadrant & 2u ? -1.0 : 1.0;
  for (std::size_t k = 0; k < points; ++k) {
    const double t = r.at(0, k % 3), m = std::max(r.at(1, k / 3) * out_.most_, out_.least_);
    y_[k] = sign_y * m * (1.0 - t);
    z_[k] = sign_z * m * t;
  }
  const Values y = y_, z = z_;
  Values least;
  least.fill(std::numeric_limits<double>::infinity());
  distances_.resize(list.size());
  for (std::size_t i = 0; i < list.size(); ++i) {
    const Facet f = facets_[list[i]];
    Values d2;
    for (std::size_t k = 0; k < points; ++k)
      d2[k] = distance2(f, y[k], z[k]);
    distances_[i] = d2;
    for (std::size_t k = 0; k < points; ++k)
      if (d2[k] < least[k])
        least[k] = d2[k], nearest_[k] = list[i];
  }
  for (std::size_t g = 0; g < points; ++g) {
    const PlanePoint p = foot(facets_[nearest_[g]], y_[g], z_[g]);
    for (std::size_t k = 0; k < points; ++k)
      feet_[g][k] = (y_[k] - p.y) * (y_[k] - p.y) + (z_[k] - p.z) * (z_[k] - p.z) + rounding_;
  }
}

/// The facets of the list looked at that may be nearest in a half.
List FacetCells::Builder::needed_in(std::size_t half, const List& list) const {
  const auto [a, b, c, d] = corners[half];
  List needed;
  needed.reserve(list.size());
  for (std::size_t i = 0; i < list.size(); ++i) {
    const Values& d2 = distances_[i];
    bool beaten = false;
    for (const std::size_t g : corners[half])
      beaten |=
          (feet_[g][a] <= d2[a]) & (feet_[g][b] <= d2[b]) & (feet_[g][c] <= d2[c]) & (feet_[g][d] <= d2[d]);
    if (!beaten)
      needed.push_back(list[i]);
  }
  return needed;
}

/// Halves a cell as often as it is worth.
void FacetCells::Builder::fill(std::uint32_t cell, const List& list, const Region& r) {
  const double number = static_cast<double>(list.size());
  if (list.size() <= short_list || r.bits[0] + r.bits[1] == word ||
      number * r.share() * static_cast<double>(facets_.size()) <= worth) {
    for (std::size_t k = 0; k < 2; ++k)
      bits_[k] += r.bits[k];
    if (list.size() <= long_list)
      return store(cell, list, Kind::whole_list);
    look(list, r);
    List some(nearest_.begin(), nearest_.end());
    std::sort(some.begin(), some.end());
    return store(cell, some, Kind::part_of_list);
  }
  look(list, r);
  std::array<List, 4> halves;
  for (std::size_t half = 0; half < 4; ++half)
    halves[half] = needed_in(half, list);
  const std::uint32_t across =
      halves[2].size() + halves[3].size() < halves[0].size() + halves[1].size() ? 1 : 0;
  const auto first = static_cast<std::uint32_t>(out_.cells_.size());
  out_.cells_[cell] = {first, 0, static_cast<std::uint8_t>(word - 1 - r.bits[across]),
                       across == 0 ? Kind::across_t : Kind::across_m};
  out_.cells_.resize(first + 2);
  for (std::uint32_t k = 0; k < 2; ++k)
    fill(first + k, halves[2 * across + k], r.half(across, k == 1));
}

void FacetCells::Builder::store(std::uint32_t cell, const List& list, Kind kind) {
  const auto first = static_cast<std::uint32_t>(out_.runs_.size());
  for (const std::uint32_t k : list)
    if (out_.runs_.size() > first && k < out_.runs_.back().end + short_gap)
      out_.runs_.back().end = k + 1;
    else
      out_.runs_.push_back({k, k + 1});
  out_.cells_[cell] = {first, static_cast<std::uint16_t>(out_.runs_.size() - first), 0, kind};
}

/// No more starts than cells; of t and m each as many first bits, in proportion, as the mean cell has.
void FacetCells::Builder::start_deep() {
  const double most = std::log2(static_cast<double>(out_.cells_.size()) / 4.0), sum = bits_[0] + bits_[1];
  const auto share = [&](double part) {
    return sum > 0.0 ? static_cast<std::uint32_t>(most * part / sum) : 0u;
  };
  const std::array<std::uint32_t, 2> bits{share(bits_[0]), share(bits_[1])};
  out_.start_bits_ = bits;
  for (std::uint32_t quadrant = 0; quadrant < 4; ++quadrant)
    for (std::uint32_t t = 0; t < 1u << bits[0]; ++t)
      for (std::uint32_t m = 0; m < 1u << bits[1]; ++m) {
        const std::array<std::uint64_t, 2> at{std::uint64_t{t} << (word - bits[0]),
                                              std::uint64_t{m} << (word - bits[1])};
        std::uint32_t cell = quadrant;
        while (out_.cells_[cell].kind <= Kind::across_m) {
          const Cell& c = out_.cells_[cell];
          const auto across = static_cast<std::size_t>(c.kind);
          if (c.bit + bits[across] < word)
            break; // told apart by a later bit
          cell = c.first + static_cast<std::uint32_t>(at[across] >> c.bit & 1u);
        }
        out_.starts_.push_back(cell);
      }
}

FacetCells::Few FacetCells::near(double y, double z) const {
  const double a = std::abs(y), b = std::abs(z), m = a + b;
  const bool known = m >= least_ && m < most_;
  // beyond the cells the last one, and the first for NaN
  const auto in_units = [](double x) {
    return static_cast<std::uint64_t>(std::min(std::max(0.0, x), static_cast<double>(all_units)));
  };
  const std::array<std::uint64_t, 2> at{in_units(b / m * units), in_units(m * per_metre_)};
  const std::size_t quadrant = (y < 0.0 ? 1u : 0u) + (z < 0.0 ? 2u : 0u);
  const std::size_t start = (quadrant << start_bits_[0] | at[0] >> (word - start_bits_[0]))
                                << start_bits_[1] |
                            at[1] >> (word - start_bits_[1]);
  const Cell* cell = &cells_[starts_[start]];
  while (cell->kind <= Kind::across_m)
    cell = &cells_[cell->first + (at[static_cast<std::size_t>(cell->kind)] >> cell->bit & 1u)];
  return {{&runs_[cell->first], cell->count}, known && cell->kind == Kind::whole_list};
}

} // namespace fretwork::contact
