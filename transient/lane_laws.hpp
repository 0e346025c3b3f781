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

template <class V> FRETWORK_INLINE V with_sign_of(const V& sign, const V& size) {
  return sign < 0.0 ? -size : size;
}
/// 1 where the surface is not the opposite face, which is another one.
template <class V> FRETWORK_INLINE V same_face(const MemoryNumbers& memory, int l, const V& ny, const V& nz) {
  return rounded(at<V>(memory.normal_y + l) * ny) + at<V>(memory.normal_z + l) * nz < 0.0 ? V{} : V{} + 1.0;
}

/// N, what the spring of the contact's surface bears.
template <class V> FRETWORK_INLINE V held(const MemoryNumbers& memory, int l, const V& ny, const V& nz) {
  return same_face(memory, l, ny, nz) * at<V>(memory.spring + l);
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
                                       const V& mobility, const SweepRule& rule) {
  const V one = V{} + 1.0;
  const V a = rule.step_sixth * stiffness * mobility, share = 1.0 / (1.0 + a * (1.0 + 0.6 * a));
  const V closed = share * stiffness * p, per_step = p * rule.per_step;
  const V g = 12.0 * a * share, k = 1.0 - 2.0 * a + 0.6 * a * a;
  const V limit = rounded(0.5 * g * per_step) + contact::InstantSpring::smooth * magnitude(m),
          difference = rate - m;
  const V d = magnitude(difference) > limit ? with_sign_of(difference, limit) : difference;
  const V s = m + d, leaves = per_step + d;
  const V after2 = rounded(s * s) + g * per_step * (per_step - m) - 4.0 * (1.0 - k) * d * per_step;
  const V resolved = (a <= contact::InstantSpring::most ? one : V{}) * (p > 0.0 ? one : V{});
  const V closes = m > per_step ? resolved : V{};
  const V falls = (m < 0.5 * g * per_step ? resolved : V{}) * (leaves > 0.0 ? one : V{}),
          opens = k * leaves * leaves < after2 ? falls : V{};
  const V either = closes + opens;
  if (!any(either))
    return {closed, closed};
  const V v2 = rounded(s * s) - 4.0 * d * per_step,
          pushed = rounded(rule.step_sixth * stiffness * v2 * (1.0 - 0.3 * a));
  const V rest = rounded(k * v2) + (1.0 - 0.25 * g) * per_step * (rounded(4.0 * d) - g * per_step);
  const V rooted = root(clipped(closes > 0.0 ? rest : V(k * after2)));
  const V below = closes > 0.0 ? s + 0.5 * g * per_step + rooted : rooted - k * s;
  const V over = pushed + closed * (leaves + (closes > 0.0 ? s : -s));
  const V speed2 = closes > 0.0 ? V(k * v2) : after2; // times k
  const V angle2 = 12.0 * a * k * per_step * per_step / (either > 0.0 ? speed2 : one);
  const V instant = stiffness * p * (1.0 - angle2 * (1.0 / 6.0) * (1.0 - 0.05 * angle2));
  return {either > 0.0 ? over / (either > 0.0 ? below : one) : closed, either > 0.0 ? instant : closed};
}

