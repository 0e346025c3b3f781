// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Area of a tube of radius R that lies beyond another body's surface at a penetration p: what is worn
/// off in one cross-section. All lengths m, angles rad, 0 <= p <= R.
///
/// Flat face: a segment of half-angle f, cos f = 1 - p/R,
///     A_s = R^2 (f - sin f cos f)   [= R^2 acos(1 - p/R) - (R - p) sqrt(2 R p - p^2) ~ (4/3) sqrt(2 R) p^(3/2)]
/// f = 2 asin(sqrt(p/2R)), and x - sin x by its series for small x: no digits are lost as p goes to 0.
///
/// Hole of radius R_h = R + c: a crescent, the tube's centre being at e = c + p from the hole's. The circles
/// cut at x from the line of centres, at h_t from the tube's centre and h_s = h_t + e from the hole's:
///     R - h_t = p (2 R_h + p)/(2 e),  R + h_t = (2 c + p)(2 R - p)/(2 e),  x^2 = their product,
///     a_t = atan2(x, h_t),  a_h = atan2(x, h_s),  b = a_t - a_h = atan2(2 e x, R^2 + R_h^2 - e^2)
///     A_h = R^2 (a_t - sin a_t cos a_t) - R_h^2 (a_h - sin a_h cos a_h)       for p < c^2/R
///         = R^2 b - c (R + R_h) a_h + x e                                     above
/// The two are equal. The first loses the digits of c/R, the second those of p/c. For small p/c
///     A_h ~ (4/3) sqrt(2 R R_h/c) p^(3/2);   for c = 0, 2 R^2 asin(p/2R) + (p/2) sqrt(4 R^2 - p^2).
///
/// Part of a hole between the angles psi_1 and psi_2 from the direction of penetration (a land):
///     (1/2) integral of <rho^2 - R_h^2>,  rho(psi) = e cos psi + sqrt(R^2 - e^2 sin^2 psi)  the tube's surface,
///     rho - R_h = p - 2 e sin^2(psi/2) - e^2 sin^2 psi/(R + sqrt(R^2 - e^2 sin^2 psi)),
/// positive for |psi| < a_h only; equal to A_h where the land is wider than the scar. The scar reaches the angle psi
/// (a_h = psi) at e = R_h cos psi - sqrt(R^2 - R_h^2 sin^2 psi).
/// Source: plane geometry.
#pragma once

namespace fretwork::wear {

/// A_s, m2. @param radius  > 0   @param depth  0..radius
[[nodiscard]] double segment_area(double radius, double depth);

/// a_h, rad, half of the angle that the scar takes in the hole. @param clearance  radial, >= 0
[[nodiscard]] double crescent_half_angle(double radius, double clearance, double depth);

/// A_h, m2.
[[nodiscard]] double crescent_area(double radius, double clearance, double depth);

/// m2, of the part of the crescent between two angles from the direction of penetration, from <= to.
[[nodiscard]] double land_area(double radius, double clearance, double depth, double from, double to);

/// p, m, at which the scar reaches an angle from the direction of penetration; above R where it never does.
[[nodiscard]] double depth_of_half_angle(double radius, double clearance, double angle);

} // namespace fretwork::wear
