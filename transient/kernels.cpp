// SPDX-License-Identifier: GPL-3.0-or-later
#include "transient/vector_lanes.hpp"

namespace fretwork::transient::kernels {
namespace {

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

FRETWORK_WIDTHS void place(int width, const ReachLanes& reach, const double* uy, const double* uz,
                           double* gap, double* ny, double* nz) {
  for (int i = 0; i < width; i += lanes) {
    const Pack y = at(uy + i) + at(&reach.rest_y[i]), z = at(uz + i) + at(&reach.rest_z[i]);
    const Pack wy = at(&reach.wy[i]), wz = at(&reach.wz[i]), radial = at(&reach.radial[i]);
    const Pack ly = at(&reach.ly[i]), lz = at(&reach.lz[i]);
    const Pack r2 = wy * y * y + wz * z * z;
    Pack r{};
    for (int l = 0; l < lanes; ++l)
      r[l] = __builtin_sqrt(r2[l]);
    const Mask centred = !(r > Pack{});
    const Pack ey = centred ? wy : wy * y / r; // at the very centre along y where the normal can be y
    const Pack ez = centred ? wz * (1.0 - wy) : wz * z / r;
    at(gap + i) = at(&reach.limit[i]) - (radial * r + ly * y + lz * z);
    at(ny + i) = -(radial * ey + ly);
    at(nz + i) = -(radial * ez + lz);
  }
}

FRETWORK_WIDTHS bool near(int width, const double* gap, const double* vy, const double* vz, double half_step,
                          double* near_flag) {
  Pack any{};
  const Pack one = Pack{} + 1.0;
  const double h2 = half_step * half_step;
  for (int i = 0; i < width; i += lanes) {
    const Pack g = at(gap + i), s2 = at(vy + i) * at(vy + i) + at(vz + i) * at(vz + i);
    const Pack inside = g <= 0.0 ? one : Pack{}, soon = g * g <= h2 * s2 ? one : Pack{};
    at(near_flag + i) = inside + soon;
    any += inside + soon;
  }
  return sum(any) > 0.0;
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