/// Arrays of the motion that a step starts from, and displacements at the last action.
struct NearLanes {
  NearLanes(const MotionLanes& motion, const double* last_action)
      : near(motion.marks.data()), gap(motion.gaps.data()), ny(motion.normal_y.data()),
        nz(motion.normal_z.data()), velocity(motion.w.data()), displacement(motion.u.data()),
        last(last_action) {}
  const double *near, *gap, *ny, *nz, *velocity, *displacement, *last;
};

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
  const V v_n = rounded(my * y) + mz * z, v_t = rounded(mz * y) - my * z;
  const V yy = at<V>(law.yy + l), yz = at<V>(law.yz + l), zz = at<V>(law.zz + l);
  const V by_n_y = rounded(my * yy) + mz * yz,
          by_n_z = rounded(my * yz) + mz * zz; // of y and z by a force along n
  const V by_t_y = rounded(mz * yy) - my * yz, by_t_z = rounded(mz * yz) - my * zz; // along t
  const V nn = rounded(my * by_n_y) + mz * by_n_z, tt = rounded(mz * by_t_y) - my * by_t_z;
  const V moved = rounded(my * (at<V>(near.displacement + i) - at<V>(near.last + i))) +
                  mz * (at<V>(near.displacement + width + i) - at<V>(near.last + width + i));
  const auto [spring, instant] =
      instant_spring<V>(at<V>(law.stiffness + l), p, V(-moved * rule.per_step), V(-v_n), nn, rule);
  V damping{}, share = one;
  if (rule.damped) {
    damping = rounded(at<V>(law.dissipation + l) * spring);
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
          rounded(mz * by_n_y) - my * by_n_z,
          tt,
          held(memory, l, my, mz),
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

/// Whether forces of a contact can be found one after the other: 1 N along t adds nothing to the force along n.
FRETWORK_INLINE bool apart(const Laws<double>& c) {
  constexpr double round_off = 1e-14;
  return magnitude(c.share * c.damping * c.nt) <= round_off;
}
/// The forces of a contact that acts alone, N, from none; `apart`.
struct Alone {
  double normal, friction, slides; ///< N, N, 1 or 0
  double v_n, v_t;                 ///< m/s, mean of those before and after the action
  double work, jump;               ///< J, of ContactSolver::Action
  double loss;                     ///< J over the step, by the normal damper
};
/// @param loaded  N, what its tangential spring bears
FRETWORK_INLINE Alone solve_alone(const Laws<double>& c, const SweepRule& rule, const LawNumbers& law, int l,
                                  double loaded) {
  Alone a{};
  a.normal = clipped(c.spring - c.damping * c.v_n) * c.share;
  if (rule.implicit && a.normal > 0.0) {
    const Rub<double> rubs = rub<double>(loaded, law.gradient[l], c.share_t, c.bound, law.mu_dynamic[l],
                                         a.normal, c.v_t + c.nt * a.normal);
    a.friction = rubs.force;
    a.slides = rubs.slides;
  }
  const double n = a.normal, t = a.friction;
  a.v_n = c.v_n + c.nn * n + c.nt * t;
  a.v_t = c.v_t + c.nt * n + c.tt * t;
  a.work = rule.step * (n * a.v_n + t * a.v_t);
  a.jump = rule.step * (n * (a.v_n - c.v_n) + t * (a.v_t - c.v_t));
  a.loss = -rule.step * (n - c.spring) * a.v_n;
  return a;
}

/// What a contact did in a step: CommitNumbers; `closed` only where friction acts.
template <class V> struct Acted { V closed, normal_y, normal_z, force, displacement, slides; };
/// What became of it: works of its slider and its tangential damper, what all dampers took and forgotten springs had, what its spring has
/// gained, J; MemoryNumbers::left.
template <class V> struct Kept { V slider, damper, damping, stored, left; };
/// The memory of contacts that have acted, closed or open, advances.
template <class V>
FRETWORK_INLINE Kept<V> remember_step(const LawNumbers& law, MemoryNumbers& m, int l, const Acted<V>& s) {
  const V one = V{} + 1.0;
  const V half = 0.5 * at<V>(law.compliance + l);
  const V compliance = at<V>(law.compliance + l), e = at<V>(law.relaxation + l);
  const V closed = s.closed, open = one - closed;
  const V loaded = at<V>(m.spring + l), loaded_energy = half * loaded * loaded;
  // closed: the slider takes what the spring and damper do not, unless it would move with the force
  const V before = held(m, l, s.normal_y, s.normal_z), before_energy = half * before * before;
  const V force = s.force, dx = at<V>(law.along + l) * s.displacement;
  const V relaxed = force + e * (before - force), relaxed_stretch = compliance * (before - relaxed);
  const V against = force * (dx - relaxed_stretch) < 0.0 ? one : V{};
  const V slips = s.slides * (against + (force == 0.0 ? one : V{}));
  const V after_closed = slips > 0.0 ? relaxed : before - at<V>(law.tangential + l) * dx;
  const V stretch = slips > 0.0 ? relaxed_stretch : dx;
  const V slider = closed * -force * (dx - stretch);
  const V damper = closed * (-force * stretch - (half * after_closed * after_closed - before_energy));
  // open: the spring dies out and is forgotten
  const V fading = at<V>(m.left + l) * e, faded = fading < forgotten ? V{} : fading;
  const V after_open = faded > 0.0 ? e * loaded : V{};
  const V after = closed > 0.0 ? after_closed : after_open, after_energy = half * after * after;
  const V left = closed > 0.0 ? one : faded;
  at<V>(m.spring + l) = after;
  at<V>(m.sliding + l) = closed * s.slides;
  at<V>(m.force + l) = closed * force;
  at<V>(m.normal_y + l) = closed > 0.0 ? s.normal_y : at<V>(m.normal_y + l);
  at<V>(m.normal_z + l) = closed > 0.0 ? s.normal_z : at<V>(m.normal_z + l);
  at<V>(m.left + l) = left;
  return {slider, damper,
          damper + closed * (loaded_energy - before_energy) + open * (loaded_energy - after_energy),
          after_energy - loaded_energy, left};
}

/// Tangential part, along which friction acts, of the vectors (y, z) of contacts where they were closed last.
template <class V>
FRETWORK_INLINE V tangential(const LawNumbers& law, const MemoryNumbers& m, int l, const V& y, const V& z) {
  return at<V>(law.along + l) * (rounded(at<V>(m.normal_z + l) * y) - at<V>(m.normal_y + l) * z);
}

/// ContactMemory::follow of contacts that are remembered; vectors of all contacts, blocks of `width` lanes. Returns what their springs gain, J.
template <class V>
FRETWORK_INLINE V follow_step(int i, int width, const LawNumbers& law, MemoryNumbers& m, const double* u,
                              const double* last_u, const double* w, double half_step) {
  const int l = lane(i), z = width + i;
  const V sticks = at<V>(m.left + l) == 1.0 ? 1.0 - at<V>(m.sliding + l) : V{};
  const V missing = tangential<V>(law, m, l, at<V>(u + i) - at<V>(last_u + i) - half_step * at<V>(w + i),
                                  at<V>(u + z) - at<V>(last_u + z) - half_step * at<V>(w + z)) -
                    at<V>(m.ahead + l);
  const V before = at<V>(m.spring + l), by = -sticks * at<V>(law.tangential + l) * missing;
  at<V>(m.spring + l) = before + by;
  return at<V>(law.compliance + l) * by * (before + 0.5 * by);
}

} // namespace fretwork::transient::kernels
