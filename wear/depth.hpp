// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Wear depth from worn volume, by the geometry of tube and support. V(p) is the volume that the tube, of
/// radius R, has in common with the unworn support at a penetration p; with A the areas of
/// cross_section.hpp, B the length of the support along the tube, theta the inclination, c the radial
/// clearance, R_h = R + c:
///
///     geometry          exact                                      reference
///     flat bar          B A_s(p)                                   (4/3) sqrt(2 R) p^1.5 B
///       inclined        int_0^L A_s(p - theta s) ds                8 sqrt(2 R) (p^2.5 - <p - B theta>^2.5)/(15 theta)
///     drilled hole      B A_h(p)                                   2 B A_h(p)
///       inclined        int_0^L A_h(p - theta s) ds                2 p A_h/(3 theta)              for p < B theta
///     lands             B sum over the lands of A_land(p)          four: B (A_h + p^2 tan b), three: half of it
///       inclined        int_0^L of the same                        three: p (A_h + p^2 tan b)/(6 theta), four:
///                                                                  twice that                     for p < B theta
///     ring, all round   pi B p (2 R - p)                           2 pi B R p
///     tube on tube      8 sqrt(2 R) p^2.5/(15 theta)               the same
///     tube sector       B psi p (2 R - p)/2                        the same
///     support sector    B psi p (2 R_h + p)/2                      the same
///
/// L = min(B, p/theta), <.> the positive part, b half of a land's angle, psi the angle of a sector.
/// Inclined, with u = t^2 for p - theta s,  t_1 = sqrt(p), t_0 = sqrt(<p - B theta>):
///     V = (2 L/(t_0 + t_1)) times the mean of t A(t^2) between t_0 and t_1,
/// smooth in t and without a division by theta: theta -> 0 loses no digits. Where the scar becomes wider than a land the
/// second derivative of the area jumps: the integral is taken in parts between these depths.
/// p of a volume is the root of V(p), bracketed in ln p. A volume above V at `largest_depth` (R; in the reference
/// form of inclined holes and lands B theta) has no depth: that is returned, not clamped.
///
/// Both bodies wear: p from V = V_t + V_s, shared p_t = p V_t/V, p_s = p V_s/V. In a sector each body has its own
/// volume and depth.
/// Source of the exact column: plane geometry. The reference column is that of Code_Aster 17, POST_USURE, for
/// comparison with it: its factor 2 of the hole and 1/2 of three lands have no geometric meaning, and it puts
/// degrees and the other sign into its sectors, which is not repeated here.
#pragma once
#include <optional>
#include <string_view>
#include <variant>
#include <vector>

namespace fretwork::wear {

enum class Form { exact, reference };

struct FlatBar {
  double radius;            ///< R of the tube, m, > 0
  double length;            ///< B, m, > 0: of the support along the tube
  double inclination = 0.0; ///< theta, rad, 0 <= theta < pi/2: between the tube and the bar's face
};
struct DrilledHole {
  double radius;            ///< R, m, > 0
  double clearance;         ///< c, m, > 0: radial; 0 is `Ring`
  double length;            ///< B, m, > 0
  double inclination = 0.0; ///< theta, rad, as above
};
/// Lands of a broached hole or a lattice: parts of a hole of radius R + c that hold the tube.
struct Lands {
  double radius;            ///< R, m, > 0
  double clearance;         ///< c, m, > 0: radial, at the lands
  double length;            ///< B, m, > 0
  double half_angle;        ///< b, rad, 0 < b < pi/2, of each land seen from the middle of the hole
  int lands = 4;            ///< of the whole support: 3 or 4 in the reference form
  double inclination = 0.0; ///< theta, rad, as above
  std::vector<double> middles =
      {0.0}; ///< rad, of the worn lands, from the direction of penetration, which is
             ///< within one of them
};
struct Ring {
  double radius; ///< R, m, > 0
  double length; ///< B, m, > 0
};
struct TubeOnTube {
  double radius;   ///< R, m, > 0: of both tubes
  double crossing; ///< theta, rad, 0 < theta < pi/2: between the tubes
};
/// The tube's own wear in an angular sector.
struct TubeSector {
  double radius; ///< R, m, > 0
  double length; ///< B, m, > 0
  double angle;  ///< psi, rad, 0 < psi <= 2 pi
};
/// The support's wear in an angular sector of its hole.
struct SupportSector {
  double hole_radius; ///< R_h, m, > 0
  double length;      ///< B, m, > 0
  double angle;       ///< psi, rad, 0 < psi <= 2 pi
};
using Geometry = std::variant<FlatBar, DrilledHole, Lands, Ring, TubeOnTube, TubeSector, SupportSector>;

/// "flat_bar", "drilled_hole", "lands", "ring", "tube_on_tube", "tube_sector", "support_sector".
[[nodiscard]] std::string_view name_of(const Geometry& geometry);

/// @throws core::Error naming the size that is out of range
void check(const Geometry& geometry, Form form = Form::exact);

/// Largest depth that the form describes, m.
[[nodiscard]] double largest_depth(const Geometry& geometry, Form form = Form::exact);

/// V(p), m3. @param depth  p, m, 0..largest_depth
/// @throws core::Error for a geometry or a depth out of range
[[nodiscard]] double volume(const Geometry& geometry, double depth, Form form = Form::exact);

/// p, m, of a volume (m3, >= 0), to a relative 1e-13; nothing where the volume is above that of the largest
/// depth. @throws core::Error for a geometry or a volume out of range
[[nodiscard]] std::optional<double> depth(const Geometry& geometry, double volume, Form form = Form::exact);

/// Size of the scar at a depth (m, 0..largest_depth of the exact form).
struct Scar {
  double
      width; ///< m, across the tube: flat 2 sqrt(2 R p - p^2); hole 2 R_h a_h; of lands the widest part within one
  double length; ///< m, along the tube: min(B, p/theta)
  double
      half_angle; ///< rad: in a hole a_h (crescent_half_angle), for other geometries half of the tube's angle in the scar
};
/// @throws core::Error for a geometry or a depth out of range
[[nodiscard]] Scar scar(const Geometry& geometry, double depth);

/// Scar that tube and support share: one depth p for V_t + V_s.
struct SharedScar {
  Geometry geometry;
  Form form = Form::exact;
};
/// A sector in which each body wears by itself.
struct SectorPair {
  TubeSector tube;
  SupportSector support;
};
using Pairing = std::variant<SharedScar, SectorPair>;

struct PairDepth {
  double tube, support; ///< p_t, p_s, m
  [[nodiscard]] double total() const { return tube + support; }
};

/// @throws core::Error naming the size that is out of range
void check(const Pairing& pairing);

/// Depths of both bodies; nothing where a volume is beyond the geometry.
/// @param tube, support  V_t, V_s, m3, >= 0
/// @throws core::Error for a geometry or a volume out of range
[[nodiscard]] std::optional<PairDepth> depths(const Pairing& pairing, double tube, double support);

/// Largest depth that a body may reach in its geometry, m.
[[nodiscard]] double largest_depth(const Pairing& pairing);

} // namespace fretwork::wear
