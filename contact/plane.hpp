// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Points and directions in the planes of a contact: the local plane (y, z), across x_loc, and the tangent plane (x_loc, t) of the obstacle's surface.
#pragma once
#include <cmath>

namespace fretwork::contact {

/// A point of the local plane, m.
struct PlanePoint {
  double y, z;
};

/// The directions of a contact across x_loc: the normal n = (ny, nz) of the obstacle's surface, towards the tube, and the tangent
/// t = n x x_loc = (nz, -ny). Components along y, z become components along n, t, and back.
struct ContactAxes {
  double ny = 0.0, nz = 0.0; ///< of length 1; both 0: none

  /// Components along n and t of a vector along y, z.
  [[nodiscard]] constexpr double normal(double y, double z) const { return ny * y + nz * z; }
  [[nodiscard]] constexpr double tangent(double y, double z) const { return nz * y - ny * z; }
  /// Components along y and z of a vector along n, t.
  [[nodiscard]] constexpr double y(double normal, double tangent) const { return normal * ny + tangent * nz; }
  [[nodiscard]] constexpr double z(double normal, double tangent) const { return normal * nz - tangent * ny; }
  [[nodiscard]] constexpr ContactAxes reversed() const { return {-ny, -nz}; }
  /// Whether the other normal is that of the opposite face: another surface.
  [[nodiscard]] constexpr bool opposite(const ContactAxes& other) const {
    return ny * other.ny + nz * other.nz < 0.0;
  }
};

/// A vector of the tangent plane, components along x_loc and t. Where nothing moves along x_loc it is a number, along t: `dot`, `norm` and
/// `with_length` stand for either, so that laws are written once.
struct Vec2 {
  double x = 0.0, t = 0.0;
};
inline Vec2 operator+(Vec2 a, Vec2 b) { return {a.x + b.x, a.t + b.t}; }
inline Vec2 operator-(Vec2 a, Vec2 b) { return {a.x - b.x, a.t - b.t}; }
inline Vec2 operator*(double s, Vec2 a) { return {s * a.x, s * a.t}; }
inline double dot(Vec2 a, Vec2 b) { return a.x * b.x + a.t * b.t; }
inline double norm(Vec2 a) { return std::sqrt(dot(a, a)); }
inline double dot(double a, double b) { return a * b; }
inline double norm(double a) { return std::abs(a); }

/// v with another length than its own.
inline double with_length(double length, double v, double) { return std::copysign(length, v); }
inline Vec2 with_length(double length, Vec2 v, double own) { return (length / own) * v; }

/// A symmetric matrix of the tangent plane.
struct Sym2 {
  double xx = 0.0, xt = 0.0, tt = 0.0;
};
inline Sym2 operator+(const Sym2& a, const Sym2& b) { return {a.xx + b.xx, a.xt + b.xt, a.tt + b.tt}; }
inline Sym2 operator*(double s, const Sym2& a) { return {s * a.xx, s * a.xt, s * a.tt}; }
/// s + A, s a multiple of the unit matrix; A^2.
inline double plus(double s, double a) { return s + a; }
inline Sym2 plus(double s, const Sym2& a) { return {s + a.xx, a.xt, s + a.tt}; }
inline double square(double a) { return a * a; }
/// (A B + B A)/2
inline double symmetric_product(double a, double b) { return a * b; }
inline Sym2 symmetric_product(const Sym2& a, const Sym2& b) {
  return {a.xx * b.xx + a.xt * b.xt, 0.5 * (a.xt * (b.xx + b.tt) + b.xt * (a.xx + a.tt)),
          a.xt * b.xt + a.tt * b.tt};
}
inline Sym2 square(const Sym2& a) {
  return {a.xx * a.xx + a.xt * a.xt, a.xt * (a.xx + a.tt), a.xt * a.xt + a.tt * a.tt};
}
inline double fourth_power(double a) { return square(square(a)); }
inline Vec2 operator*(const Sym2& a, Vec2 b) { return {a.xx * b.x + a.xt * b.t, a.xt * b.x + a.tt * b.t}; }

} // namespace fretwork::contact
