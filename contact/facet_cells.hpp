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
/// `rounding` is above what rounding does to two squared distances (less than 1e-14 of the square of the cells' reach) and by
/// moving a point to the next cell (1e-16 of its m).
///
/// Cells are halved until their lists are short, or until they are so small that it would not pay: where very many facets are equally
/// near (the centre of an arc that is not the origin). Lists are whole there too, only long.
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
    bool
        known; ///< otherwise (outside the cells, in the very middle, no number) the nearest may be any facet: these are some
  };
  /// No allocation.
  [[nodiscard]] Few near(double y, double z) const;

private:
  /// `what` are the halves, cells that the bit tells apart, or the facets of the list, or its runs.
  struct Cell {
    Run what;
    enum Kind : std::uint16_t { across_t, across_m, one_run, some_runs } kind;
    std::uint16_t bit;
  };
  class Builder;

  std::vector<Cell> cells_;
  std::vector<Run> runs_;
  std::vector<Cell> starts_; ///< cells to start from, by quadrant and by the first bits of t and m
  std::array<std::uint32_t, 2> start_bits_{};
  double least_ = 0.0, most_ = 0.0, per_metre_ = 0.0; ///< of m, m; 2^32 / most_
};

} // namespace fretwork::contact
