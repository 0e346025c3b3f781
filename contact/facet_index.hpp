// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The nearest facet of a closed polygon, exactly, at a cost that hardly grows with the number of facets.
///
/// A polygon of few facets is scanned. For a longer one:
///   cells    of the plane list the few facets that may be nearest (facet_cells.hpp); the nearest of them counts
///   search   for nodes outside the cells or in the very middle: over spans of 8, 32, 128 ... facets, each in a box
///            along its principal axes; a span whose box is no nearer than the best facet is passed over
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

  [[nodiscard]] std::uint32_t size() const { return size_; }
  [[nodiscard]] Facet operator[](std::uint32_t k) const { return pairs_[k / 2][k % 2]; }

  /// A rectangle: middle, direction of one axis, half widths along and across it, m.
  struct Box {
    double y, z, uy, uz, along, across;
  };

private:
  void build_boxes(std::span<const PlanePoint> vertices, double rounding);
  void look_at(std::uint32_t first, std::uint32_t end, double y, double z, Least& distances) const;
  /// On its own: what it keeps in registers and on the stack would cost the scan of few facets.
  [[gnu::noinline]] [[nodiscard]] std::uint32_t nearest_in_cells(double y, double z) const;
  [[nodiscard]] Least search(double y, double z, double bound) const;

  std::uint32_t size_;
  std::vector<FacetPair> pairs_;        ///< the last one, where needed, with a facet beyond all others
  std::vector<std::vector<Box>> boxes_; ///< by level: spans of 8, 32, 128 ... facets
  FacetCells cells_;
};

} // namespace fretwork::contact
