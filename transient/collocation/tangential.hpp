// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Vectors of the tangent plane of a contact with D directions: where nothing moves along x_loc (D = 2) they are numbers, along t, and
/// need neither roots nor divisions.
#pragma once
#include "contact/plane.hpp"
#include <type_traits>

namespace fretwork::transient {

template <int D> using Tangential = std::conditional_t<D == 2, double, contact::Vec2>;
template <int D> Tangential<D> tangential(contact::Vec2 v) {
  if constexpr (D == 2)
    return v.t;
  else
    return v;
}
inline contact::Vec2 in_plane(double v) { return {0.0, v}; }
inline contact::Vec2 in_plane(contact::Vec2 v) { return v; }

using contact::dot;
using contact::norm;

} // namespace fretwork::transient
