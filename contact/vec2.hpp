// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// A vector and a symmetric matrix of the tangent plane, components along x_loc and t. Where nothing moves along x_loc both are numbers, along
/// t: `dot` and `norm` stand for either, so that laws are written once.
#pragma once
#include <cmath>

namespace fretwork::contact {

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

struct Sym2 {
  double xx = 0.0, xt = 0.0, tt = 0.0;
};
inline Vec2 operator*(const Sym2& a, Vec2 b) { return {a.xx * b.x + a.xt * b.t, a.xt * b.x + a.tt * b.t}; }

} // namespace fretwork::contact
