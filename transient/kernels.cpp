// SPDX-License-Identifier: GPL-3.0-or-later
#include "transient/oscillator.hpp"
#include "transient/vector_lanes.hpp"
#include <algorithm>

namespace fretwork::transient::kernels {
namespace {

template <class V>
FRETWORK_INLINE void place_all(int end, const ReachLanes& reach, const double* uy, const double* uz,
                               const double* vy, const double* vz, double half_window, double* gap,
                               double* ny, double* nz, double* near, Places& places) {
  const V one = V{} + 1.0;
  const double h2 = half_window * half_window;
  for (int i = 0; i < end; i += size_of<V>) {
    const V y = at<V>(uy + i) + at<V>(&reach.rest_y[i]), z = at<V>(uz + i) + at<V>(&reach.rest_z[i]);
    const V wy = at<V>(&reach.wy[i]), wz = at<V>(&reach.wz[i]), radial = at<V>(&reach.radial[i]);
    const V ly = at<V>(&reach.ly[i]), lz = at<V>(&reach.lz[i]);
    const V r2 = wy * y * y + wz * z * z, left = at<V>(&reach.limit[i]) - (ly * y + lz * z);
    if (!(half_window > 0.0)) { // gap > 0 by squares that keep their signs: most packs need no root
      const V closed = radial * magnitude(radial) * r2 < left * magnitude(left) ? V{} : one;
      at<V>(near + i) = closed;
      if (sum(closed) == 0.0)
        continue;
    }
    const V r = root(r2), g = left - radial * r;
    V reached = g <= 0.0 ? one : V{};
    if (half_window > 0.0) {
      const V s2 = at<V>(vy + i) * at<V>(vy + i) + at<V>(vz + i) * at<V>(vz + i);
      reached = g * g <= h2 * s2 ? one : reached;
    }
    at<V>(gap + i) = g;
    at<V>(near + i) = reached;
    const double number = sum(reached);
    if (number == 0.0)
      continue;
    places.first.push_back(i);
    places.near += number;
    const V per_r = 1.0 / (r > 0.0 ? r : one);
    // at the very centre along y where the normal can be y
    const V ey = r > 0.0 ? wy * y * per_r : wy, ez = r > 0.0 ? wz * z * per_r : wz * (1.0 - wy);
    at<V>(ny + i) = -(radial * ey + ly);
    at<V>(nz + i) = -(radial * ez + lz);
  }
}

VectorSize vector_size_here() {
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(FRETWORK_SANITIZED)
  __builtin_cpu_init();
  if (__builtin_cpu_supports("x86-64-v4"))
    return VectorSize::pack;
  if (__builtin_cpu_supports("x86-64-v3"))
    return VectorSize::half;
#endif
  return VectorSize::pair;
}

} // namespace

const VectorSize vector_size = vector_size_here();

const char* vector_width() {
  switch (vector_size) {
  case VectorSize::pack:
    return "AVX-512 (8 doubles)";
  case VectorSize::half:
    return "AVX2 (4 doubles)";
  case VectorSize::pair:
    break;
  }
  return "SSE2 (2 doubles)";
}

void FlowTable::set(std::ptrdiff_t mode, double stiffness, const StepCoefficients& s) {
  const double all[numbers] = {stiffness, s.qq,  s.qv, s.qf0, s.qf1, s.vq, s.vv,
                               s.vf0,     s.vf1, s.mq, s.mv,  s.mf0, s.mf1};
  const std::ptrdiff_t lane = mode % lanes, first = numbers * (mode - lane) + lane;
  for (std::ptrdiff_t k = 0; k < numbers; ++k)
    values_[static_cast<std::size_t>(first + k * lanes)] = all[k];
}

/// Those of a table's numbers that belong to the modes of a vector.
template <class V> struct FlowNumbers {
  const double* first;
  const V& operator[](int k) const { return at<V>(first + k * lanes); }
};

template <class V>
FRETWORK_INLINE FlowSums flow_loaded_on(int np, const FlowTable& table, double* q, double* v,
                                        const double* f0, const double* f1) {
  Sums<V> work = {}, energy = {};
  for_vectors<V>(
      np, [&](int pack, int part) __attribute__((always_inline)) {
        const int offset = part * size_of<V>, i = pack + offset;
        const FlowNumbers<V> of{table.data() + FlowTable::numbers * pack + offset};
        const V q0 = at<V>(q + i), v0 = at<V>(v + i), a = at<V>(f0 + i), b = at<V>(f1 + i);
        const V q1 = of[1] * q0 + of[2] * v0 + of[3] * a + of[4] * b;
        const V v1 = of[5] * q0 + of[6] * v0 + of[7] * a + of[8] * b;
        const V mean = of[9] * q0 + of[10] * v0 + of[11] * a + of[12] * b;
        work[part] += a * (q1 - q0) + (b - a) * (q1 - mean); // int f q' dt by parts, f linear
        energy[part] += v1 * v1 + of[0] * q1 * q1;
        at<V>(q + i) = q1;
        at<V>(v + i) = v1;
      });
  return {sum(work), sum(energy)};
}
FRETWORK_KERNEL(FlowSums, flow_loaded,
                (int np, const FlowTable& table, double* q, double* v, const double* f0, const double* f1),
                (np, table, q, v, f0, f1))

template <class V>
FRETWORK_INLINE FlowSums flow_free_on(int np, const FlowTable& table, double* q, double* v) {
  Sums<V> energy = {};
  for_vectors<V>(
      np, [&](int pack, int part) __attribute__((always_inline)) {
        const int offset = part * size_of<V>, i = pack + offset;
        const FlowNumbers<V> of{table.data() + FlowTable::numbers * pack + offset};
        const V q0 = at<V>(q + i), v0 = at<V>(v + i);
        const V q1 = of[1] * q0 + of[2] * v0, v1 = of[5] * q0 + of[6] * v0;
        energy[part] += v1 * v1 + of[0] * q1 * q1;
        at<V>(q + i) = q1;
        at<V>(v + i) = v1;
      });
  return {0.0, sum(energy)};
}
FRETWORK_KERNEL(FlowSums, flow_free, (int np, const FlowTable& table, double* q, double* v),
                (np, table, q, v))

template <class V>
FRETWORK_INLINE void combine_on(int np, int sources, const double* shapes, const double* values, double* f) {
  for (int i = 0; i < np; i += size_of<V>) {
    V s{};
    for (int k = 0; k < sources; ++k)
      s += values[k] * at<V>(shapes + static_cast<std::ptrdiff_t>(k) * np + i);
    at<V>(f + i) = s;
  }
}
FRETWORK_KERNEL(void, combine, (int np, int sources, const double* shapes, const double* values, double* f),
                (np, sources, shapes, values, f))

template <class V>
FRETWORK_INLINE double twice_energy_on(int np, const double* k, const double* q, const double* v) {
  Sums<V> s = {};
  for_vectors<V>(
      np, [&](int pack, int part) __attribute__((always_inline)) {
        const int i = pack + part * size_of<V>;
        s[part] += at<V>(v + i) * at<V>(v + i) + at<V>(k + i) * at<V>(q + i) * at<V>(q + i);
      });
  return sum(s);
}
FRETWORK_KERNEL(double, twice_energy, (int np, const double* k, const double* q, const double* v),
                (np, k, q, v))

void GatherTable::add_pack(int mode_count, std::ptrdiff_t width, const double* values_of_mode) {
  for (int i = 0; i < mode_count; ++i) {
    const double* row = values_of_mode + i * width;
    if (std::all_of(row, row + lanes, [](double x) { return x == 0.0; }))
      continue;
    modes.push_back(i);
    values.insert(values.end(), row, row + lanes);
  }
  begin.push_back(static_cast<int>(modes.size()));
}

/// Pack p of to[n] = G from[n]: two sums each, so that none waits for the other.
template <class V, std::size_t count>
FRETWORK_INLINE void gather_pack(const GatherTable& g, int p, const double* const (&from)[count],
                                 double* const (&to)[count]) {
  V sum[count][2] = {};
  const int end = g.begin[p + 1];
  const auto add = [&](int k, int into) __attribute__((always_inline)) {
    const V value = at<V>(&g.values[static_cast<std::size_t>(k) * lanes]);
    for (std::size_t n = 0; n < count; ++n)
      sum[n][into] += from[n][g.modes[k]] * value;
  };
  int k = g.begin[p];
  for (; k + 1 < end; k += 2) {
    add(k, 0);
    add(k + 1, 1);
  }
  if (k < end)
    add(k, 0);
  for (std::size_t n = 0; n < count; ++n)
    at<V>(to[n] + p * lanes) = sum[n][0] + sum[n][1];
}

FRETWORK_WIDTHS void gather(const GatherTable& g, const double* q, const double* v, double* u, double* w) {
  const int packs = static_cast<int>(g.begin.size()) - 1;
  for (int p = 0; p < packs; ++p)
    if (g.half)
      gather_pack<Half, 2>(g, p, {q, v}, {u, w});
    else
      gather_pack<Pack, 2>(g, p, {q, v}, {u, w});
}

FRETWORK_WIDTHS void gather(const GatherTable& g, const double* q, double* u) {
  const int packs = static_cast<int>(g.begin.size()) - 1;
  for (int p = 0; p < packs; ++p)
    if (g.half)
      gather_pack<Half, 1>(g, p, {q}, {u});
    else
      gather_pack<Pack, 1>(g, p, {q}, {u});
}

FRETWORK_WIDTHS void gather_at(const GatherTable& g, const Places& places, const double* v, double* w) {
  const int packs = static_cast<int>(g.begin.size()) - 1, to_next_block = places.all.width / lanes;
  int last = -1;
  for (const int lane : places.first) {
    const int first = lane / lanes;
    if (first == last)
      continue;
    last = first;
    for (int p = first; p < packs; p += to_next_block)
      if (g.half)
        gather_pack<Half, 1>(g, p, {v}, {w});
      else
        gather_pack<Pack, 1>(g, p, {v}, {w});
  }
}

FRETWORK_WIDTHS void scatter(int np, int rows, const double* const* row, const double* factor, double* v) {
  for (int i = 0; i < np; i += lanes) {
    Pack s = at(v + i);
    for (int r = 0; r < rows; ++r)
      s += factor[r] * at(row[r] + i);
    at(v + i) = s;
  }
}

FRETWORK_WIDTHS void scatter(int np, int rows, const double* const* row, const double* factor, double* v,
                             double share, const double* q, double* moved) {
  for (int i = 0; i < np; i += lanes) {
    const Pack v0 = at(v + i);
    Pack s = v0;
    for (int r = 0; r < rows; ++r)
      s += factor[r] * at(row[r] + i);
    at(v + i) = s;
    at(moved + i) = at(q + i) + share * (s - v0);
  }
}

FRETWORK_WIDTHS EulerSums euler_step(int np, double h, const double* c, const double* k, const double* load,
                                     const double* force, double* q, double* v) {
  Pack energy{}, power{}, loss{};
  for (int i = 0; i < np; i += lanes) {
    const Pack q0 = at(q + i), v0 = at(v + i), ci = at(c + i), kq = at(k + i) * q0, f = at(load + i);
    const Pack v1 = v0 + h * (f + at(force + i) - ci * v0 - kq);
    const Pack vm = 0.5 * (v0 + v1);
    energy += vm * vm + kq * q0;
    power += f * vm;
    loss += ci * vm * vm;
    at(v + i) = v1;
    at(q + i) = q0 + h * v1;
  }
  return {sum(energy), sum(power), sum(loss)};
}

FRETWORK_WIDTHS void place(const ReachLanes& reach, const double* uy, const double* uz, const double* vy,
                           const double* vz, double half_window, double* gap, double* ny, double* nz,
                           double* near, Places& places) {
  const LaneCount& all = places.all;
  places.first.clear();
  places.near = 0.0;
  if (all.few())
    place_all<double>(all.count, reach, uy, uz, vy, vz, half_window, gap, ny, nz, near, places);
  else if (all.half())
    place_all<Half>(size_of<Half>, reach, uy, uz, vy, vz, half_window, gap, ny, nz, near, places);
  else
    place_all<Pack>(all.width, reach, uy, uz, vy, vz, half_window, gap, ny, nz, near, places);
}

FRETWORK_WIDTHS void respond(int width, int directions, const double* columns, double ny, double nz,
                             double scale, const double* to_ny, const double* to_nz, double* a) {
  const int stride = directions * width; // of a column, and of a direction of `a`
  for (int i = 0; i < width; i += lanes) {
    const Pack my = at(to_ny + i), mz = at(to_nz + i);
    const double* y = columns + i; // by a force along y, z, x
    const double *z = y + stride, *x = z + stride;
    const auto store = [&](double* out, const Pack& by_y, const Pack& by_z) __attribute__((always_inline)) {
      at(out) = my * by_y + mz * by_z;
      at(out + width) = mz * by_y - my * by_z;
    };
    const double sy = scale * ny, sz = scale * nz;
    store(a + i, sy * at(y) + sz * at(z), sy * at(y + width) + sz * at(z + width));
    store(a + stride + i, sz * at(y) - sy * at(z), sz * at(y + width) - sy * at(z + width));
    if (directions < 3)
      continue;
    at(a + 2 * width + i) = sy * at(y + 2 * width) + sz * at(z + 2 * width);
    at(a + stride + 2 * width + i) = sz * at(y + 2 * width) - sy * at(z + 2 * width);
    store(a + 2 * stride + i, scale * at(x), scale * at(x + width));
    at(a + 2 * stride + 2 * width + i) = scale * at(x + 2 * width);
  }
}

FRETWORK_WIDTHS void answer(int stride, int directions, const double* a, const double* f, double* v) {
  if (directions == 2) {
    for (int i = 0; i < stride; i += lanes)
      at(v + i) += f[0] * at(a + i) + f[1] * at(a + stride + i);
    return;
  }
  for (int i = 0; i < stride; i += lanes)
    at(v + i) += f[0] * at(a + i) + f[1] * at(a + stride + i) + f[2] * at(a + 2 * stride + i);
}

FRETWORK_WIDTHS void project(int width, int directions, const double* ny, const double* nz, const double* w,
                             double* v) {
  for (int i = 0; i < width; i += lanes) {
    const Pack my = at(ny + i), mz = at(nz + i), y = at(w + i), z = at(w + width + i);
    at(v + i) = my * y + mz * z;
    at(v + width + i) = mz * y - my * z;
    if (directions == 3)
      at(v + 2 * width + i) = at(w + 2 * width + i);
  }
}

} // namespace fretwork::transient::kernels
