// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The few facets of a polygon that may be nearest to a point: cells of the plane, each with its list.
///
/// First a grid: trapezoids about the origin, between two rays and two lines of equal m = |y| + |z|; with t = |z|/m
/// (in each quadrant from one axis to the other) they are rectangles in (t, m), and a point is found in them by
/// the first bits of t and m. Rays suit holes: the facets that compete for a point of a round hole are those of its
/// sector, at any depth. Then, where lists are still long, strips: 2 to 32 side by side in a direction that suits
/// the place, mostly that to the nearest facet, for along it facets keep their order.
///
/// A cell is convex. A facet f is not needed in it if something else is nearer at all its points; two tests say so,
/// both from its corners v alone:
///     a point p of the polygon   |v - p|^2 + rounding <= distance of f to v, squared:
///                                the points nearer to p than to all of f are a convex set (for each point of f half a plane)
///     a facet g                  distance of g to v + rounding <= l(v), l the tangent, at the middle of the cell, of the distance
///                                to f: distances to segments are convex, so l is below that of f, and that of g less l convex
/// What is left out is farther by more than rounding: of facets exactly as near none is left out. A facet that no part of a
/// cell needs the cell does not need: among spikes half of the list of a cell falls when its eighths are asked.
#pragma once
#include "contact/facet.hpp"
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

namespace fretwork::contact {

class FacetCells {
public:
  FacetCells() = default;
  /// @param pairs  of facets of a polygon round the origin, in order; what fills up the last one is far away
  /// @param outermost  m, > 0: largest |y| + |z| of a vertex
  FacetCells(std::span<const FacetPair> pairs, double outermost);

  struct Few {
    std::span<const std::uint32_t>
        pairs; ///< `few` of them, increasing, the last may repeat; or a longer list
    bool
        known; ///< otherwise (outside the cells, in the very middle, no number) the nearest may be any facet: these are some
  };
  static constexpr std::size_t few = 4;
  /// No allocation.
  [[nodiscard]] Few near(double y, double z) const;

private:
  /// Of the last word the upper bits say what it is, the others a number n:
  ///     few_pairs   the four words (that of the last being n) are the list
  ///     long_list   the list begins at n, with its length
  ///     otherwise   2^kind strips, cells from n on, of a y + b z - c = 0 to 1, 1 to 2 ..., the first and the last without end;
  ///                 the other words are a, b, c as floats, in units of the reach
  struct alignas(16) Cell {
    static constexpr std::uint32_t few_pairs = 0, long_list = 7, number_bits = 29;
    std::array<std::uint32_t, few> words{};
    [[nodiscard]] std::uint32_t kind() const { return words[3] >> number_bits; }
    [[nodiscard]] std::uint32_t number() const { return words[3] & ((1u << number_bits) - 1u); }
    [[nodiscard]] double value(std::size_t k) const {
      return static_cast<double>(std::bit_cast<float>(words[k]));
    }
  };
  class Builder;
  static constexpr double least =
      1e-5; ///< of m, of the reach: nearer to the origin all facets may be equally near to rounding

  std::vector<Cell> cells_;
  std::vector<std::uint32_t> lists_; ///< the long ones
  std::vector<Cell> starts_;         ///< cells to start from, by quadrant and by the first bits of t and m
  std::array<std::uint32_t, 2> start_bits_{};
  std::array<double, 2> start_numbers_{};
  double per_metre_ = 0.0; ///< 1/reach: cells have m < reach
};

inline FacetCells::Few FacetCells::near(double y, double z) const {
  const double at_y = y * per_metre_, at_z = z * per_metre_, a = std::abs(at_y), b = std::abs(at_z),
               m = a + b;
  const bool known = m >= least && m < 1.0;
  // beyond the cells the last one, and the first for NaN
  const auto part = [](double x, double parts) {
    return static_cast<std::size_t>(
        static_cast<std::int64_t>(std::min(std::max(0.0, x * parts), parts - 1.0)));
  };
  const std::size_t quadrant = (y < 0.0 ? 1u : 0u) + (z < 0.0 ? 2u : 0u);
  const std::size_t start = (quadrant << start_bits_[0] | part(b / m, start_numbers_[0])) << start_bits_[1] |
                            part(m, start_numbers_[1]);
  const Cell* cell = &starts_[start];
  std::uint32_t kind = cell->kind();
  while (kind - 1u < Cell::long_list - 1u) {
    const double strip = cell->value(0) * at_y + cell->value(1) * at_z - cell->value(2);
    const double last = (1u << kind) - 1u;
    cell = &cells_[cell->number() +
                   static_cast<std::size_t>(static_cast<std::int64_t>(std::min(std::max(0.0, strip), last)))];
    kind = cell->kind();
  }
  if (kind == Cell::few_pairs)
    return {cell->words, known};
  const std::uint32_t* list = &lists_[cell->number()];
  return {{list + 1, *list}, known};
}

} // namespace fretwork::contact
