// SPDX-License-Identifier: GPL-3.0-or-later
#include "transient/lane_laws.hpp"
#include <algorithm>
#include <array>
#include <span>

namespace fretwork::transient::kernels {
namespace {

// The kernels are written once for a grain G, a pack of contacts in the vectors of the processor or a double: a few contacts are faster one
// after the other.

/// What Jacobi sweeps foretell is less sure than what Gauss-Seidel sweeps do: the largest change moves from contact to contact.
constexpr double jacobi_caution = 0.1;
/// So few near contacts of several packs are solved one after the other.
constexpr int most_single = 2;

/// The same of contacts that `prepare` has met.
template <class V>
FRETWORK_INLINE Rub<V> rub_at(const LawNumbers& law, const StepNumbers& s, int l, const V& n, const V& free) {
  return rub<V>(at<V>(s.tangential + l), at<V>(law.gradient + l), at<V>(s.share_t + l), at<V>(s.bound + l),
                at<V>(law.mu_dynamic + l), n, free);
}

/// Which contacts are shut, their laws for the step, first forces; velocities before the action. Returns the energy of the springs, J.
template <class G>
FRETWORK_INLINE double prepare(std::span<const int> places, int width, const SweepRule& rule,
                               const LawLanes& laws, const MemoryLanes& memories, const NearLanes& near,
                               StepLanes& steps) {
  using V = typename G::V;
  const V one = V{} + 1.0;
  typename G::Sums energy = {};
  for_places<G>(
      places, [&](int i, auto part) __attribute__((always_inline)) {
        const int l = lane(i);
        const LawNumbers& law = laws[i];
        const MemoryNumbers& memory = memories[i];
        StepNumbers& s = steps[i];
        const Laws<V> c = laws_at<V>(i, width, rule, laws, memories, near);
        energy[part] += at<V>(law.stiffness + l) * c.depth * c.depth;
        const V acts = c.spring + c.damping;
        const V normal = acts > 0.0 ? clipped(c.spring - c.damping * c.v_n) * c.share : V{};
        const V most = at<V>(law.mu_dynamic + l) * normal;
        const V last =
            at<V>(memory.left + l) == 1.0
                ? same_face(memory, l, at<V>(near.ny + i), at<V>(near.nz + i)) * at<V>(memory.force + l)
                : V{};
        const V bears = c.spring + c.damping * magnitude(c.v_n);
        const V per_normal = acts > 0.0 ? 1.0 / (acts > 0.0 ? bears : one) : V{};
        at<V>(s.shut + l) = acts > 0.0 ? one : V{};
        at<V>(s.spring + l) = c.spring;
        at<V>(s.instant + l) = c.instant;
        at<V>(s.damping + l) = c.damping;
        at<V>(s.share + l) = acts > 0.0 ? c.share : V{};
        at<V>(s.nn + l) = c.nn;
        at<V>(s.nt + l) = c.nt;
        at<V>(s.tt + l) = c.tt;
        at<V>(s.tangential + l) = c.tangential;
        at<V>(s.bound + l) = c.bound;
        at<V>(s.share_t + l) = c.share_t;
        at<V>(s.per_normal + l) = per_normal;
        at<V>(s.per_friction + l) = per_normal * at<V>(law.per_mu + l);
        at<V>(s.normal + l) = normal;
        at<V>(s.friction + l) = magnitude(last) > most ? with_sign_of(last, most) : last;
        at<V>(s.before_n + l) = c.v_n;
        at<V>(s.before_t + l) = c.v_t;
        at<V>(s.v_y + l) = c.y;
        at<V>(s.v_z + l) = c.z;
      });
  return 0.5 * sum(energy);
}

/// Forces along n and t as forces along y and z, times half the step.
template <class V>
FRETWORK_INLINE void turn(const NearLanes& near, int i, double half_step, const V& n, const V& t,
                          StepNumbers& s) {
  const int l = lane(i);
  const V my = at<V>(near.ny + i), mz = at<V>(near.nz + i);
  at<V>(s.by_y + l) = half_step * (rounded(my * n) + mz * t);
  at<V>(s.by_z + l) = half_step * (rounded(mz * n) - my * t);
}

/// One Jacobi sweep over all lanes: forces follow, velocities do not. Returns the largest change, relative to what a contact can bear.
template <class G>
FRETWORK_INLINE double improve(std::span<const int> places, double half_step, const LawLanes& laws,
                               const NearLanes& near, StepLanes& steps) {
  using V = typename G::V;
  V worst{};
  for_places<G>(
      places, [&](int i, auto) __attribute__((always_inline)) {
        const int l = lane(i);
        const LawNumbers& law = laws[i];
        StepNumbers& s = steps[i];
        const V n0 = at<V>(s.normal + l), t0 = at<V>(s.friction + l), my = at<V>(near.ny + i),
                mz = at<V>(near.nz + i);
        const V v_n = rounded(my * at<V>(s.v_y + l)) + mz * at<V>(s.v_z + l),
                v_t = rounded(mz * at<V>(s.v_y + l)) - my * at<V>(s.v_z + l);
        const V rate = at<V>(s.nn + l) * n0 - v_n; // without this contact's normal force
        const V n =
            clipped(at<V>(s.spring + l) + at<V>(s.damping + l) * rate) * at<V>(s.share + l); // 0 if not shut
        const V dn = n - n0;
        const V free = v_t + at<V>(s.nt + l) * dn - at<V>(s.tt + l) * t0;
        const auto [t, slides] = rub_at<V>(law, s, l, n, free);
        const V dt = t - t0;
        turn<V>(near, i, half_step, dn, dt, s);
        at<V>(s.normal + l) = n;
        at<V>(s.friction + l) = t;
        at<V>(s.slides + l) = slides;
        const V change_n = at<V>(s.per_normal + l) * magnitude(dn),
                change_t = at<V>(s.per_friction + l) * magnitude(dt);
        worst = worst > change_n ? worst : change_n;
        worst = worst > change_t ? worst : change_t;
      });
  return largest(worst);
}

/// Velocities of all contacts follow the changes of the forces of those that take part: two sums at once, so that none waits for the other.
template <class G, bool coupled>
FRETWORK_INLINE void answer_planes(std::span<const int> places, int width, const MobilityLanes& mobility,
                                   StepLanes& steps) {
  using V = typename G::V;
  constexpr int columns = coupled ? 4 : 2;
  for_places<G>(
      places, [&](int i, auto) __attribute__((always_inline)) {
        const int l = lane(i);
        StepNumbers& s = steps[i];
        V y[2] = {at<V>(s.v_y + l), V{}}, z[2] = {at<V>(s.v_z + l), V{}};
        const auto add = [&](int k, int into) __attribute__((always_inline)) {
          const int c = steps.contacts[k];
          const double* column =
              &mobility.columns[static_cast<std::size_t>(c) * static_cast<std::size_t>(columns * width) + i];
          const double fy = steps[c].by_y[lane(c)], fz = steps[c].by_z[lane(c)];
          y[into] += fy * at<V>(column);
          z[into] += fz * at<V>(column + width);
          if (coupled) {
            z[into] += fy * at<V>(column + 2 * width);
            y[into] += fz * at<V>(column + 3 * width);
          }
        };
        int k = 0;
        for (; k + 1 < steps.count; k += 2) {
          add(k, 0);
          add(k + 1, 1);
        }
        if (k < steps.count)
          add(k, 0);
        at<V>(s.v_y + l) = y[0] + y[1];
        at<V>(s.v_z + l) = z[0] + z[1];
      });
}

template <class G>
FRETWORK_INLINE void answer_all(std::span<const int> places, int width, const MobilityLanes& mobility,
                                StepLanes& steps) {
  if (mobility.coupled)
    answer_planes<G, true>(places, width, mobility, steps);
  else
    answer_planes<G, false>(places, width, mobility, steps);
}

/// A_tt between the contacts that take part: what 1 N along the tangent of each adds to the tangential velocities of all.
template <class G>
FRETWORK_INLINE void tie_tangents(std::span<const int> places, int width, double half_step,
                                  const MobilityLanes& mobility, const NearLanes& near, StepLanes& steps) {
  using V = typename G::V;
  const int columns = mobility.coupled ? 4 : 2;
  for (int k = 0; k < steps.count; ++k) {
    const int c = steps.contacts[k];
    const double fy = half_step * near.nz[c], fz = -half_step * near.ny[c];
    const double* column =
        &mobility.columns[static_cast<std::size_t>(c) * static_cast<std::size_t>(columns * width)];
    double* ties = &steps.ties[static_cast<std::size_t>(k) * static_cast<std::size_t>(width)];
    for_places<G>(
        places, [&](int i, auto) __attribute__((always_inline)) {
          V y = rounded(fy * at<V>(column + i)), z = rounded(fz * at<V>(column + width + i));
          if (mobility.coupled) {
            z += fy * at<V>(column + 2 * width + i);
            y += fz * at<V>(column + 3 * width + i);
          }
          at<V>(ties + i) = rounded(at<V>(near.nz + i) * y) - at<V>(near.ny + i) * z;
        });
  }
}

/// Jacobi sweeps over frictions alone, where no damper lets normal forces answer velocities: from forces whose velocities are known.
template <class G>
FRETWORK_INLINE bool sweep_frictions(std::span<const int> places, int width, const SweepRule& rule,
                                     const LawLanes& laws, const MobilityLanes& mobility,
                                     const NearLanes& near, StepLanes& steps) {
  using V = typename G::V;
  const double half_step = 0.5 * rule.step;
  tie_tangents<G>(places, width, half_step, mobility, near, steps);
  for_places<G>(
      places, [&](int i, auto) __attribute__((always_inline)) {
        const int l = lane(i);
        StepNumbers& s = steps[i];
        at<V>(s.v_t + l) =
            rounded(at<V>(near.nz + i) * at<V>(s.v_y + l)) - at<V>(near.ny + i) * at<V>(s.v_z + l);
        at<V>(s.first + l) = at<V>(s.friction + l);
      });
  bool settles = false;
  double last = 0.0;
  for (int k = 0; k < rule.most && !settles; ++k) {
    V worst{};
    for_places<G>(
        places, [&](int i, auto) __attribute__((always_inline)) {
          const int l = lane(i);
          const LawNumbers& law = laws[i];
          StepNumbers& s = steps[i];
          const V n = at<V>(s.normal + l), t0 = at<V>(s.friction + l);
          const V free = at<V>(s.v_t + l) - at<V>(s.tt + l) * t0; // without this contact's friction
          const auto [t, slides] = rub_at<V>(law, s, l, n, free);
          const V dt = t - t0;
          at<V>(s.by_t + l) = dt;
          at<V>(s.friction + l) = t;
          at<V>(s.slides + l) = slides;
          const V change = at<V>(s.per_friction + l) * magnitude(dt);
          worst = worst > change ? worst : change;
        });
    for_places<G>(
        places, [&](int i, auto) __attribute__((always_inline)) {
          const int l = lane(i);
          StepNumbers& s = steps[i];
          V v[2] = {at<V>(s.v_t + l), V{}};
          for (int j = 0; j < steps.count; ++j)
            v[j % 2] += steps[steps.contacts[j]].by_t[lane(steps.contacts[j])] *
                        at<V>(&steps.ties[static_cast<std::size_t>(j) * static_cast<std::size_t>(width) + i]);
          at<V>(s.v_t + l) = v[0] + v[1];
        });
    const double change = largest(worst);
    settles = settled(change, last, rule.tolerance, jacobi_caution);
    last = change;
  }
  if (!settles)
    return false;
  for_places<G>(
      places, [&](int i, auto) __attribute__((always_inline)) {
        const int l = lane(i);
        StepNumbers& s = steps[i];
        turn<V>(near, i, half_step, V{}, V(at<V>(s.friction + l) - at<V>(s.first + l)), s);
      });
  answer_all<G>(places, width, mobility, steps);
  return true;
}

/// Returns whether the sweeps settled.
template <class G>
FRETWORK_INLINE bool sweep(std::span<const int> places, int width, const SweepRule& rule,
                           const LawLanes& laws, const MobilityLanes& mobility, const NearLanes& near,
                           StepLanes& steps) {
  using V = typename G::V;
  const double half_step = 0.5 * rule.step;
  for_places<G>(
      places, [&](int i, auto) __attribute__((always_inline)) {
        const int l = lane(i);
        StepNumbers& s = steps[i];
        turn<V>(near, i, half_step, at<V>(s.normal + l), at<V>(s.friction + l), s);
      });
  answer_all<G>(places, width, mobility, steps);
  if (!rule.implicit)
    return true;
  if (!rule.damped)
    return sweep_frictions<G>(places, width, rule, laws, mobility, near, steps);
  double last = 0.0;
  for (int k = 0; k < rule.most; ++k) {
    const double change = improve<G>(places, half_step, laws, near, steps);
    answer_all<G>(places, width, mobility, steps);
    if (settled(change, last, rule.tolerance, jacobi_caution))
      return true;
    last = change;
  }
  return false;
}

/// Forces found: what the contacts did over the step.
template <class G>
FRETWORK_INLINE void close(std::span<const int> places, const SweepRule& rule, const LawLanes& laws,
                           const NearLanes& near, StepLanes& steps, CommitLanes& commits, Solved& solved) {
  using V = typename G::V;
  const V one = V{} + 1.0;
  typename G::Sums work = {}, jump = {};
  for_places<G>(
      places, [&](int i, auto part) __attribute__((always_inline)) {
        const int l = lane(i);
        const LawNumbers& law = laws[i];
        StepNumbers& s = steps[i];
        CommitNumbers& out = commits[i];
        const V my = at<V>(near.ny + i), mz = at<V>(near.nz + i), n = at<V>(s.normal + l),
                t = at<V>(s.friction + l);
        const V v_n = rounded(my * at<V>(s.v_y + l)) + mz * at<V>(s.v_z + l),
                v_t = rounded(mz * at<V>(s.v_y + l)) - my * at<V>(s.v_z + l);
        work[part] += rounded(n * v_n) + t * v_t;
        jump[part] += rounded(n * (v_n - at<V>(s.before_n + l))) + t * (v_t - at<V>(s.before_t + l));
        at<V>(s.cut + l) = -rule.step * (n - at<V>(s.spring + l)) * v_n;
        at<V>(out.closed + l) = n > 0.0 ? one : V{};
        at<V>(out.normal_y + l) = my;
        at<V>(out.normal_z + l) = mz;
        at<V>(out.force + l) = t;
        at<V>(out.displacement + l) = rule.step * at<V>(law.along + l) * v_t;
        at<V>(out.slides + l) = at<V>(s.slides + l);
      });
  solved.work = rule.step * sum(work);
  solved.jump = rule.step * sum(jump);
}

template <class G>
FRETWORK_INLINE Solved solve_all(std::span<const int> places, int width, const SweepRule& rule,
                                 const LawLanes& laws, const MemoryLanes& memories,
                                 const MobilityLanes& mobility, const NearLanes& near, StepLanes& steps,
                                 CommitLanes& commits) {
  Solved solved;
  solved.springs = prepare<G>(places, width, rule, laws, memories, near, steps);
  steps.count = 0;
  for (const int i : places)
    for (int c = i; c < i + G::together; ++c)
      if (steps[c].shut[lane(c)] != 0.0)
        steps.contacts[steps.count++] = c;
  if (steps.count == 0)
    return solved;
  solved.settled = sweep<G>(places, width, rule, laws, mobility, near, steps);
  if (solved.settled)
    close<G>(places, rule, laws, near, steps, commits, solved);
  return solved;
}

template <class Widest>
FRETWORK_INLINE Solved solve_on(const SweepRule& rule, const LawLanes& laws, const MemoryLanes& memories,
                                const MobilityLanes& mobility, const MotionLanes& motion, const double* last,
                                StepLanes& steps, CommitLanes& commits) {
  const NearLanes near(motion, last);
  const Places& places = motion.places;
  const int width = places.all.width;
  const auto solve = [&]<class G>(std::span<const int> of, G) __attribute__((always_inline)) {
    return solve_all<G>(of, width, rule, laws, memories, mobility, near, steps, commits);
  };
  if (places.near > (places.all.half() ? 1 : most_single))
    return by_grain<Widest>(
        places.all, [&](auto grain) __attribute__((always_inline)) { return solve(places.first, grain); });
  std::array<int, most_single> single;
  std::size_t count = 0;
  for (const int i : places.first)
    for (int c = i; c < i + places.all.together(); ++c) {
      commits[c].closed[lane(c)] = 0.0;
      if (near.near[c] > 0.0)
        single[count++] = c;
    }
  return solve({single.data(), count}, Grain<Widest, double>{});
}

} // namespace

FRETWORK_KERNEL(Solved, solve,
                (const SweepRule& rule, const LawLanes& laws, const MemoryLanes& memories,
                 const MobilityLanes& mobility, const MotionLanes& motion, const double* last,
                 StepLanes& steps, CommitLanes& commits),
                (rule, laws, memories, mobility, motion, last, steps, commits))

} // namespace fretwork::transient::kernels
