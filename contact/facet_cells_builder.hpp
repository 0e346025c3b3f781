// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Makes the cells of a polygon (facet_cells.hpp) from coarse to fine: the list of a cell comes from that of the
/// cell it is a part of, so that the work follows the number of facets and little more.
///
/// All in units of the reach. `rounding` is above what rounding does to two squared distances, to corners, and by moving a point
/// to the next cell (1e-16 each, some tens of times). The tangent of a distance d is uncertain by 1e-16/d of the cell's size, which is more
/// in long thin cells beside a facet; there the facets that the tests leave out were found farther by 1e-13 all the same.
#pragma once
#include "contact/facet_cells.hpp"

namespace fretwork::contact {

class FacetCells::Builder {
public:
  static constexpr std::uint32_t word = 32; ///< bits of t and m
  static constexpr double units = 0x1p32;   ///< of t and m: 2^word

  Builder(std::span<const FacetPair> pairs, FacetCells& cells);
  void build();

private:
  static constexpr std::size_t most_corners = 16;
  static constexpr std::size_t short_list = 4; ///< pairs: what is no longer is not worth another cut
  static constexpr std::size_t sampled = 32;   ///< pairs to choose a cut by
  [[nodiscard]] static double squared(double y, double z) { return y * y + z * z; }
  /// Some corners, or other points of a cell, in order.
  template <class T> struct Some {
    std::array<T, most_corners> of;
    std::size_t number = 0;
    void add(const T& t) { of[number++] = t; }
    [[nodiscard]] std::span<const T> all() const { return {of.data(), number}; }
  };
  using List = std::vector<std::uint32_t>; ///< of pairs
  /// a y + b z - c, 0 on the line.
  struct Line {
    float a, b, c;
    [[nodiscard]] double operator()(PlanePoint p) const;
  };
  /// A convex cell while it is made.
  struct Region {
    Some<PlanePoint> corners;
    std::uint32_t quadrant = 0, depth = 0;
    double growth = 1.0;                 ///< of the lists on the way: sum of the parts by the whole
    std::array<std::uint64_t, 2> low{};  ///< lowest t and m in units, while it is a cell of the grid
    std::array<std::uint32_t, 2> bits{}; ///< how many of their bits it has used
    [[nodiscard]] double share() const;
    [[nodiscard]] PlanePoint middle() const;
    [[nodiscard]] double middle_of(std::size_t which) const;
  };
  /// A point of a cell: what is nearest to it, and its squared distances to the facets of the cell's list.
  struct Place {
    PlanePoint at, foot;
    Facet nearest;
    std::uint32_t pair; ///< of the nearest
    std::vector<Pack> distances;
  };
  /// A cell in two: of values of a line below and above a number.
  struct Split {
    std::array<Region, 2> parts;
    std::array<List, 2> lists;
    [[nodiscard]] double cost() const;
  };

  using Bits = std::array<std::uint32_t, 2>; ///< of t and m

  static List sample(const List& list, std::size_t number);
  std::size_t look(PlanePoint at, const List& list);
  void look_at_corners(const Region& r, const List& list);
  [[nodiscard]] List needed_in(const Some<std::size_t>& corners, const List& list) const;
  Split split(const Line& line, double at, const Region& r, const List& list);

  List looked_at_closely(const List& list, const Region& r, int times);

  Split halve(const List& list, const Region& r, Bits most);
  void weigh(const List& list, const Region& r);
  void fill(const List& list, const Region& r);
  [[nodiscard]] bool long_enough(const List& list, const Region& r) const;
  [[nodiscard]] Cell make(const List& list, const Region& r);
  [[nodiscard]] Cell cut(const List& list, const Region& r);
  void make_strips(std::uint32_t first, std::uint32_t number, const Line& line, double low, const List& list,
                   const Region& r);
  [[nodiscard]] Cell keep(const List& list);

  std::vector<FacetPair> pairs_;
  FacetCells& out_;
  std::uint32_t grid_bits_;         ///< of t and m together
  std::array<double, 2> weights_{}; ///< of t and m: how often cells of the grid want to be halved across them
  std::vector<Place> places_;       ///< of the cell that is looked at, its corners first
  std::size_t looked_ = 0;
};

} // namespace fretwork::contact
