// SPDX-License-Identifier: GPL-3.0-or-later
#include "transient/contact_lanes.hpp"
#include "transient/lane_laws.hpp"
#include "transient/packed_contacts.hpp"
#include <algorithm>

namespace fretwork::transient::kernels {

LawLanes law_lanes(const PackedContacts& contacts, double step) {
  LawLanes laws(contacts.width);
  for (int c = 0; c < contacts.count; ++c) {
    const contact::Support& support = contacts.supports[c];
    LawNumbers& law = laws[c];
    const int l = lane(c);
    law.stiffness[l] = support.normal.stiffness;
    law.damping[l] = support.normal.damping;
    law.dissipation[l] = support.normal.dissipation;
    law.yy[l] = 0.5 * step * contacts.own_mobility(c, 0, 0);
    law.yz[l] = 0.5 * step * contacts.own_mobility(c, 0, 1);
    law.zz[l] = 0.5 * step * contacts.own_mobility(c, 1, 1);
    const contact::FrictionLaw& friction = support.friction;
    if (!friction.active())
      continue;
    const auto table = contact::friction_table(friction, step);
    law.along[l] = friction.along.t;
    law.tangential[l] = friction.stiffness;
    law.compliance[l] = table.compliance;
    law.gradient[l] = friction.along.t * table.gradient;
    law.relaxation[l] = table.relaxation;
    law.mu_static[l] = friction.mu_static;
    law.mu_dynamic[l] = friction.mu_dynamic;
    law.per_mu[l] = friction.mu_static > 0.0 ? 1.0 / friction.mu_static : 0.0;
  }
  return laws;
}

MemoryLanes::MemoryLanes(int width) : LaneTable(width) {
  places.reserve(static_cast<std::size_t>(width));
  next.reserve(static_cast<std::size_t>(width));
}

StepLanes::StepLanes(int width, bool ties_tangents) : LaneTable(width) {
  if (ties_tangents)
    ties.assign(static_cast<std::size_t>(width) * static_cast<std::size_t>(width), 0.0);
  contacts.assign(static_cast<std::size_t>(width), 0);
}

namespace {

template <class G> struct CommitParts {
  typename G::Sums sliders = {}, damping = {}, stored = {};
};

/// Contacts of which some acted. Returns whether any remembers something.
template <class G>
FRETWORK_INLINE bool keep(int i, auto part, const LawLanes& laws, CommitLanes& commits, MemoryLanes& memories,
                          CommitParts<G>& sums) {
  using V = typename G::V;
  const int l = lane(i);
  const LawNumbers& law = laws[i];
  CommitNumbers& s = commits[i];
  MemoryNumbers& m = memories[i];
  const V one = V{} + 1.0;
  const V my = at<V>(s.normal_y + l), mz = at<V>(s.normal_z + l), half = 0.5 * at<V>(law.compliance + l);
  const V compliance = at<V>(law.compliance + l), e = at<V>(law.relaxation + l);
  const V closed = at<V>(law.mu_static + l) > 0.0 ? at<V>(s.closed + l) : V{}, open = one - closed;
  const V held = at<V>(m.spring + l), held_energy = half * held * held;
  // closed: the slider takes what the spring and damper do not, unless it would move with the force
  const V before = same_face(m, l, my, mz) * held, before_energy = half * before * before;
  const V force = at<V>(s.force + l), dx = at<V>(law.along + l) * at<V>(s.displacement + l);
  const V relaxed = force + e * (before - force), relaxed_stretch = compliance * (before - relaxed);
  const V against = force * (dx - relaxed_stretch) < 0.0 ? one : V{};
  const V slips = at<V>(s.slides + l) * (against + (force == 0.0 ? one : V{}));
  const V after_closed = slips > 0.0 ? relaxed : before - at<V>(law.tangential + l) * dx;
  const V stretch = slips > 0.0 ? relaxed_stretch : dx;
  const V slider = closed * -force * (dx - stretch);
  const V damper = closed * (-force * stretch - (half * after_closed * after_closed - before_energy));
  // open: the spring dies out and is forgotten
  const V fading = at<V>(m.left + l) * e, faded = fading < forgotten ? V{} : fading;
  const V after_open = faded > 0.0 ? e * held : V{};
  const V after = closed > 0.0 ? after_closed : after_open, after_energy = half * after * after;
  sums.sliders[part] += slider;
  sums.damping[part] += damper + closed * (held_energy - before_energy) + open * (held_energy - after_energy);
  sums.stored[part] += after_energy - held_energy;
  at<V>(s.friction_work + l) = slider;
  at<V>(s.damper_work + l) = damper;
  at<V>(m.spring + l) = after;
  at<V>(m.sliding + l) = closed * at<V>(s.slides + l);
  at<V>(m.force + l) = closed * force;
  at<V>(m.normal_y + l) = closed > 0.0 ? my : at<V>(m.normal_y + l);
  at<V>(m.normal_z + l) = closed > 0.0 ? mz : at<V>(m.normal_z + l);
  const V left = closed > 0.0 ? one : faded;
  at<V>(m.left + l) = left;
  return any(left);
}

/// Contacts that are all open in so many steps: what `keep` makes of them.
template <class G>
FRETWORK_INLINE bool fade(int i, auto part, int steps, const LawLanes& laws, MemoryLanes& memories,
                          CommitParts<G>& sums) {
  using V = typename G::V;
  const int l = lane(i);
  const LawNumbers& law = laws[i];
  MemoryNumbers& m = memories[i];
  const V e = at<V>(law.relaxation + l), held = at<V>(m.spring + l);
  V left = at<V>(m.left + l), after = held;
  for (int k = 0; k < steps; ++k) {
    const V fading = left * e;
    left = fading < forgotten ? V{} : fading;
    after = left > 0.0 ? e * after : V{};
  }
  const V lost = 0.5 * at<V>(law.compliance + l) * (held * held - after * after);
  sums.damping[part] += lost;
  sums.stored[part] -= lost;
  at<V>(m.spring + l) = after;
  at<V>(m.sliding + l) = at<V>(m.force + l) = V{};
  at<V>(m.left + l) = left;
  return any(left);
}

/// The place goes on to the next step if one(lane, part) of its vectors says that something is remembered there.
template <class G, class One>
FRETWORK_INLINE void remember(MemoryLanes& memories, int place, const One& one) {
  bool any = false;
  for_parts<G>([&](auto part) __attribute__((always_inline)) {
    any |= one(place + part * size_of<typename G::V>, part);
  });
  if (any)
    memories.next.push_back(place);
}

template <class G>
FRETWORK_INLINE void fade_at(int place, int steps, const LawLanes& laws, MemoryLanes& memories,
                             CommitParts<G>& sums) {
  remember<G>(
      memories, place, [&](int i, auto part) __attribute__((always_inline)) {
        return fade<G>(i, part, steps, laws, memories, sums);
      });
}

template <class G>
FRETWORK_INLINE CommitSums commit_all(const Places& acting, const LawLanes& laws, CommitLanes& commits,
                                      MemoryLanes& memories) {
  CommitParts<G> sums;
  memories.next.clear();
  auto old = memories.places.begin();
  const auto fade_before = [&](int end) __attribute__((always_inline)) {
    for (; old != memories.places.end() && *old < end; ++old)
      fade_at<G>(*old, 1, laws, memories, sums);
  };
  for (const int place : acting.first) {
    fade_before(place);
    old += old != memories.places.end() && *old == place;
    remember<G>(
        memories, place, [&](int i, auto part) __attribute__((always_inline)) {
          return keep<G>(i, part, laws, commits, memories, sums);
        });
  }
  fade_before(acting.all.width);
  memories.places.swap(memories.next);
  return {sum(sums.sliders), sum(sums.damping), sum(sums.stored)};
}

template <class G>
FRETWORK_INLINE CommitSums fade_all(int steps, const LawLanes& laws, MemoryLanes& memories) {
  CommitParts<G> sums;
  memories.next.clear();
  for (const int place : memories.places)
    fade_at<G>(place, steps, laws, memories, sums);
  memories.places.swap(memories.next);
  return {sum(sums.sliders), sum(sums.damping), sum(sums.stored)};
}

/// Tangential part, along which friction acts, of the vectors (y, z) of contacts where they were closed last.
template <class V>
FRETWORK_INLINE V tangential(const LawNumbers& law, const MemoryNumbers& m, int l, const V& y, const V& z) {
  return at<V>(law.along + l) * (at<V>(m.normal_z + l) * y - at<V>(m.normal_y + l) * z);
}

template <class G>
FRETWORK_INLINE double follow_all(int width, const LawLanes& laws, MemoryLanes& memories, const double* u,
                                  const double* last_u, const double* w, double half_step) {
  using V = typename G::V;
  typename G::Sums energy = {};
  for_places<G>(
      memories.places, [&](int i, auto part) __attribute__((always_inline)) {
        const int l = lane(i), z = width + i;
        const LawNumbers& law = laws[i];
        MemoryNumbers& m = memories[i];
        const V sticks = at<V>(m.left + l) == 1.0 ? 1.0 - at<V>(m.sliding + l) : V{};
        const V missing =
            tangential<V>(law, m, l, at<V>(u + i) - at<V>(last_u + i) - half_step * at<V>(w + i),
                          at<V>(u + z) - at<V>(last_u + z) - half_step * at<V>(w + z)) -
            at<V>(m.ahead + l);
        const V held = at<V>(m.spring + l), by = -sticks * at<V>(law.tangential + l) * missing;
        energy[part] += at<V>(law.compliance + l) * by * (held + 0.5 * by);
        at<V>(m.spring + l) = held + by;
      });
  return sum(energy);
}

/// Of contacts that are open too: nothing reads theirs.
template <class G>
FRETWORK_INLINE void leave_all(const Places& near, const LawLanes& laws, const CommitLanes& commits,
                               MemoryLanes& memories, const double* w, double half_step) {
  using V = typename G::V;
  for_places<G>(
      near.first, [&](int i, auto) __attribute__((always_inline)) {
        const int l = lane(i);
        MemoryNumbers& m = memories[i];
        const V speed = tangential<V>(laws[i], m, l, at<V>(w + i), at<V>(w + near.all.width + i));
        at<V>(m.ahead + l) = at<V>(commits[i].displacement + l) - half_step * speed;
      });
}

template <class Widest>
FRETWORK_INLINE double follow_on(const LaneCount& contacts, const LawLanes& laws, MemoryLanes& memories,
                                 const double* u, const double* last_u, const double* w, double half_step) {
  return by_grain<Widest>(
      contacts, [&]<class G>(G) __attribute__((always_inline)) {
        return follow_all<G>(contacts.width, laws, memories, u, last_u, w, half_step);
      });
}

template <class Widest>
FRETWORK_INLINE void leave_on(const Places& near, const LawLanes& laws, const CommitLanes& commits,
                              MemoryLanes& memories, const double* w, double half_step) {
  by_grain<Widest>(
      near.all, [&]<class G>(G) __attribute__((always_inline)) {
        leave_all<G>(near, laws, commits, memories, w, half_step);
      });
}

template <class Widest>
FRETWORK_INLINE CommitSums fade_on(const LaneCount& contacts, int steps, const LawLanes& laws,
                                   MemoryLanes& memories) {
  return by_grain<Widest>(
      contacts, [&]<class G>(G)
                    __attribute__((always_inline)) { return fade_all<G>(steps, laws, memories); });
}

template <class Widest>
FRETWORK_INLINE CommitSums commit_on(const Places& acting, const LawLanes& laws, CommitLanes& commits,
                                     MemoryLanes& memories) {
  return by_grain<Widest>(
      acting.all, [&]<class G>(G) __attribute__((always_inline)) {
        return commit_all<G>(acting, laws, commits, memories);
      });
}

} // namespace

FRETWORK_KERNEL(CommitSums, commit,
                (const Places& acting, const LawLanes& laws, CommitLanes& commits, MemoryLanes& memories),
                (acting, laws, commits, memories))
FRETWORK_KERNEL(CommitSums, fade,
                (const LaneCount& contacts, int steps, const LawLanes& laws, MemoryLanes& memories),
                (contacts, steps, laws, memories))
FRETWORK_KERNEL(double, follow,
                (const LaneCount& contacts, const LawLanes& laws, MemoryLanes& memories, const double* u,
                 const double* last_u, const double* w, double half_step),
                (contacts, laws, memories, u, last_u, w, half_step))
FRETWORK_KERNEL(void, leave,
                (const Places& near, const LawLanes& laws, const CommitLanes& commits, MemoryLanes& memories,
                 const double* w, double half_step),
                (near, laws, commits, memories, w, half_step))

} // namespace fretwork::transient::kernels
