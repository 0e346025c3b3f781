// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The nearest facet of a closed polygon, exactly, at a cost that hardly grows with the number of facets.
///
/// The plane round the polygon is cut into squares, each split in 4 x 4 where many facets compete near the
/// boundary. A square keeps one cyclic range of facets that holds the nearest facet of each of its points.
/// Facet f, at distance D from the middle c and pulled along the unit vector n = grad D, is left out when a
/// facet g has
///     dist(c_i, g) < D + n.(c_i - c)   at the four corners c_i:
/// the right side is linear and bounds the distance to f from below, the left side is convex, so g is nearer
/// than f in the whole square. A range of few facets is scanned. A longer one (deep inside, or beyond the
/// squares) is searched over spans of 8, 32, 128 ... facets, each inside a capsule (all points within
/// `radius` of the span's chord); a span whose capsule is farther than the best facet is passed over.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

namespace fretwork::contact {

/// A point of the local plane, m.
struct PlanePoint {
  double y, z;
};

/// From vertex a on, along the unit vector u.
struct Facet {
  double ay, az, uy, uz, length;
};

class FacetIndex {
public:
  /// Facet k goes from vertex k to the next one, the last to vertex 0.
  /// @param vertices  at least 3, no two consecutive ones equal
  explicit FacetIndex(std::span<const PlanePoint> vertices);

  /// Number of the nearest facet; among those exactly as near the lowest. No allocation.
  [[nodiscard]] std::uint32_t nearest(double y, double z) const;

  [[nodiscard]] std::uint32_t size() const { return static_cast<std::uint32_t>(facets_.size()); }
  [[nodiscard]] const Facet& operator[](std::uint32_t k) const { return facets_[k]; }

private:
  /// A chord and how far the vertices of its span stray from it.
  struct Capsule {
    Facet chord;
    double radius;
  };
  struct Cell {
    std::uint32_t first; ///< first facet of the range, or the first of 16 smaller cells
    std::uint32_t count; ///< facets in the range; 0: the cell is split
    std::uint32_t guess; ///< the nearest facet of the middle
  };
  struct Best {
    double distance2;
    std::uint32_t facet;
  };

  void build_capsules(std::span<const PlanePoint> vertices);
  void build_cells();
  [[nodiscard]] Cell candidates(const Cell& parent, PlanePoint middle, double half) const;
  [[nodiscard]] std::uint32_t cell_of(std::uint32_t column, std::uint32_t row) const;
  void scan(std::uint32_t first, std::uint32_t end, double y, double z, Best& best) const;
  void search(std::uint32_t first, std::uint32_t end, double y, double z, Best& best) const;
  [[nodiscard]] std::uint32_t nearest_in(const Cell& cell, double y, double z) const;

  std::vector<Facet> facets_;
  std::vector<std::vector<Capsule>> capsules_; ///< by level: spans of 8, 32, 128 ... facets
  std::vector<Cell> cells_;                    ///< 0 is the whole square
  PlanePoint corner_{};                        ///< of the whole square
  double side_ = 0.0;                          ///< m, of the whole square
  double columns_per_metre_ = 0.0;
};

} // namespace fretwork::contact
