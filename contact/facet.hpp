// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Facets of a polygon in the local plane.
#pragma once
#include "contact/plane.hpp"
#include <algorithm>
#include <bit>
#include <cstdint>
#include <limits>

namespace fretwork::contact {

/// From vertex a on, along the unit vector u.
struct Facet {
  double ay, az, uy, uz, length;
};

/// The point of a facet, ends included, that is nearest to a point.
inline PlanePoint foot(const Facet& f, double y, double z) {
  const double along = std::min(std::max((y - f.ay) * f.uy + (z - f.az) * f.uz, 0.0), f.length);
  return {f.ay + along * f.uy, f.az + along * f.uz};
}

/// Two numbers at once: what every processor of the kind has.
typedef double Pack __attribute__((vector_size(2 * sizeof(double))));

typedef std::int64_t PackBits __attribute__((vector_size(2 * sizeof(std::int64_t))));

/// first and first + 1.
inline Pack numbers_from(std::uint32_t first) { return static_cast<double>(first) + Pack{0.0, 1.0}; }

/// Two facets, value by value.
struct FacetPair {
  Pack ay, az, uy, uz, length;
  FacetPair(const Facet& a, const Facet& b)
      : ay{a.ay, b.ay}, az{a.az, b.az}, uy{a.uy, b.uy}, uz{a.uz, b.uz}, length{a.length, b.length} {}
  [[nodiscard]] Facet operator[](std::uint32_t i) const { return {ay[i], az[i], uy[i], uz[i], length[i]}; }
};

/// Squared distances of a point to two facets, m^2.
inline Pack distance2(const FacetPair& f, double y, double z) {
  const Pack wy = y - f.ay, wz = z - f.az, inner = wy * f.uy + wz * f.uz;
  const Pack after = inner > 0.0 ? inner : Pack{}, along = after < f.length ? after : f.length;
  const Pack ry = wy - along * f.uy, rz = wz - along * f.uz;
  return ry * ry + rz * rz;
}

/// A value, and the place where it was found.
struct Found {
  double value;
  std::uint32_t number;
};

/// The least of eight values, by pairs, and its place from 0 on; of equals the first, and 0 where none is a number.
/// No branches, for places that nothing could predict, and no place kept beside the values while they are compared.
inline Found least_of(Pack a, Pack b, Pack c, Pack d) {
  const auto less = [](Pack p, Pack q) { return q < p ? q : p; };
  const Pack two = less(less(a, b), less(c, d));
  const double least = two[1] < two[0] ? two[1] : two[0];
  const PackBits places = ((a == least) & PackBits{1, 2}) | ((b == least) & PackBits{4, 8}) |
                          ((c == least) & PackBits{16, 32}) | ((d == least) & PackBits{64, 128});
  const int first = std::countr_zero(static_cast<std::uint64_t>(places[0] | places[1]));
  return {least, static_cast<std::uint32_t>(first) % 8u};
}

/// The least of values that come two by two; of equals the one of lowest number.
class Least {
public:
  void see(Pack values, Pack numbers) {
    number_ = values < value_ ? numbers : number_;
    value_ = values < value_ ? values : value_;
  }
  [[nodiscard]] double value() const { return value_[lane()]; }
  /// 0 where no value has been below infinity.
  [[nodiscard]] std::uint32_t number() const { return static_cast<std::uint32_t>(number_[lane()]); }
  /// Both without branches, for numbers that nothing could predict.
  [[nodiscard]] Found any() const {
    const Pack value{value_[1], value_[0]}, number{number_[1], number_[0]};
    const auto other = (value < value_) | ((value == value_) & (number < number_));
    return {(other ? value : value_)[0],
            static_cast<std::uint32_t>(static_cast<std::int64_t>((other ? number : number_)[0]))};
  }

private:
  [[nodiscard]] int lane() const {
    return value_[1] < value_[0] || (value_[1] == value_[0] && number_[1] < number_[0]) ? 1 : 0;
  }
  Pack value_ = Pack{} + std::numeric_limits<double>::infinity(), number_{};
};

} // namespace fretwork::contact
