// SPDX-License-Identifier: GPL-3.0-or-later
#include "transient/contact_lanes.hpp"
#include "contact/instant_spring.hpp"
#include "transient/packed_contacts.hpp"
#include "transient/vector_lanes.hpp"
#include <algorithm>
#include <array>
#include <span>

namespace fretwork::transient::kernels {
namespace {

// The kernels are written once for a grain G, a pack of contacts in the vectors of the processor or a double: a few contacts are faster one
// after the other.

/// What Jacobi sweeps foretell is less sure than what Gauss-Seidel sweeps do: the largest change moves from contact to contact.
constexpr double jacobi_caution = 0.1;
constexpr double round_off = 1e-14; ///< of a force
/// So few near contacts of several packs are solved one after the other.
constexpr int most_single = 2;

// Flags are packs of 1 and 0, and choices are made by one comparison each: compilers turn these into a vector operation, and masks that
// are joined into many scalar ones.
template <class V> FRETWORK_INLINE V clipped(const V& p) { return p > 0.0 ? p : V{}; }
template <class V> FRETWORK_INLINE V with_sign_of(const V& sign, const V& size) {
  return sign < 0.0 ? -size : size;
}
/// 1 where the surface is not the opposite face, which is another one.
template <class V> FRETWORK_INLINE V same_face(const MemoryLanes& m, int i, const V& ny, const V& nz) {
  return at<V>(&m.normal_y[i]) * ny + at<V>(&m.normal_z[i]) * nz < 0.0 ? V{} : V{} + 1.0;
}

} // namespace

LawLanes::LawLanes(const PackedContacts& contacts, double step) {
  for (Array* a : {&stiffness, &damping, &dissipation, &yy, &yz, &zz, &tangential, &compliance, &gradient,
                   &relaxation, &mu_static, &mu_dynamic, &along, &per_mu})
    a->assign(static_cast<std::size_t>(contacts.width), 0.0);
  for (int c = 0; c < contacts.count; ++c) {
    const contact::Support& support = contacts.supports[c];
    stiffness[c] = support.normal.stiffness;
    damping[c] = support.normal.damping;
    dissipation[c] = support.normal.dissipation;
    yy[c] = 0.5 * step * contacts.own_mobility(c, 0, 0);
    yz[c] = 0.5 * step * contacts.own_mobility(c, 0, 1);
    zz[c] = 0.5 * step * contacts.own_mobility(c, 1, 1);
    const contact::FrictionLaw& friction = support.friction;
    if (!friction.active())
      continue;
    const auto table = contact::friction_table(friction, step);
    along[c] = friction.along.t;
    tangential[c] = friction.stiffness;
    compliance[c] = table.compliance;
    gradient[c] = friction.along.t * table.gradient;
    relaxation[c] = table.relaxation;
    mu_static[c] = friction.mu_static;
    mu_dynamic[c] = friction.mu_dynamic;
    per_mu[c] = friction.mu_static > 0.0 ? 1.0 / friction.mu_static : 0.0;
  }
}

StepLanes::StepLanes(int width, bool ties_tangents) {
  for (Array* a :
       {&shut,       &spring,     &damping,      &share,  &nn,       &nt,       &tt,   &bound, &share_t,
        &tangential, &per_normal, &per_friction, &normal, &friction, &slides,   &by_y, &by_z,  &by_t,
        &v_y,        &v_z,        &v_t,          &first,  &before_n, &before_t, &cut})
    a->assign(static_cast<std::size_t>(width), 0.0);
  if (ties_tangents)
    ties.assign(static_cast<std::size_t>(width) * static_cast<std::size_t>(width), 0.0);
  contacts.assign(static_cast<std::size_t>(width), 0);
}

CommitLanes::CommitLanes(int width) {
  for (Array* a :
       {&closed, &normal_y, &normal_z, &force, &displacement, &slides, &friction_work, &damper_work})
    a->assign(static_cast<std::size_t>(width), 0.0);
}

namespace {

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

/// Which contacts are shut, their laws for the step, first forces; velocities before the action. Returns the energy of the springs, J.
template <class G>
FRETWORK_INLINE double prepare(std::span<const int> places, const SweepRule& rule, const LawLanes& law,
                               const MemoryLanes& memory, const NearLanes& near, StepLanes& s) {
  using V = typename G::V;
  const V one = V{} + 1.0;
  typename G::Sums energy = {};
  for_places<G>(
      places, [&](int i, auto part) __attribute__((always_inline)) {
        const V g = at<V>(near.gap + i), my = at<V>(near.ny + i), mz = at<V>(near.nz + i);
        const V y = at<V>(near.vy + i), z = at<V>(near.vz + i);
        const V k = at<V>(&law.stiffness[i]), p = clipped(-g);
        energy[part] += k * p * p;
        const V v_n = my * y + mz * z, v_t = mz * y - my * z;
        const V yy = at<V>(&law.yy[i]), yz = at<V>(&law.yz[i]), zz = at<V>(&law.zz[i]);
        const V by_n_y = my * yy + mz * yz, by_n_z = my * yz + mz * zz; // of y and z by a force along n
        const V by_t_y = mz * yy - my * yz, by_t_z = mz * yz - my * zz; // along t
        const V nn = my * by_n_y + mz * by_n_z, tt = mz * by_t_y - my * by_t_z;
        const V moved = my * (at<V>(near.uy + i) - at<V>(near.last_uy + i)) +
                        mz * (at<V>(near.uz + i) - at<V>(near.last_uz + i));
        const V spring = instant_spring<V>(k, p, moved * (-1.0 / rule.step), nn, rule.step);
        V damping{}, share = one;
        if (rule.damped) {
          damping = at<V>(&law.dissipation[i]) * spring;
          if (rule.half_window > 0.0)
            damping += closed_share(V(-g), V(rule.half_window * magnitude(v_n))) * at<V>(&law.damping[i]);
          share = 1.0 / (1.0 + damping * nn);
        }
        const V acts = spring + damping;
        const V normal = acts > 0.0 ? clipped(spring - damping * v_n) * share : V{};
        const V keeps = same_face(memory, i, my, mz);
        const V mu = at<V>(&law.mu_dynamic[i]), most = mu * normal;
        const V last = at<V>(&memory.left[i]) == 1.0 ? keeps * at<V>(&memory.force[i]) : V{};
        const V bears = spring + damping * magnitude(v_n);
        const V per_normal = acts > 0.0 ? 1.0 / (acts > 0.0 ? bears : one) : V{};
        const V mu_static = at<V>(&law.mu_static[i]);
        at<V>(&s.shut[i]) = acts > 0.0 ? one : V{};
        at<V>(&s.spring[i]) = spring;
        at<V>(&s.damping[i]) = damping;
        at<V>(&s.share[i]) = acts > 0.0 ? share : V{};
        at<V>(&s.nn[i]) = nn;
        at<V>(&s.nt[i]) = mz * by_n_y - my * by_n_z;
        at<V>(&s.tt[i]) = tt;
        at<V>(&s.tangential[i]) = keeps * at<V>(&memory.spring[i]);
        at<V>(&s.bound[i]) = keeps * at<V>(&memory.sliding[i]) > 0.0 ? mu : mu_static;
        at<V>(&s.share_t[i]) = mu_static > 0.0 ? 1.0 / (1.0 + at<V>(&law.gradient[i]) * tt) : V{};
        at<V>(&s.per_normal[i]) = per_normal;
        at<V>(&s.per_friction[i]) = per_normal * at<V>(&law.per_mu[i]);
        at<V>(&s.normal[i]) = normal;
        at<V>(&s.friction[i]) = magnitude(last) > most ? with_sign_of(last, most) : last;
        at<V>(&s.before_n[i]) = v_n;
        at<V>(&s.before_t[i]) = v_t;
        at<V>(&s.v_y[i]) = y;
        at<V>(&s.v_z[i]) = z;
      });
  return 0.5 * sum(energy);
}

/// Forces along n and t as forces along y and z, times half the step.
template <class V>
FRETWORK_INLINE void turn(const NearLanes& near, int i, double half_step, const V& n, const V& t,
                          StepLanes& s) {
  const V my = at<V>(near.ny + i), mz = at<V>(near.nz + i);
  at<V>(&s.by_y[i]) = half_step * (my * n + mz * t);
  at<V>(&s.by_z[i]) = half_step * (mz * n - my * t);
}

/// One Jacobi sweep over all lanes: forces follow, velocities do not. Returns the largest change, relative to what a contact can bear.
template <class G>
FRETWORK_INLINE double improve(std::span<const int> places, double half_step, const LawLanes& law,
                               const NearLanes& near, StepLanes& s) {
  using V = typename G::V;
  const V one = V{} + 1.0;
  V worst{};
  for_places<G>(
      places, [&](int i, auto) __attribute__((always_inline)) {
        const V n0 = at<V>(&s.normal[i]), t0 = at<V>(&s.friction[i]), my = at<V>(near.ny + i),
                mz = at<V>(near.nz + i);
        const V v_n = my * at<V>(&s.v_y[i]) + mz * at<V>(&s.v_z[i]),
                v_t = mz * at<V>(&s.v_y[i]) - my * at<V>(&s.v_z[i]);
        const V rate = at<V>(&s.nn[i]) * n0 - v_n; // without this contact's normal force
        const V n =
            clipped(at<V>(&s.spring[i]) + at<V>(&s.damping[i]) * rate) * at<V>(&s.share[i]); // 0 if not shut
        const V dn = n - n0;
        const V free = v_t + at<V>(&s.nt[i]) * dn - at<V>(&s.tt[i]) * t0;
        const V stick = (at<V>(&s.tangential[i]) - at<V>(&law.gradient[i]) * free) * at<V>(&s.share_t[i]);
        const V most = at<V>(&law.mu_dynamic[i]) * n;
        const V slides = magnitude(stick) > at<V>(&s.bound[i]) * n ? one : V{};
        const V t = slides > 0.0 ? with_sign_of(stick, most) : stick;
        const V dt = t - t0;
        turn<V>(near, i, half_step, dn, dt, s);
        at<V>(&s.normal[i]) = n;
        at<V>(&s.friction[i]) = t;
        at<V>(&s.slides[i]) = slides;
        const V change_n = at<V>(&s.per_normal[i]) * magnitude(dn),
                change_t = at<V>(&s.per_friction[i]) * magnitude(dt);
        worst = worst > change_n ? worst : change_n;
        worst = worst > change_t ? worst : change_t;
      });
  return largest(worst);
}

/// Velocities of all contacts follow the changes of the forces of those that take part: two sums at once, so that none waits for the other.
template <class G, bool coupled>
FRETWORK_INLINE void answer_planes(std::span<const int> places, int width, const MobilityLanes& mobility,
                                   StepLanes& s) {
  using V = typename G::V;
  constexpr int columns = coupled ? 4 : 2;
  for_places<G>(
      places, [&](int i, auto) __attribute__((always_inline)) {
        V y[2] = {at<V>(&s.v_y[i]), V{}}, z[2] = {at<V>(&s.v_z[i]), V{}};
        const auto add = [&](int k, int into) __attribute__((always_inline)) {
          const auto c = static_cast<std::size_t>(s.contacts[k]);
          const double* column = &mobility.columns[c * static_cast<std::size_t>(columns * width) + i];
          const double fy = s.by_y[c], fz = s.by_z[c];
          y[into] += fy * at<V>(column);
          z[into] += fz * at<V>(column + width);
          if (coupled) {
            z[into] += fy * at<V>(column + 2 * width);
            y[into] += fz * at<V>(column + 3 * width);
          }
        };
        int k = 0;
        for (; k + 1 < s.count; k += 2) {
          add(k, 0);
          add(k + 1, 1);
        }
        if (k < s.count)
          add(k, 0);
        at<V>(&s.v_y[i]) = y[0] + y[1];
        at<V>(&s.v_z[i]) = z[0] + z[1];
      });
}

template <class G>
FRETWORK_INLINE void answer_all(std::span<const int> places, int width, const MobilityLanes& mobility,
                                StepLanes& s) {
  if (mobility.coupled)
    answer_planes<G, true>(places, width, mobility, s);
  else
    answer_planes<G, false>(places, width, mobility, s);
}

/// One contact takes part and its friction does not act on its normal force: one sweep finds both, from any forces.
FRETWORK_INLINE bool sweeps_once(const StepLanes& s) {
  const int c = s.contacts[0];
  const double coupling = s.share[c] * s.damping[c] * s.nt[c]; // N along n by 1 N along t
  return s.count == 1 && coupling <= round_off && -coupling <= round_off;
}

/// A_tt between the contacts that take part: what 1 N along the tangent of each adds to the tangential velocities of all.
template <class G>
FRETWORK_INLINE void tie_tangents(std::span<const int> places, int width, double half_step,
                                  const MobilityLanes& mobility, const NearLanes& near, StepLanes& s) {
  using V = typename G::V;
  const int columns = mobility.coupled ? 4 : 2;
  for (int k = 0; k < s.count; ++k) {
    const int c = s.contacts[k];
    const double fy = half_step * near.nz[c], fz = -half_step * near.ny[c];
    const double* column =
        &mobility.columns[static_cast<std::size_t>(c) * static_cast<std::size_t>(columns * width)];
    double* ties = &s.ties[static_cast<std::size_t>(k) * static_cast<std::size_t>(width)];
    for_places<G>(
        places, [&](int i, auto) __attribute__((always_inline)) {
          V y = fy * at<V>(column + i), z = fz * at<V>(column + width + i);
          if (mobility.coupled) {
            z += fy * at<V>(column + 2 * width + i);
            y += fz * at<V>(column + 3 * width + i);
          }
          at<V>(ties + i) = at<V>(near.nz + i) * y - at<V>(near.ny + i) * z;
        });
  }
}

/// Jacobi sweeps over frictions alone, where no damper lets normal forces answer velocities: from forces whose velocities are known.
template <class G>
FRETWORK_INLINE bool sweep_frictions(std::span<const int> places, int width, const SweepRule& rule,
                                     const LawLanes& law, const MobilityLanes& mobility,
                                     const NearLanes& near, StepLanes& s) {
  using V = typename G::V;
  const double half_step = 0.5 * rule.step;
  const V one = V{} + 1.0;
  tie_tangents<G>(places, width, half_step, mobility, near, s);
  for_places<G>(
      places, [&](int i, auto) __attribute__((always_inline)) {
        at<V>(&s.v_t[i]) = at<V>(near.nz + i) * at<V>(&s.v_y[i]) - at<V>(near.ny + i) * at<V>(&s.v_z[i]);
        at<V>(&s.first[i]) = at<V>(&s.friction[i]);
      });
  bool settles = false;
  double last = 0.0;
  for (int k = 0; k < rule.most && !settles; ++k) {
    V worst{};
    for_places<G>(
        places, [&](int i, auto) __attribute__((always_inline)) {
          const V n = at<V>(&s.normal[i]), t0 = at<V>(&s.friction[i]);
          const V free = at<V>(&s.v_t[i]) - at<V>(&s.tt[i]) * t0; // without this contact's friction
          const V stick = (at<V>(&s.tangential[i]) - at<V>(&law.gradient[i]) * free) * at<V>(&s.share_t[i]);
          const V most = at<V>(&law.mu_dynamic[i]) * n;
          const V slides = magnitude(stick) > at<V>(&s.bound[i]) * n ? one : V{};
          const V t = slides > 0.0 ? with_sign_of(stick, most) : stick, dt = t - t0;
          at<V>(&s.by_t[i]) = dt;
          at<V>(&s.friction[i]) = t;
          at<V>(&s.slides[i]) = slides;
          const V change = at<V>(&s.per_friction[i]) * magnitude(dt);
          worst = worst > change ? worst : change;
        });
    for_places<G>(
        places, [&](int i, auto) __attribute__((always_inline)) {
          V v[2] = {at<V>(&s.v_t[i]), V{}};
          for (int j = 0; j < s.count; ++j)
            v[j % 2] += s.by_t[s.contacts[j]] *
                        at<V>(&s.ties[static_cast<std::size_t>(j) * static_cast<std::size_t>(width) + i]);
          at<V>(&s.v_t[i]) = v[0] + v[1];
        });
    const double change = largest(worst);
    settles = settled(change, last, rule.tolerance, jacobi_caution);
    last = change;
  }
  if (!settles)
    return false;
  for_places<G>(
      places, [&](int i, auto) __attribute__((always_inline)) {
        turn<V>(near, i, half_step, V{}, V(at<V>(&s.friction[i]) - at<V>(&s.first[i])), s);
      });
  answer_all<G>(places, width, mobility, s);
  return true;
}

/// Returns whether the sweeps settled.
template <class G>
FRETWORK_INLINE bool sweep(std::span<const int> places, int width, const SweepRule& rule, const LawLanes& law,
                           const MobilityLanes& mobility, const NearLanes& near, StepLanes& s) {
  using V = typename G::V;
  const double half_step = 0.5 * rule.step;
  const bool once = rule.implicit && sweeps_once(s);
  if (once) { // from none: these velocities are known
    s.normal[s.contacts[0]] = 0.0;
    s.friction[s.contacts[0]] = 0.0;
  } else {
    for_places<G>(
        places, [&](int i, auto) __attribute__((always_inline)) {
          turn<V>(near, i, half_step, at<V>(&s.normal[i]), at<V>(&s.friction[i]), s);
        });
    answer_all<G>(places, width, mobility, s);
    if (!rule.implicit)
      return true;
    if (!rule.damped)
      return sweep_frictions<G>(places, width, rule, law, mobility, near, s);
  }
  double last = 0.0;
  for (int k = 0; k < rule.most; ++k) {
    const double change = improve<G>(places, half_step, law, near, s);
    answer_all<G>(places, width, mobility, s);
    if (once || settled(change, last, rule.tolerance, jacobi_caution))
      return true;
    last = change;
  }
  return false;
}

/// Forces found: what the contacts did over the step.
template <class G>
FRETWORK_INLINE void close(std::span<const int> places, const SweepRule& rule, const LawLanes& law,
                           const NearLanes& near, StepLanes& s, CommitLanes& out, Solved& solved) {
  using V = typename G::V;
  const V one = V{} + 1.0;
  typename G::Sums work = {}, jump = {};
  for_places<G>(
      places, [&](int i, auto part) __attribute__((always_inline)) {
        const V my = at<V>(near.ny + i), mz = at<V>(near.nz + i), n = at<V>(&s.normal[i]),
                t = at<V>(&s.friction[i]);
        const V v_n = my * at<V>(&s.v_y[i]) + mz * at<V>(&s.v_z[i]),
                v_t = mz * at<V>(&s.v_y[i]) - my * at<V>(&s.v_z[i]);
        work[part] += n * v_n + t * v_t;
        jump[part] += n * (v_n - at<V>(&s.before_n[i])) + t * (v_t - at<V>(&s.before_t[i]));
        at<V>(&s.cut[i]) = -rule.step * (n - at<V>(&s.spring[i])) * v_n;
        at<V>(&out.closed[i]) = n > 0.0 ? one : V{};
        at<V>(&out.normal_y[i]) = my;
        at<V>(&out.normal_z[i]) = mz;
        at<V>(&out.force[i]) = t;
        at<V>(&out.displacement[i]) = rule.step * at<V>(&law.along[i]) * v_t;
        at<V>(&out.slides[i]) = at<V>(&s.slides[i]);
      });
  solved.work = rule.step * sum(work);
  solved.jump = rule.step * sum(jump);
}

template <class G>
FRETWORK_INLINE Solved solve_all(std::span<const int> places, int width, const SweepRule& rule,
                                 const LawLanes& law, const MemoryLanes& memory,
                                 const MobilityLanes& mobility, const NearLanes& near, StepLanes& step,
                                 CommitLanes& out) {
  Solved solved;
  solved.springs = prepare<G>(places, rule, law, memory, near, step);
  step.count = 0;
  for (const int i : places)
    for (int c = i; c < i + G::parts * size_of<typename G::V>; ++c)
      if (step.shut[c] != 0.0)
        step.contacts[step.count++] = c;
  if (step.count == 0)
    return solved;
  solved.settled = sweep<G>(places, width, rule, law, mobility, near, step);
  if (solved.settled)
    close<G>(places, rule, law, near, step, out, solved);
  return solved;
}

template <class G> struct CommitParts {
  typename G::Sums sliders = {}, damping = {}, stored = {};
};

/// Contacts of which some acted. Returns whether any remembers something.
template <class G>
FRETWORK_INLINE bool keep(int i, auto part, const LawLanes& law, CommitLanes& s, MemoryLanes& m,
                          CommitParts<G>& sums) {
  using V = typename G::V;
  const V one = V{} + 1.0;
  const V my = at<V>(&s.normal_y[i]), mz = at<V>(&s.normal_z[i]), half = 0.5 * at<V>(&law.compliance[i]);
  const V compliance = at<V>(&law.compliance[i]), e = at<V>(&law.relaxation[i]);
  const V closed = at<V>(&law.mu_static[i]) > 0.0 ? at<V>(&s.closed[i]) : V{}, open = one - closed;
  const V held = at<V>(&m.spring[i]), held_energy = half * held * held;
  // closed: the slider takes what the spring and damper do not, unless it would move with the force
  const V before = same_face(m, i, my, mz) * held, before_energy = half * before * before;
  const V force = at<V>(&s.force[i]), dx = at<V>(&law.along[i]) * at<V>(&s.displacement[i]);
  const V relaxed = force + e * (before - force), relaxed_stretch = compliance * (before - relaxed);
  const V against = force * (dx - relaxed_stretch) < 0.0 ? one : V{};
  const V slips = at<V>(&s.slides[i]) * (against + (force == 0.0 ? one : V{}));
  const V after_closed = slips > 0.0 ? relaxed : before - at<V>(&law.tangential[i]) * dx;
  const V stretch = slips > 0.0 ? relaxed_stretch : dx;
  const V slider = closed * -force * (dx - stretch);
  const V damper = closed * (-force * stretch - (half * after_closed * after_closed - before_energy));
  // open: the spring dies out and is forgotten
  const V fading = at<V>(&m.left[i]) * e, faded = fading < forgotten ? V{} : fading;
  const V after_open = faded > 0.0 ? e * held : V{};
  const V after = closed > 0.0 ? after_closed : after_open, after_energy = half * after * after;
  sums.sliders[part] += slider;
  sums.damping[part] += damper + closed * (held_energy - before_energy) + open * (held_energy - after_energy);
  sums.stored[part] += after_energy - held_energy;
  at<V>(&s.friction_work[i]) = slider;
  at<V>(&s.damper_work[i]) = damper;
  at<V>(&m.spring[i]) = after;
  at<V>(&m.sliding[i]) = closed * at<V>(&s.slides[i]);
  at<V>(&m.force[i]) = closed * force;
  at<V>(&m.normal_y[i]) = closed > 0.0 ? my : at<V>(&m.normal_y[i]);
  at<V>(&m.normal_z[i]) = closed > 0.0 ? mz : at<V>(&m.normal_z[i]);
  const V left = closed > 0.0 ? one : faded;
  at<V>(&m.left[i]) = left;
  return any(left);
}

/// Contacts that are all open: what `keep` makes of them.
template <class G>
FRETWORK_INLINE bool fade(int i, auto part, const LawLanes& law, MemoryLanes& m, CommitParts<G>& sums) {
  using V = typename G::V;
  const V e = at<V>(&law.relaxation[i]), held = at<V>(&m.spring[i]);
  const V fading = at<V>(&m.left[i]) * e, left = fading < forgotten ? V{} : fading;
  const V after = left > 0.0 ? e * held : V{};
  const V lost = 0.5 * at<V>(&law.compliance[i]) * (held * held - after * after);
  sums.damping[part] += lost;
  sums.stored[part] -= lost;
  at<V>(&m.spring[i]) = after;
  at<V>(&m.sliding[i]) = at<V>(&m.force[i]) = V{};
  at<V>(&m.left[i]) = left;
  return any(left);
}

template <class G>
FRETWORK_INLINE CommitSums commit_all(const Places& acting, const LawLanes& law, CommitLanes& s,
                                      MemoryLanes& m) {
  CommitParts<G> sums;
  m.next.clear();
  auto old = m.places.begin();
  const auto remember = [&](int place, const auto& one) __attribute__((always_inline)) {
    bool any = false;
    for_parts<G>([&](auto part) __attribute__((always_inline)) {
      any |= one(place + part * size_of<typename G::V>, part);
    });
    if (any)
      m.next.push_back(place);
  };
  const auto fade_before = [&](int end) __attribute__((always_inline)) {
    for (; old != m.places.end() && *old < end; ++old)
      remember(
          *old, [&](int i, auto part)
                    __attribute__((always_inline)) { return fade<G>(i, part, law, m, sums); });
  };
  for (const int place : acting.first) {
    fade_before(place);
    old += old != m.places.end() && *old == place;
    remember(
        place, [&](int i, auto part)
                   __attribute__((always_inline)) { return keep<G>(i, part, law, s, m, sums); });
  }
  fade_before(acting.all.width);
  m.places.swap(m.next);
  return {sum(sums.sliders), sum(sums.damping), sum(sums.stored)};
}

template <class Widest>
FRETWORK_INLINE Solved solve_on(const Places& places, const SweepRule& rule, const LawLanes& law,
                                const MemoryLanes& memory, const MobilityLanes& mobility,
                                const NearLanes& near, StepLanes& step, CommitLanes& out) {
  using Single = Grain<Widest, double>;
  const int width = places.all.width;
  if (places.all.few())
    return solve_all<Single>(places.first, width, rule, law, memory, mobility, near, step, out);
  if (places.all.half())
    return solve_all<Grain<Widest, Half>>(places.first, width, rule, law, memory, mobility, near, step, out);
  if (places.near > most_single)
    return solve_all<Grain<Widest, Pack>>(places.first, width, rule, law, memory, mobility, near, step, out);
  std::array<int, most_single> single;
  std::size_t count = 0;
  for (const int i : places.first) {
    std::fill_n(&out.closed[i], lanes, 0.0);
    for (int c = i; c < i + lanes; ++c)
      if (near.near[c] > 0.0)
        single[count++] = c;
  }
  return solve_all<Single>({single.data(), count}, width, rule, law, memory, mobility, near, step, out);
}

template <class Widest>
FRETWORK_INLINE CommitSums commit_on(const Places& acting, const LawLanes& law, CommitLanes& step,
                                     MemoryLanes& memory) {
  if (acting.all.few())
    return commit_all<Grain<Widest, double>>(acting, law, step, memory);
  if (acting.all.half())
    return commit_all<Grain<Widest, Half>>(acting, law, step, memory);
  return commit_all<Grain<Widest, Pack>>(acting, law, step, memory);
}

} // namespace

FRETWORK_KERNEL(Solved, solve,
                (const Places& places, const SweepRule& rule, const LawLanes& law, const MemoryLanes& memory,
                 const MobilityLanes& mobility, const NearLanes& near, StepLanes& step, CommitLanes& out),
                (places, rule, law, memory, mobility, near, step, out))
FRETWORK_KERNEL(CommitSums, commit,
                (const Places& acting, const LawLanes& law, CommitLanes& step, MemoryLanes& memory),
                (acting, law, step, memory))

} // namespace fretwork::transient::kernels
