// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The nearest facet of a closed polygon, exactly, at a cost that hardly grows with the number of facets.
///
/// A polygon of few facets is scanned. For a longer one:
///   guess    a grid of squares gives the facet expected for the node: the nearest of the square's middle and
///            how that number changes with the node's place
///   scan     the facets about it
///   prove    the nearest of them, k at distance d, is the nearest of all if d < clearance of k
///   search   where that is not so (near the medial axis, where far parts of the polygon compete; ragged
///            polygons): over spans of 8, 32, 128 ... facets, each in a box along its principal axes; a span
///            whose box is no nearer than the best facet is passed over
///
/// Clearance. A point x is nearer to the node than the node's foot q, the node at distance d from q along the
/// unit normal n, only if it lies in the ball about the node,
///     |x - q|^2 < 2 d n.(x - q),
/// which no d below |x - q|^2 / (2 n.(x - q)) allows. The clearance of a facet is a lower bound of this over
/// all its q and all x of the facets farther than `exempt` numbers away (these are scanned), on each side. A
/// corner as foot has the normals n = a n_1 + b n_2 between those of its two facets, a + b <= 1/cos(half the
/// turn): the smaller clearance of both times this cosine. The smallest clearance over the whole polygon is
/// its reach (Federer, Trans. Am. Math. Soc. 93, 1959, theorem 4.18).
#pragma once
#include <array>
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
  /// Of a facet, m: inside (left) and outside.
  using Clearance = std::array<double, 2>;
  /// Number of the facet nearest to a square's middle, with the share of it that lies before the foot, and its
  /// change a square along y and z.
  struct Guess {
    float facet, by_column, by_row;
  };
  struct Best {
    double distance2;
    std::uint32_t facet;
  };

  void build_boxes(std::span<const PlanePoint> vertices, double rounding);
  void build_clearances();
  void build_grid();
  [[nodiscard]] Clearance clearance_of(std::uint32_t k) const;
  [[nodiscard]] std::uint32_t expected(double y, double z) const;
  template <class Pass, class Look> void visit_spans(const Pass& pass, const Look& look) const;
  void scan(std::uint32_t first, std::uint32_t end, double y, double z, Best& best) const;
  void search(double y, double z, Best& best) const;

  std::vector<Facet> facets_;
  std::vector<std::vector<Box>> boxes_; ///< by level: spans of 8, 32, 128 ... facets
  std::vector<Clearance> clearances_;
  std::vector<Guess> grid_; ///< row by row, columns_ squares
  std::uint32_t columns_ = 0;
  PlanePoint corner_{}; ///< of the grid
  double squares_per_metre_ = 0.0;
};

} // namespace fretwork::contact
