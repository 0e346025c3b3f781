// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Vectors of a contact along its local axes, and what forces do to its motion.
#pragma once
#include "contact/plane.hpp"
#include <algorithm>
#include <cmath>

namespace fretwork::transient {

/// A vector along y z x. What moves in the plane of the contact is computed in pairs.
struct Components {
  using Pair [[gnu::vector_size(16)]] = double;
  Pair yz = {};
  double x = 0.0;
  Components() = default;
  Components(double along_y, double along_z, double along_x) : yz{along_y, along_z}, x(along_x) {}
  Components(Pair plane, double along_x) : yz(plane), x(along_x) {}
  [[nodiscard]] double y() const { return yz[0]; }
  [[nodiscard]] double z() const { return yz[1]; }
};
inline Components operator+(const Components& a, const Components& b) { return {a.yz + b.yz, a.x + b.x}; }
inline Components operator-(const Components& a, const Components& b) { return {a.yz - b.yz, a.x - b.x}; }
inline Components operator*(double s, const Components& a) { return {s * a.yz, s * a.x}; }
/// Along n, and along t.
[[nodiscard]] inline double normal(const contact::ContactAxes& axes, const Components& c) {
  return axes.normal(c.y(), c.z());
}
[[nodiscard]] inline double tangent(const contact::ContactAxes& axes, const Components& c) {
  return axes.tangent(c.y(), c.z());
}
/// Along y z x of a vector along n, t and x.
[[nodiscard]] inline Components along(const contact::ContactAxes& axes, double n, contact::Vec2 tangential) {
  return {axes.y(n, tangential.t), axes.z(n, tangential.t), tangential.x};
}
inline double sum_of_sizes(const Components& c) { return std::abs(c.y()) + std::abs(c.z()) + std::abs(c.x); }

/// Acceleration of one contact by a force on another, or on itself: W, 1/kg, rows and columns y z x.
class Mobility {
public:
  [[nodiscard]] double operator()(int to, int from) const { return to < 2 ? yz_[from][to] : x_[from]; }
  /// The largest component by size.
  [[nodiscard]] double largest() const {
    double out = 0.0;
    for (int to = 0; to < 3; ++to)
      for (int from = 0; from < 3; ++from)
        out = std::max(out, std::abs((*this)(to, from)));
    return out;
  }
  void add(int to, int from, double w) {
    if (to < 2)
      yz_[from][to] += w;
    else
      x_[from] += w;
  }
  /// Along y and z, of forces along y and z.
  [[nodiscard]] Components::Pair yz_of(const Components& f) const { return f.y() * yz_[0] + f.z() * yz_[1]; }
  [[nodiscard]] Components operator*(const Components& f) const {
    return {f.y() * yz_[0] + f.z() * yz_[1] + f.x * yz_[2], x_[0] * f.y() + x_[1] * f.z() + x_[2] * f.x};
  }

  Mobility& operator+=(const Mobility& other) {
    for (int from = 0; from < 3; ++from) {
      yz_[from] += other.yz_[from];
      x_[from] += other.x_[from];
    }
    return *this;
  }
  friend Mobility operator-(Mobility a, const Mobility& b) {
    for (int from = 0; from < 3; ++from) {
      a.yz_[from] -= b.yz_[from];
      a.x_[from] -= b.x_[from];
    }
    return a;
  }
  friend Mobility operator*(double s, Mobility a) {
    for (int from = 0; from < 3; ++from) {
      a.yz_[from] *= s;
      a.x_[from] *= s;
    }
    return a;
  }

private:
  Components::Pair yz_[3] = {}; ///< columns
  double x_[3] = {};            ///< row
};

/// Displacement of one contact by a unit impulse on another, or on itself, after a time t within a step:
///     g(t) = W t - V t^3/6
/// of a free mass W t, of modes what they hold back of it. A constant force moves the contact as the mobility over(t) does.
struct ImpulseResponse {
  Mobility w; ///< 1/kg
  Mobility v; ///< 1/(kg s2)
  [[nodiscard]] Mobility over(double time) const { return w - (time * time / 12.0) * v; }
  /// What that leaves out, m/N: a force with the mean F and the growth G over t moves the contact by Y G further, its mean by Y (F - G/8).
  [[nodiscard]] Mobility compliance(double time) const { return (contact::fourth_power(time) / 180.0) * v; }
};

} // namespace fretwork::transient
