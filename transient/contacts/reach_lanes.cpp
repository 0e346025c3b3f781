// SPDX-License-Identifier: GPL-3.0-or-later
#include "transient/contacts/reach_lanes.hpp"
#include "kernels/vector_lanes.hpp"

namespace fretwork::transient {

using namespace kernels;

MotionLanes::MotionLanes(const LaneCount& contacts, int blocks) : places(contacts) {
  u.assign(static_cast<std::size_t>(contacts.width) * static_cast<std::size_t>(blocks), 0.0);
  w = u;
  for (Array* a : {&gaps, &normal_y, &normal_z, &marks})
    a->assign(static_cast<std::size_t>(contacts.width), 0.0);
}

namespace {

/// Contacts from lane i on.
template <class V> struct Point {
  V y, z, r2, left; ///< m, m, m^2, m: gap = left - radial sqrt(r2)
};
template <class V>
FRETWORK_INLINE Point<V> point_at(const ReachLanes& reach, int i, const V& uy, const V& uz) {
  const ReachNumbers& of = reach[i];
  const int l = lane(i);
  const V y = uy + at<V>(of.rest_y + l), z = uz + at<V>(of.rest_z + l);
  return {y, z, rounded(V(at<V>(of.wy + l) * y * y)) + at<V>(of.wz + l) * z * z,
          at<V>(of.limit + l) - (rounded(V(at<V>(of.ly + l) * y)) + at<V>(of.lz + l) * z)};
}
/// 1 where gap > 0 does not hold: by squares that keep their signs, as most contacts need no root.
template <class V> FRETWORK_INLINE V shut(const ReachLanes& reach, int i, const Point<V>& point) {
  const V radial = at<V>(reach[i].radial + lane(i));
  return radial * magnitude(radial) * point.r2 < point.left * magnitude(point.left) ? V{} : V{} + 1.0;
}

/// 0 where gap > s surely, s2 = s^2: the sum of two lengths is at most the root of twice the sum of their squares.
template <class V>
FRETWORK_INLINE V may_close(const ReachLanes& reach, int i, const Point<V>& point, const V& s2) {
  const V radial = at<V>(reach[i].radial + lane(i)), across = radial * magnitude(radial) * point.r2;
  return 2.0 * (clipped(across) + s2) < point.left * magnitude(point.left) ? V{} : V{} + 1.0;
}

/// Whether no flag of the lanes from i on is set, for all vectors.
template <class Widest, class Flags>
FRETWORK_INLINE bool none(const LaneCount& contacts, const Flags& flags) {
  return by_grain<Widest>(
      contacts, [&]<class G>(G) __attribute__((always_inline)) {
        using V = typename G::V;
        V found{};
        for (int place = 0; place < contacts.count; place += G::together)
          for_parts<G>([&](auto part) __attribute__((always_inline)) {
            found += flags(place + part * size_of<V>, V{});
          });
        return !any(found);
      });
}

/// @param u, v  of lane i on along y and z: u(i, 0), u(i, 1)
template <class G, class Motion>
FRETWORK_INLINE void place_all(const ReachLanes& reach, double half_window, int count, const Motion& u,
                               const Motion& v, MotionLanes& motion) {
  using V = typename G::V;
  constexpr int parts = G::parts, size = size_of<V>;
  Places& places = motion.places;
  places.first.clear();
  double *gap = motion.gaps.data(), *ny = motion.normal_y.data(), *nz = motion.normal_z.data(),
         *near = motion.marks.data();
  const V one = V{} + 1.0;
  const double h2 = half_window * half_window;
  double all_near = 0.0;
  for (int place = 0; place < count; place += G::together) {
    Point<V> point[parts];
    V r[parts], s2[parts] = {}, closed{}, number{};
    for_parts<G>([&](auto p) __attribute__((always_inline)) {
      const int i = place + p * size;
      point[p] = point_at<V>(reach, i, u(i, 0), u(i, 1));
      V closes;
      if (half_window > 0.0) {
        const V y = v(i, 0), z = v(i, 1);
        s2[p] = rounded(V(h2 * (rounded(V(y * y)) + z * z)));
        closes = may_close<V>(reach, i, point[p], s2[p]);
      } else {
        closes = shut<V>(reach, i, point[p]);
      }
      at<V>(near + i) = closes;
      closed += closes;
    });
    if (!any(closed))
      continue;
    for_parts<G>([&](auto p) __attribute__((always_inline)) {
      const int i = place + p * size;
      r[p] = root(point[p].r2);
      const V g = point[p].left - at<V>(reach[i].radial + lane(i)) * r[p];
      V reached = g <= 0.0 ? one : V{};
      if (half_window > 0.0)
        reached = g * g <= s2[p] ? one : reached;
      at<V>(gap + i) = g;
      at<V>(near + i) = reached;
      number += reached;
    });
    const double near_here = sum(number);
    if (near_here == 0.0)
      continue;
    places.first.push_back(place);
    all_near += near_here;
    for_parts<G>([&](auto p) __attribute__((always_inline)) {
      const int i = place + p * size, l = lane(i);
      const ReachNumbers& of = reach[i];
      const V wy = at<V>(of.wy + l), wz = at<V>(of.wz + l), radial = at<V>(of.radial + l);
      const V per_r = 1.0 / (r[p] > 0.0 ? r[p] : one);
      // at the very centre along y where the normal can be y
      const V ey = r[p] > 0.0 ? wy * point[p].y * per_r : wy,
              ez = r[p] > 0.0 ? wz * point[p].z * per_r : wz * (1.0 - wy);
      at<V>(ny + i) = -(radial * ey + at<V>(of.ly + l));
      at<V>(nz + i) = -(radial * ez + at<V>(of.lz + l));
    });
  }
  places.near = all_near;
}

/// Of lanes in memory.
template <class V> struct Lanes {
  const double* first;
  int width;
  const V& operator()(int i, int block) const { return at<V>(first + block * width + i); }
};
template <class G>
FRETWORK_INLINE void place_lanes(const ReachLanes& reach, double half_window, MotionLanes& motion) {
  using V = typename G::V;
  const LaneCount& all = motion.places.all;
  const Lanes<V> u{motion.u.data(), all.width}, v{motion.w.data(), all.width};
  place_all<G>(reach, half_window, all.count, u, v, motion);
}

template <class Widest>
FRETWORK_INLINE void place_contacts_on(const ReachLanes& reach, double half_window, MotionLanes& motion) {
  if (motion.places.all.half())
    place_lanes<Grain<Widest, Half>>(reach, half_window, motion);
  else
    place_lanes<Grain<Widest, Pack>>(reach, half_window, motion);
}

/// A kernel of its own: what saves and sets up the vectors of the other takes as long as a contact.
template <class Widest>
FRETWORK_INLINE void place_few_on(const ReachLanes& reach, double half_window, MotionLanes& motion) {
  place_lanes<Grain<Widest, double>>(reach, half_window, motion);
}

template <class Widest>
FRETWORK_INLINE bool move_less_on(const ReachLanes& reach, const LaneCount& contacts, const double* v,
                                  double time) {
  return none<Widest>(
      contacts, [&]<class V>(int i, const V&) __attribute__((always_inline)) {
        const V y = time * at<V>(v + i), z = time * at<V>(v + contacts.width + i),
                limit = at<V>(reach[i].limit + lane(i));
        return rounded(V(y * y)) + z * z > limit * limit ? V{} + 1.0 : V{};
      });
}

} // namespace

FRETWORK_KERNEL(void, place_contacts, (const ReachLanes& reach, double half_window, MotionLanes& motion),
                (reach, half_window, motion))
FRETWORK_KERNEL(void, place_few, (const ReachLanes& reach, double half_window, MotionLanes& motion),
                (reach, half_window, motion))
FRETWORK_KERNEL(bool, move_less,
                (const ReachLanes& reach, const LaneCount& contacts, const double* v, double time),
                (reach, contacts, v, time))

} // namespace fretwork::transient
