// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The nearest facet of a closed polygon, exactly, at a cost that hardly grows with the number of facets.
///
/// A polygon of few facets is scanned. For a longer one:
///   cells    of the plane list the few facets that may be nearest (facet_cells.hpp); the nearest of them counts
///   search   where a cell has no whole list, and for nodes far outside: over spans of 8, 32, 128 ... facets, each
///            in a box along its principal axes; a span whose box is no nearer than the best facet is passed over
#pragma once
#include "contact/facet_cells.hpp"

namespace fretwork::contact {

class FacetIndex {
public:
  /// Facet k goes from vertex k to the next one, the last to vertex 0; the inside is on the left.
  /// @param vertices  at least 3, no two consecutive ones equal
  explicit FacetIndex(std::span<const PlanePoint> vertices);

  /// Number of the nearest facet; among those exactly as near the lowest. No allocation.
  [[nodiscard]] std::uint32_t nearest(double y, double z) const;

  [[nodiscard]] std::uint32_t size() const { return static_cast<std::uint32_t>(facets_.size()); }
  [[nodiscard]] const Facet& operator[](std::uint32_t k) const { return facets_[k]; }

  /// A rectangle: middle, direction of one axis, half widths along and across it, m.
  struct Box {
    double y, z, uy, uz, along, across;
  };

private:
  struct Best {
    double distance2;
    std::uint32_t facet;
  };

  void build_boxes(std::span<const PlanePoint> vertices, double rounding);
  [[nodiscard]] Best nearest_of(std::span<const FacetCells::Run> runs, double y, double z) const;
  void search(double y, double z, Best& best) const;

  std::vector<Facet> facets_;
  std::array<std::vector<double>, 5> lanes_; ///< the same, value by value
  std::vector<std::vector<Box>> boxes_;      ///< by level: spans of 8, 32, 128 ... facets
  FacetCells cells_;
};

} // namespace fretwork::contact
