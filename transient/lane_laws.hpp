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

/// Laws of contacts for the step, and how they move before the action.
template <class V> struct Laws {
  V depth, spring, instant, damping, share; ///< m, > 0 where closed; the others as in StepNumbers
  V nn, nt, tt, tangential, bound, share_t;
  V y, z, v_n, v_t; ///< m/s
};
template <class V>
FRETWORK_INLINE Laws<V> laws_at(int i, int width, const SweepRule& rule, const LawLanes& laws,
                                const MemoryLanes& memories, const NearLanes& near) {
  const int l = lane(i);
  const LawNumbers& law = laws[i];
  const MemoryNumbers& memory = memories[i];
  const V one = V{} + 1.0;
  const V g = at<V>(near.gap + i), my = at<V>(near.ny + i), mz = at<V>(near.nz + i), p = clipped(-g);
  const V y = at<V>(near.velocity + i), z = at<V>(near.velocity + width + i);
  const V v_n = my * y + mz * z, v_t = mz * y - my * z;
  const V yy = at<V>(law.yy + l), yz = at<V>(law.yz + l), zz = at<V>(law.zz + l);
  const V by_n_y = my * yy + mz * yz, by_n_z = my * yz + mz * zz; // of y and z by a force along n
  const V by_t_y = mz * yy - my * yz, by_t_z = mz * yz - my * zz; // along t
  const V nn = my * by_n_y + mz * by_n_z, tt = mz * by_t_y - my * by_t_z;
  const V moved = my * (at<V>(near.displacement + i) - at<V>(near.last + i)) +
                  mz * (at<V>(near.displacement + width + i) - at<V>(near.last + width + i));
  const auto [spring, instant] =
      instant_spring<V>(at<V>(law.stiffness + l), p, moved * (-1.0 / rule.step), -v_n, nn, rule.step);
  V damping{}, share = one;
  if (rule.damped) {
    damping = at<V>(law.dissipation + l) * spring;
    if (rule.half_window > 0.0)
      damping += closed_share(V(-g), V(rule.half_window * magnitude(v_n))) * at<V>(law.damping + l);
    share = 1.0 / (1.0 + damping * nn);
  }
  const V keeps = same_face(memory, l, my, mz), mu_static = at<V>(law.mu_static + l);
  return {p,
          spring,
          instant,
          damping,
          share,
          nn,
          mz * by_n_y - my * by_n_z,
          tt,
          keeps * at<V>(memory.spring + l),
          keeps * at<V>(memory.sliding + l) > 0.0 ? at<V>(law.mu_dynamic + l) : mu_static,
          mu_static > 0.0 ? 1.0 / (1.0 + at<V>(law.gradient + l) * tt) : V{},
          y,
          z,
          v_n,
          v_t};
}

/// Friction of contacts whose normal forces are `n`, `free` their tangential velocities without their own friction.
template <class V> struct Rub { V force, slides; };
template <class V>
FRETWORK_INLINE Rub<V> rub(const V& tangential, const V& gradient, const V& share_t, const V& bound,
                           const V& mu_dynamic, const V& n, const V& free) {
  const V stick = (tangential - gradient * free) * share_t, most = mu_dynamic * n;
  const V slides = magnitude(stick) > bound * n ? V{} + 1.0 : V{};
  return {slides > 0.0 ? with_sign_of(stick, most) : stick, slides};
}

} // namespace fretwork::transient::kernels
