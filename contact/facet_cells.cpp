// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/facet_cells.hpp"
#include <cmath>

namespace fretwork::contact {

namespace {

constexpr std::uint32_t word = 32;              // bits of t and m
constexpr double units = 0x1p32;                // of t and m: 2^word
constexpr std::uint32_t all_units = 0xffffffff; // the last of them
constexpr double surround = 1.5;                // how far the cells reach, of the outermost vertex
constexpr double middle = 1e-5; // the same: nearer to the origin all facets may be equally near to rounding
constexpr double rounding = 2e-14;     // of the square of their reach
constexpr std::size_t short_list = 16; // facets: a shorter list is not worth another halving
constexpr std::uint32_t short_gap = 4; // facets: to look at them costs less than another run
// A list is worth halving if, times its share of a quadrant and the number of all facets, it is longer.
constexpr double worth = 16.0;

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
  static constexpr std::size_t points = 8; ///< of a cell: its corners and the middles of its sides
  /// Of each point the place along t and m: low end, middle, high end.
  static constexpr std::array<std::array<std::size_t, 2>, points> places = {
      {{0, 0}, {1, 0}, {2, 0}, {0, 1}, {2, 1}, {0, 2}, {1, 2}, {2, 2}}};
  /// Of the four halves (below and above across t, then across m): their corners among the points.
  static constexpr std::array<std::array<std::size_t, 4>, 4> corners = {
      {{0, 1, 5, 6}, {1, 2, 6, 7}, {0, 2, 3, 4}, {3, 4, 5, 7}}};
  void look(const List& list, const Region& r);
  [[nodiscard]] List needed_in(std::size_t half, const List& list) const;
  void fill(std::uint32_t cell, const List& list, const Region& r);
  void store(std::uint32_t cell, const List& list);
  void start_deep();

  std::span<const Facet> facets_;
  FacetCells& out_;
  double rounding_;
  // of the cell looked at
  std::array<PlanePoint, points> at_{};
  std::array<std::vector<Pack>, points> distances_; ///< squared, to the facets of its list two by two, m^2
  std::array<std::array<double, points>, points>
      feet_{};                   ///< to the foot of a point, of a point: squared, with rounding, m^2
  std::array<double, 2> bits_{}; ///< of t and m, summed over the cells that are not halved
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

/// Distances of the points of a cell to the facets of its list and to the feet of one another.
void FacetCells::Builder::look(const List& list, const Region& r) {
  const double sign_y = r.quadrant & 1u ? -1.0 : 1.0, sign_z = r.quadrant & 2u ? -1.0 : 1.0;
  for (std::size_t k = 0; k < points; ++k) {
    const double t = r.at(0, places[k][0]), m = std::max(r.at(1, places[k][1]) * out_.most_, out_.least_);
    at_[k] = {sign_y * m * (1.0 - t), sign_z * m * t};
    distances_[k].resize((list.size() + 1) / 2);
  }
  std::array<Least, points> least;
  for (std::size_t i = 0; i < list.size(); i += 2) {
    const FacetPair pair(facets_[list[i]], facets_[list[std::min(i + 1, list.size() - 1)]]);
    for (std::size_t k = 0; k < points; ++k) {
      const Pack d2 = distance2(pair, at_[k].y, at_[k].z);
      distances_[k][i / 2] = d2;
      least[k].see(d2, numbers_from(static_cast<std::uint32_t>(i)));
    }
  }
  for (std::size_t g = 0; g < points; ++g) {
    const PlanePoint p = foot(facets_[list[least[g].number()]], at_[g].y, at_[g].z);
    for (std::size_t k = 0; k < points; ++k)
      feet_[g][k] = (at_[k].y - p.y) * (at_[k].y - p.y) + (at_[k].z - p.z) * (at_[k].z - p.z) + rounding_;
  }
}

/// The facets of the list looked at that may be nearest in a half.
List FacetCells::Builder::needed_in(std::size_t half, const List& list) const {
  const auto corner = corners[half];
  std::array<std::array<Pack, 4>, 4> feet;
  for (std::size_t g = 0; g < 4; ++g)
    for (std::size_t k = 0; k < 4; ++k)
      feet[g][k] = Pack{} + feet_[corner[g]][corner[k]];
  List needed;
  needed.reserve(list.size());
  for (std::size_t i = 0; i < list.size(); i += 2) {
    const auto of_corner = [&](std::size_t k) { return distances_[corner[k]][i / 2]; };
    const Pack a = of_corner(0), b = of_corner(1), c = of_corner(2), d = of_corner(3);
    auto beaten = a < a; // no lane of it
    for (const auto& p : feet)
      beaten |= (p[0] <= a) & (p[1] <= b) & (p[2] <= c) & (p[3] <= d);
    if (beaten[0] == 0)
      needed.push_back(list[i]);
    if (beaten[1] == 0 && i + 1 < list.size())
      needed.push_back(list[i + 1]);
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
    return store(cell, list);
  }
  look(list, r);
  std::array<List, 4> halves;
  for (std::size_t half = 0; half < 4; ++half)
    halves[half] = needed_in(half, list);
  const std::uint32_t across =
      halves[2].size() + halves[3].size() < halves[0].size() + halves[1].size() ? 1 : 0;
  const auto first = static_cast<std::uint32_t>(out_.cells_.size());
  out_.cells_[cell] = {{first, first + 2},
                       across == 0 ? Cell::across_t : Cell::across_m,
                       static_cast<std::uint16_t>(word - 1 - r.bits[across])};
  out_.cells_.resize(first + 2);
  for (std::uint32_t k = 0; k < 2; ++k)
    fill(first + k, halves[2 * across + k], r.half(across, k == 1));
}

void FacetCells::Builder::store(std::uint32_t cell, const List& list) {
  std::vector<Run>& runs = out_.runs_;
  const auto first = static_cast<std::uint32_t>(runs.size());
  for (const std::uint32_t k : list)
    if (runs.size() > first && k < runs.back().end + short_gap)
      runs.back().end = k + 1;
    else
      runs.push_back({k, k + 1});
  const auto end = static_cast<std::uint32_t>(runs.size());
  out_.cells_[cell] = {{first, end}, Cell::some_runs, 0};
  if (end == first + 1) {
    out_.cells_[cell] = {runs.back(), Cell::one_run, 0};
    runs.pop_back();
  }
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
        Cell cell = out_.cells_[quadrant];
        while (cell.kind <= Cell::across_m && cell.bit + bits[cell.kind] >= word) // told apart by a first bit
          cell = out_.cells_[cell.what.first + static_cast<std::uint32_t>(at[cell.kind] >> cell.bit & 1u)];
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
  const Cell* cell = &starts_[start];
  while (cell->kind <= Cell::across_m)
    cell = &cells_[cell->what.first + (at[cell->kind] >> cell->bit & 1u)];
  if (cell->kind == Cell::one_run)
    return {{&cell->what, 1}, known};
  return {{runs_.data() + cell->what.first, cell->what.end - cell->what.first}, known};
}

} // namespace fretwork::contact
