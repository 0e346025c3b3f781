// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The few facets of a polygon that may be nearest to a point: cells of the plane, each with its list.
///
/// Cells are trapezoids about the origin, between two rays and two lines of equal m = |y| + |z|; with t = |z|/m
/// (in each quadrant from one axis to the other) they are rectangles in (t, m), and a point is found in them by
/// the bits of t and m. Rays suit holes: the facets that compete for a point of a round hole are those of its
/// sector, at any depth. A cell with a long list is halved, across t or across m, whichever leaves less.
///
/// Which facets a cell needs. The points that are nearer to a point p of the polygon than to all of facet f are a convex set (for each
/// point of f half a plane). If the corners of a cell are in it, so is the cell, and f is not needed:
///     |v - p|^2 + rounding <= distance of f to v, squared     at the four corners v
/// The p tried are the feet of the corners. What is left out is farther by more than rounding: of facets exactly as near none is left out.
///
/// Cells are halved until their lists are short, or until they are so small that it would not pay: where very many facets are equally
/// near (the centre of an arc that is not the origin). There the list is not given.
#pragma once
#include "contact/facet.hpp"
#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace fretwork::contact {

class FacetCells {
public:
  FacetCells() = default;
  /// @param facets    of a polygon round the origin, in order
  /// @param outermost  m, > 0: largest |y| + |z| of a vertex
  FacetCells(std::span<const Facet> facets, double outermost);

  /// Facets first to end; some of them may not be needed.
  struct Run {
    std::uint32_t first, end;
  };
  struct Few {
    std::span<const Run> runs; ///< by increasing number, not empty
    bool all;                  ///< otherwise the nearest facet may be another one: these are near
  };
  /// No allocation.
  [[nodiscard]] Few near(double y, double z) const;

private:
  enum class Kind : std::uint8_t { across_t, across_m, whole_list, part_of_list };
  /// Halved across t or m: a bit of it tells the halves, cells `first` and `first + 1`, apart. Otherwise its facets are in
  /// `count` runs from `first` on.
  struct Cell {
    std::uint32_t first;
    std::uint16_t count;
    std::uint8_t bit;
    Kind kind;
  };
  class Builder;

  std::vector<Cell> cells_;
  std::vector<Run> runs_;
  std::vector<std::uint32_t> starts_; ///< cells to start from, by quadrant and by the first bits of t and m
  std::array<std::uint32_t, 2> start_bits_{};
  double least_ = 0.0, most_ = 0.0, per_metre_ = 0.0; ///< of m, m; 2^32 / most_
};

} // namespace fretwork::contact
