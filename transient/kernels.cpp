// SPDX-License-Identifier: GPL-3.0-or-later
#include "transient/kernels.hpp"
#include <algorithm>

// One copy for each width of vector unit, chosen when the program starts. Not under the sanitizers (they
// start after the choice is made), nor with compilers that lack it.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(FRETWORK_SANITIZED)
#define FRETWORK_WIDTHS __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#else
#define FRETWORK_WIDTHS
#endif

namespace fretwork::transient::kernels {
namespace {

typedef double Pack __attribute__((vector_size(64)));
typedef long long Mask __attribute__((vector_size(64)));

#define FRETWORK_INLINE static inline __attribute__((always_inline))

FRETWORK_INLINE const Pack& at(const double* p) { return *reinterpret_cast<const Pack*>(p); }
FRETWORK_INLINE Pack& at(double* p) { return *reinterpret_cast<Pack*>(p); }
FRETWORK_INLINE double sum(const Pack& p) {
  return ((p[0] + p[4]) + (p[2] + p[6])) + ((p[1] + p[5]) + (p[3] + p[7]));
}

/// `blocks` packs of contacts at once: their sums stay in registers over all modes.
template <int blocks>
FRETWORK_INLINE void gather_blocks(int n, int width, const double* g, const double* q, const double* v,
                                   double* u, double* w) {
  Pack su[blocks], sw[blocks];
  for (int b = 0; b < blocks; ++b) {
    su[b] = Pack{};
    sw[b] = Pack{};
  }
  for (int i = 0; i < n; ++i) {
    const double* row = g + static_cast<std::ptrdiff_t>(i) * width;
    for (int b = 0; b < blocks; ++b) {
      su[b] += q[i] * at(row + b * lanes);
      sw[b] += v[i] * at(row + b * lanes);
    }
  }
  for (int b = 0; b < blocks; ++b) {
    at(u + b * lanes) = su[b];
    at(w + b * lanes) = sw[b];
  }
}

} // namespace

const char* vector_width() {
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(FRETWORK_SANITIZED)
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
      __builtin_cpu_supports("avx512dq"))
    return "AVX-512 (8 doubles)";
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"))
    return "AVX2 (4 doubles)";
#endif
  return "SSE2 (2 doubles)";
}

FRETWORK_WIDTHS double flow_loaded(int np, const FlowTable& t, double* q, double* v, const double* f0,
                                   const double* f1) {
  Pack work{};
  for (int i = 0; i < np; i += lanes) {
    const Pack q0 = at(q + i), v0 = at(v + i), a = at(f0 + i), b = at(f1 + i);
    const Pack q1 = at(&t.qq[i]) * q0 + at(&t.qv[i]) * v0 + at(&t.qf0[i]) * a + at(&t.qf1[i]) * b;
    const Pack v1 = at(&t.vq[i]) * q0 + at(&t.vv[i]) * v0 + at(&t.vf0[i]) * a + at(&t.vf1[i]) * b;
    const Pack mean = at(&t.mq[i]) * q0 + at(&t.mv[i]) * v0 + at(&t.mf0[i]) * a + at(&t.mf1[i]) * b;
    work += a * (q1 - q0) + (b - a) * (q1 - mean); // int f q' dt by parts, f linear
    at(q + i) = q1;
    at(v + i) = v1;
  }
  return sum(work);
}

FRETWORK_WIDTHS void flow_free(int np, const FlowTable& t, double* q, double* v) {
  for (int i = 0; i < np; i += lanes) {
    const Pack q0 = at(q + i), v0 = at(v + i);
    at(q + i) = at(&t.qq[i]) * q0 + at(&t.qv[i]) * v0;
    at(v + i) = at(&t.vq[i]) * q0 + at(&t.vv[i]) * v0;
  }
}

FRETWORK_WIDTHS void combine(int np, int sources, const double* shapes, const double* values, double* f) {
  for (int i = 0; i < np; i += lanes) {
    Pack s{};
    for (int k = 0; k < sources; ++k)
      s += values[k] * at(shapes + static_cast<std::ptrdiff_t>(k) * np + i);
    at(f + i) = s;
  }
}

FRETWORK_WIDTHS double twice_energy(int np, const double* k, const double* q, const double* v) {
  Pack s{};
  for (int i = 0; i < np; i += lanes)
    s += at(v + i) * at(v + i) + at(k + i) * at(q + i) * at(q + i);
  return sum(s);
}

FRETWORK_WIDTHS void gather(int n, int width, const double* g, const double* q, const double* v, double* u,
                            double* w) {
  int at_lane = 0;
  for (; at_lane + 4 * lanes <= width; at_lane += 4 * lanes)
    gather_blocks<4>(n, width, g + at_lane, q, v, u + at_lane, w + at_lane);
  switch ((width - at_lane) / lanes) {
  case 3:
    return gather_blocks<3>(n, width, g + at_lane, q, v, u + at_lane, w + at_lane);
  case 2:
    return gather_blocks<2>(n, width, g + at_lane, q, v, u + at_lane, w + at_lane);
  case 1:
    return gather_blocks<1>(n, width, g + at_lane, q, v, u + at_lane, w + at_lane);
  default:
    return;
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

FRETWORK_WIDTHS bool near(int width, const ReachLanes& reach, const double* uy, const double* uz,
                          const double* vy, const double* vz, double half_step, double* near_flag) {
  Mask any{};
  for (int i = 0; i < width; i += lanes) {
    const Pack y = at(uy + i) + at(&reach.rest_y[i]), z = at(uz + i) + at(&reach.rest_z[i]);
    const Pack wy = at(&reach.wy[i]), wz = at(&reach.wz[i]);
    const Pack r2 = wy * y * y + wz * z * z, s2 = wy * at(vy + i) * at(vy + i) + wz * at(vz + i) * at(vz + i);
    Pack r{}, s{};
    for (int l = 0; l < lanes; ++l) {
      r[l] = __builtin_sqrt(r2[l]);
      s[l] = __builtin_sqrt(s2[l]);
    }
    const Mask flag =
        at(&reach.radial[i]) * r + at(&reach.ly[i]) * y + at(&reach.lz[i]) * z + half_step * s >=
        at(&reach.limit[i]);
    at(near_flag + i) = flag ? Pack{} + 1.0 : Pack{};
    any |= flag;
  }
  return ((any[0] | any[1]) | (any[2] | any[3])) | ((any[4] | any[5]) | (any[6] | any[7]));
}

FRETWORK_WIDTHS void answer(int width, const double* columns, const double* f, double* w) {
  for (int i = 0; i < width; i += lanes)
    at(w + i) += f[0] * at(columns + i) + f[1] * at(columns + width + i) + f[2] * at(columns + 2 * width + i);
}

} // namespace fretwork::transient::kernels
