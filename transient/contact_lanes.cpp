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

MemoryLanes::MemoryLanes(int width) : LaneTable(width), places(width), next(width) {}

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
  CommitNumbers& s = commits[i];
  const V rubs = at<V>(laws[i].mu_static + l) > 0.0 ? at<V>(s.closed + l) : V{};
  const Kept<V> kept = remember_step<V>(laws[i], memories[i], l,
                                        {rubs, at<V>(s.normal_y + l), at<V>(s.normal_z + l),
                                         at<V>(s.force + l), at<V>(s.displacement + l), at<V>(s.slides + l)});
  sums.sliders[part] += kept.slider;
  sums.damping[part] += kept.damping;
  sums.stored[part] += kept.stored;
  at<V>(s.friction_work + l) = kept.slider;
  at<V>(s.damper_work + l) = kept.damper;
  return any(kept.left);
}

/// Contacts that are open in so many steps, where `open` is 1 and not 0: what `keep` makes of them. Returns whether any of all remembers something.
template <class G>
FRETWORK_INLINE bool fade(int i, auto part, int steps, const typename G::V& open, const LawLanes& laws,
                          MemoryLanes& memories, CommitParts<G>& sums) {
  using V = typename G::V;
  const int l = lane(i);
  const LawNumbers& law = laws[i];
  MemoryNumbers& m = memories[i];
  const V one = V{} + 1.0, e = open > 0.0 ? at<V>(law.relaxation + l) : one, held = at<V>(m.spring + l);
  V left = at<V>(m.left + l), after = held;
  for (int k = 0; k < steps; ++k) {
    const V fading = left * e;
    left = fading < forgotten ? V{} : fading;
    after = left > 0.0 ? e * after : V{};
  }
  const V lost = 0.5 * at<V>(law.compliance + l) * (held - after) * (held + after); // 0 of what is not open
  sums.damping[part] += lost;
  sums.stored[part] -= lost;
  at<V>(m.spring + l) = after;
  at<V>(m.sliding + l) = open > 0.0 ? V{} : at<V>(m.sliding + l);
  at<V>(m.force + l) = open > 0.0 ? V{} : at<V>(m.force + l);
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
        return fade<G>(i, part, steps, typename G::V{} + 1.0, laws, memories, sums);
      });
}

template <class G>
FRETWORK_INLINE CommitSums commit_all(const Places& acting, const LawLanes& laws, CommitLanes& commits,
                                      MemoryLanes& memories) {
  CommitParts<G> sums;
  memories.next.clear();
  const int* old = memories.places.begin();
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

/// 1 in all lanes but one: of that row.
struct alignas(alignment) Besides {
  Numbers of[lanes];
  constexpr Besides() : of{} {
    for (int l = 0; l < lanes; ++l)
      for (int k = 0; k < lanes; ++k)
        of[l][k] = k == l ? 0.0 : 1.0;
  }
};
constexpr Besides besides;

template <class G>
FRETWORK_INLINE CommitSums fade_beside_all(int contact, const LawLanes& laws, MemoryLanes& memories) {
  CommitParts<G> sums;
  memories.next.clear();
  const int own = contact - contact % G::together;
  const double* others = besides.of[lane(contact)];
  bool met = !(memories[contact].left[lane(contact)] > 0.0); // its place, or nothing is remembered of it
  for (const int place : memories.places) {
    if (!met && own < place)
      memories.next.push_back(own);
    met = met || own <= place;
    if (place != own)
      fade_at<G>(place, 1, laws, memories, sums);
    else
      remember<G>(
          memories, place, [&](int i, auto part) __attribute__((always_inline)) {
            return fade<G>(i, part, 1, at<typename G::V>(others + lane(i)), laws, memories, sums);
          });
  }
  if (!met)
    memories.next.push_back(own);
  memories.places.swap(memories.next);
  return {0.0, sum(sums.damping), sum(sums.stored)};
}

template <class G>
FRETWORK_INLINE double follow_all(int width, const LawLanes& laws, MemoryLanes& memories, const double* u,
                                  const double* last_u, const double* w, double half_step) {
  using V = typename G::V;
  typename G::Sums energy = {};
  for_places<G>(
      memories.places, [&](int i, auto part) __attribute__((always_inline)) {
        energy[part] += follow_step<V>(i, width, laws[i], memories[i], u, last_u, w, half_step);
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
FRETWORK_INLINE CommitSums fade_beside_on(const LaneCount& contacts, int contact, const LawLanes& laws,
                                          MemoryLanes& memories) {
  return by_grain<Widest>(
      contacts, [&]<class G>(G)
                    __attribute__((always_inline)) { return fade_beside_all<G>(contact, laws, memories); });
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
FRETWORK_KERNEL(CommitSums, fade_beside,
                (const LaneCount& contacts, int contact, const LawLanes& laws, MemoryLanes& memories),
                (contacts, contact, laws, memories))
FRETWORK_KERNEL(double, follow,
                (const LaneCount& contacts, const LawLanes& laws, MemoryLanes& memories, const double* u,
                 const double* last_u, const double* w, double half_step),
                (contacts, laws, memories, u, last_u, w, half_step))
FRETWORK_KERNEL(void, leave,
                (const Places& near, const LawLanes& laws, const CommitLanes& commits, MemoryLanes& memories,
                 const double* w, double half_step),
                (near, laws, commits, memories, w, half_step))

} // namespace fretwork::transient::kernels
