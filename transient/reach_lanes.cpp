// SPDX-License-Identifier: GPL-3.0-or-later
#include "transient/reach_lanes.hpp"
#include "transient/vector_lanes.hpp"

namespace fretwork::transient::kernels {
namespace {

/// Contacts from lane i on.
template <class V> struct Point {
  V y, z, r2, left; ///< m, m, m^2, m: gap = left - radial sqrt(r2)
};
template <class V>
FRETWORK_INLINE Point<V> point_at(const ReachLanes& reach, int i, const V& uy, const V& uz) {
  const V y = uy + at<V>(&reach.rest_y[i]), z = uz + at<V>(&reach.rest_z[i]);
  return {y, z, at<V>(&reach.wy[i]) * y * y + at<V>(&reach.wz[i]) * z * z,
          at<V>(&reach.limit[i]) - (at<V>(&reach.ly[i]) * y + at<V>(&reach.lz[i]) * z)};
}
/// 1 where gap > 0 does not hold: by squares that keep their signs, as most contacts need no root.
template <class V> FRETWORK_INLINE V shut(const ReachLanes& reach, int i, const Point<V>& point) {
  const V radial = at<V>(&reach.radial[i]);
  return radial * magnitude(radial) * point.r2 < point.left * magnitude(point.left) ? V{} : V{} + 1.0;
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

template <class G>
FRETWORK_INLINE void place_all(const ReachLanes& reach, const double* u, const double* v, double half_window,
                               double* gap, double* ny, double* nz, double* near, Places& places) {
  using V = typename G::V;
  constexpr int parts = G::parts, size = size_of<V>;
  const int width = places.all.width;
  const V one = V{} + 1.0;
  const double h2 = half_window * half_window;
  for (int place = 0; place < places.all.count; place += G::together) {
    Point<V> point[parts];
    V r[parts], closed{}, number{};
    for_parts<G>([&](auto p) __attribute__((always_inline)) {
      const int i = place + p * size;
      point[p] = point_at<V>(reach, i, at<V>(u + i), at<V>(u + width + i));
      if (half_window > 0.0)
        return;
      const V closes = shut<V>(reach, i, point[p]);
      at<V>(near + i) = closes;
      closed += closes;
    });
    if (!(half_window > 0.0) && !any(closed))
      continue;
    for_parts<G>([&](auto p) __attribute__((always_inline)) {
      const int i = place + p * size;
      r[p] = root(point[p].r2);
      const V g = point[p].left - at<V>(&reach.radial[i]) * r[p];
      V reached = g <= 0.0 ? one : V{};
      if (half_window > 0.0) {
        const V s2 = at<V>(v + i) * at<V>(v + i) + at<V>(v + width + i) * at<V>(v + width + i);
        reached = g * g <= h2 * s2 ? one : reached;
      }
      at<V>(gap + i) = g;
      at<V>(near + i) = reached;
      number += reached;
    });
    const double near_here = sum(number);
    if (near_here == 0.0)
      continue;
    places.first.push_back(place);
    places.near += near_here;
    for_parts<G>([&](auto p) __attribute__((always_inline)) {
      const int i = place + p * size;
      const V wy = at<V>(&reach.wy[i]), wz = at<V>(&reach.wz[i]), radial = at<V>(&reach.radial[i]);
      const V per_r = 1.0 / (r[p] > 0.0 ? r[p] : one);
      // at the very centre along y where the normal can be y
      const V ey = r[p] > 0.0 ? wy * point[p].y * per_r : wy,
              ez = r[p] > 0.0 ? wz * point[p].z * per_r : wz * (1.0 - wy);
      at<V>(ny + i) = -(radial * ey + at<V>(&reach.ly[i]));
      at<V>(nz + i) = -(radial * ez + at<V>(&reach.lz[i]));
    });
  }
}

template <class Widest>
FRETWORK_INLINE void place_contacts_on(const ReachLanes& reach, const double* u, const double* v,
                                       double half_window, double* gap, double* ny, double* nz, double* near,
                                       Places& places) {
  places.first.clear();
  places.near = 0.0;
  by_grain<Widest>(
      places.all, [&]<class G>(G) __attribute__((always_inline)) {
        place_all<G>(reach, u, v, half_window, gap, ny, nz, near, places);
      });
}

template <class Widest>
FRETWORK_INLINE bool move_less_on(const ReachLanes& reach, const LaneCount& contacts, const double* v,
                                  double time) {
  return none<Widest>(
      contacts, [&]<class V>(int i, const V&) __attribute__((always_inline)) {
        const V y = time * at<V>(v + i), z = time * at<V>(v + contacts.width + i),
                limit = at<V>(&reach.limit[i]);
        return y * y + z * z > limit * limit ? V{} + 1.0 : V{};
      });
}

template <class Widest>
FRETWORK_INLINE bool open_after_on(const ReachLanes& reach, const LaneCount& contacts, const double* u,
                                   const double* v, double time) {
  return none<Widest>(
      contacts, [&]<class V>(int i, const V&) __attribute__((always_inline)) {
        const int z = contacts.width + i;
        return shut<V>(
            reach, i,
            point_at<V>(reach, i, at<V>(u + i) + time * at<V>(v + i), at<V>(u + z) + time * at<V>(v + z)));
      });
}

} // namespace

FRETWORK_KERNEL(void, place_contacts,
                (const ReachLanes& reach, const double* u, const double* v, double half_window, double* gap,
                 double* ny, double* nz, double* near, Places& places),
                (reach, u, v, half_window, gap, ny, nz, near, places))
FRETWORK_KERNEL(bool, move_less,
                (const ReachLanes& reach, const LaneCount& contacts, const double* v, double time),
                (reach, contacts, v, time))
FRETWORK_KERNEL(bool, open_after,
                (const ReachLanes& reach, const LaneCount& contacts, const double* u, const double* v,
                 double time),
                (reach, contacts, u, v, time))

} // namespace fretwork::transient::kernels
