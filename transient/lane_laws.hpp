// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Laws of contacts in lanes, for the kernels that solve and commit a step. Included by them alone.
///
/// Flags are packs of 1 and 0, and choices are made by one comparison each: compilers turn these into a vector operation, and masks that
/// are joined into many scalar ones.
#pragma once
#include "contact/instant_spring.hpp"
#include "transient/contact_lanes.hpp"
#include "transient/vector_lanes.hpp"

namespace fretwork::transient::kernels {

template <class V> FRETWORK_INLINE V clipped(const V& p) { return p > 0.0 ? p : V{}; }
template <class V> FRETWORK_INLINE V with_sign_of(const V& sign, const V& size) {
  return sign < 0.0 ? -size : size;
}
/// 1 where the surface is not the opposite face, which is another one.
template <class V> FRETWORK_INLINE V same_face(const MemoryNumbers& memory, int l, const V& ny, const V& nz) {
  return at<V>(memory.normal_y + l) * ny + at<V>(memory.normal_z + l) * nz < 0.0 ? V{} : V{} + 1.0;
}

/// contact::closed_share of p - reach to p + reach.
template <class V> FRETWORK_INLINE V closed_share(const V& p, const V& reach) {
  const V one = V{} + 1.0;
  const V low = p - reach, high = p + reach, part = high > 0.0 ? high / (high > low ? high - low : one) : V{};
  return low > 0.0 ? one : part;
}

/// contact::InstantSpring.
template <class V>
FRETWORK_INLINE V instant_spring(const V& stiffness, const V& p, const V& v, const V& mobility, double step) {
  const V one = V{} + 1.0;
  const V a = (step / 6.0) * stiffness * mobility, share = 1.0 / (1.0 + a * (1.0 + 0.6 * a));
  const V closed = share * stiffness * p, per_step = p * (1.0 / step);
  const V g = 12.0 * a * share, k = 1.0 - 2.0 * a + 0.6 * a * a;
  const V after2 = v * v + g * per_step * (per_step - v);
  const V resolved = (a <= contact::InstantSpring::most ? one : V{}) * (p > 0.0 ? one : V{});
  const V closes = v > per_step ? resolved : V{};
  const V falls = v < 0.5 * g * per_step ? resolved : V{},
          opens = k * per_step * per_step < after2 ? falls : V{};
  if (!any(closes + opens))
    return closed;
  const V pushed = (step / 6.0) * stiffness * v * v * (1.0 - 0.3 * a);
  const V inside = closes > 0.0 ? k * v * v - g * (1.0 - 0.25 * g) * per_step * per_step : k * after2;
  const V rooted = root(clipped(inside));
  const V below = closes > 0.0 ? v + 0.5 * g * per_step + rooted : rooted - k * v;
  const V over = pushed + closed * (closes > 0.0 ? per_step + v : per_step - v);
  const V either = closes + opens;
  return either > 0.0 ? over / (either > 0.0 ? below : one) : closed;
}

} // namespace fretwork::transient::kernels
