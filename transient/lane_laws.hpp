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
template <class V> struct Push { V force, instant; };
template <class V>
FRETWORK_INLINE Push<V> instant_spring(const V& stiffness, const V& p, const V& m, const V& rate,
                                       const V& mobility, double step) {
  const V one = V{} + 1.0;
  const V a = (step / 6.0) * stiffness * mobility, share = 1.0 / (1.0 + a * (1.0 + 0.6 * a));
  const V closed = share * stiffness * p, per_step = p * (1.0 / step);
  const V g = 12.0 * a * share, k = 1.0 - 2.0 * a + 0.6 * a * a;
  const V limit = 0.5 * g * per_step + contact::InstantSpring::smooth * magnitude(m), difference = rate - m;
  const V d = magnitude(difference) > limit ? with_sign_of(difference, limit) : difference;
  const V s = m + d, leaves = per_step + d;
  const V after2 = s * s + g * per_step * (per_step - m) - 4.0 * (1.0 - k) * d * per_step;
  const V resolved = (a <= contact::InstantSpring::most ? one : V{}) * (p > 0.0 ? one : V{});
  const V closes = m > per_step ? resolved : V{};
  const V falls = (m < 0.5 * g * per_step ? resolved : V{}) * (leaves > 0.0 ? one : V{}),
          opens = k * leaves * leaves < after2 ? falls : V{};
  const V either = closes + opens;
  if (!any(either))
    return {closed, closed};
  const V v2 = s * s - 4.0 * d * per_step, pushed = (step / 6.0) * stiffness * v2 * (1.0 - 0.3 * a);
  const V rest = k * v2 + (1.0 - 0.25 * g) * per_step * (4.0 * d - g * per_step);
  const V rooted = root(clipped(closes > 0.0 ? rest : V(k * after2)));
  const V below = closes > 0.0 ? s + 0.5 * g * per_step + rooted : rooted - k * s;
  const V over = pushed + closed * (leaves + (closes > 0.0 ? s : -s));
  const V speed2 = closes > 0.0 ? V(k * v2) : after2; // times k
  const V angle2 = 12.0 * a * k * per_step * per_step / (either > 0.0 ? speed2 : one);
  const V instant = stiffness * p * (1.0 - angle2 * (1.0 / 6.0) * (1.0 - 0.05 * angle2));
  return {either > 0.0 ? over / (either > 0.0 ? below : one) : closed, either > 0.0 ? instant : closed};
}

} // namespace fretwork::transient::kernels
