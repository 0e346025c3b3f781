// SPDX-License-Identifier: GPL-3.0-or-later
#include "kernels/kernels.hpp"
#include "kernels/vector_lanes.hpp"
#include <algorithm>

namespace fretwork::kernels {
namespace {

VectorSize vector_size_here() {
#ifdef FRETWORK_KERNELS_BY_PROCESSOR
  __builtin_cpu_init();
  if (__builtin_cpu_supports("x86-64-v4"))
    return VectorSize::pack;
  if (__builtin_cpu_supports("x86-64-v3"))
    return VectorSize::half;
#endif
  return VectorSize::pair;
}

/// In use; made when the first kernel asks.
VectorSize& vector_size() {
  static VectorSize size = vector_size_here();
  return size;
}

const KernelCopies* last_kernel = nullptr;

} // namespace

KernelCopies::KernelCopies(Any pair, Any half, Any pack) : all_{pair, half, pack}, next_(last_kernel) {
  chosen_ = all_[static_cast<int>(vector_size())];
  last_kernel = this;
}

VectorSize limit_vectors(VectorSize most) {
  vector_size() = std::min(most, vector_size_here());
  for (const KernelCopies* kernel = last_kernel; kernel; kernel = kernel->next_)
    kernel->chosen_ = kernel->all_[static_cast<int>(vector_size())];
  return vector_size();
}

const char* vector_width() {
  constexpr const char* names[] = {"SSE2 (2 doubles)", "AVX2 (4 doubles)", "AVX-512 (8 doubles)"};
  return names[static_cast<int>(vector_size())];
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
FRETWORK_INLINE ForcedSums flow_forced_on(int np, const FlowTable& table, double* q, double* v,
                                          const double* f0, const double* f1, const double* force,
                                          const double* slope) {
  Sums<V> load_work = {}, contact_work = {}, energy = {};
  for_vectors<V>(
      np, [&](int pack, int part) __attribute__((always_inline)) {
        const int offset = part * size_of<V>, i = pack + offset;
        const FlowNumbers<V> of{table.data() + FlowTable::numbers * pack + offset};
        const V q0 = at<V>(q + i), v0 = at<V>(v + i), l0 = at<V>(f0 + i), l1 = at<V>(f1 + i);
        const V g0 = at<V>(force + i) - at<V>(slope + i), g1 = at<V>(force + i) + at<V>(slope + i);
        const V a = l0 + g0, b = l1 + g1;
        const V q1 = of[1] * q0 + of[2] * v0 + of[3] * a + of[4] * b;
        const V v1 = of[5] * q0 + of[6] * v0 + of[7] * a + of[8] * b;
        const V mean = of[9] * q0 + of[10] * v0 + of[11] * a + of[12] * b;
        load_work[part] += l0 * (q1 - q0) + (l1 - l0) * (q1 - mean);
        contact_work[part] += g0 * (q1 - q0) + (g1 - g0) * (q1 - mean);
        energy[part] += v1 * v1 + of[0] * q1 * q1;
        at<V>(q + i) = q1;
        at<V>(v + i) = v1;
      });
  return {sum(load_work), sum(contact_work), sum(energy)};
}
FRETWORK_KERNEL(ForcedSums, flow_forced,
                (int np, const FlowTable& table, double* q, double* v, const double* f0, const double* f1,
                 const double* mean, const double* slope),
                (np, table, q, v, f0, f1, mean, slope))

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
  for_count(
      sources, [&](auto count) __attribute__((always_inline)) {
        for (int i = 0; i < np; i += size_of<V>) {
          V s{};
          for (int k = 0; k < count; ++k)
            s += values[k] * at<V>(shapes + static_cast<std::ptrdiff_t>(k) * np + i);
          at<V>(f + i) = s;
        }
      });
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

template <class V>
FRETWORK_INLINE void middle_on(int np, const MiddleTable& table, const double* q0, const double* v0,
                               const double* f0, const double* f1, const double* mean, const double* slope,
                               double* q) {
  for_vectors<V>(
      np, [&](int pack, int part) __attribute__((always_inline)) {
        const int offset = part * size_of<V>, i = pack + offset;
        const FlowNumbers<V> of{table.data() + MiddleTable::numbers * pack + offset};
        const V g = at<V>(mean + i), s = at<V>(slope + i);
        at<V>(q + i) = of[0] * at<V>(q0 + i) + of[1] * at<V>(v0 + i) + of[2] * (at<V>(f0 + i) + g - s) +
                       of[3] * (at<V>(f1 + i) + g + s);
      });
}
FRETWORK_KERNEL(void, middle,
                (int np, const MiddleTable& table, const double* q0, const double* v0, const double* f0,
                 const double* f1, const double* mean, const double* slope, double* q),
                (np, table, q0, v0, f0, f1, mean, slope, q))

void GatherTable::add_pack(const std::map<int, std::array<double, lanes>>& values_of_modes) {
  for (const auto& [mode, of_rows] : values_of_modes) {
    modes.push_back(mode);
    values.insert(values.end(), of_rows.begin(), of_rows.end());
  }
  begin.push_back(static_cast<int>(modes.size()));
}

/// Pack p of to[n] = G from[n]: two sums each, so that none waits for the other.
template <class G, std::size_t count>
FRETWORK_INLINE void gather_pack(const GatherTable& g, int p, const double* const (&from)[count],
                                 double* const (&to)[count]) {
  using V = typename G::V;
  constexpr int size = size_of<V>;
  V sum[G::parts][count][2] = {};
  const int end = g.begin[p + 1];
  const auto add = [&](int k, int into) __attribute__((always_inline)) {
    const double* values = &g.values[static_cast<std::size_t>(k) * lanes];
    for_parts<G>([&](auto part) __attribute__((always_inline)) {
      const V value = at<V>(values + part * size);
      for (std::size_t n = 0; n < count; ++n)
        sum[part][n][into] += from[n][g.modes[k]] * value;
    });
  };
  int k = g.begin[p];
  for (; k + 1 < end; k += 2) {
    add(k, 0);
    add(k + 1, 1);
  }
  if (k < end)
    add(k, 0);
  for_parts<G>([&](auto part) __attribute__((always_inline)) {
    for (std::size_t n = 0; n < count; ++n)
      at<V>(to[n] + p * lanes + part * size) = sum[part][n][0] + sum[part][n][1];
  });
}

template <class Widest, std::size_t count>
FRETWORK_INLINE void gather_one(const GatherTable& g, int p, const double* const (&from)[count],
                                double* const (&to)[count]) {
  if (g.half)
    gather_pack<Grain<Widest, Half>, count>(g, p, from, to);
  else
    gather_pack<Grain<Widest, Pack>, count>(g, p, from, to);
}

/// Adds the parts of rows that stand by themselves.
template <class V, std::size_t count>
FRETWORK_INLINE void gather_parts(const GatherTable& g, const double* const (&from)[count],
                                  double* const (&to)[count]) {
  for (const GatherTable::Part& part : g.parts) {
    const double* values = g.of_parts.data() + part.values;
    Sums<V> sums[count] = {};
    for_vectors<V>(
        part.size, [&](int pack, int of_pack) __attribute__((always_inline)) {
          const int i = pack + of_pack * size_of<V>;
          for (std::size_t n = 0; n < count; ++n)
            sums[n][of_pack] += at<V>(values + i) * at<V>(from[n] + part.first + i);
        });
    for (std::size_t n = 0; n < count; ++n)
      to[n][part.lane] += sum(sums[n]);
  }
}

template <class V>
FRETWORK_INLINE void gather_two_on(const GatherTable& g, const double* q, const double* v, double* u,
                                   double* w) {
  const int packs = static_cast<int>(g.begin.size()) - 1;
  for (int p = 0; p < packs; ++p)
    gather_one<V, 2>(g, p, {q, v}, {u, w});
  gather_parts<V, 2>(g, {q, v}, {u, w});
}
FRETWORK_KERNEL(void, gather_two,
                (const GatherTable& g, const double* q, const double* v, double* u, double* w),
                (g, q, v, u, w))

template <class V> FRETWORK_INLINE void gather_on(const GatherTable& g, const double* q, double* u) {
  const int packs = static_cast<int>(g.begin.size()) - 1;
  for (int p = 0; p < packs; ++p)
    gather_one<V, 1>(g, p, {q}, {u});
  gather_parts<V, 1>(g, {q}, {u});
}
FRETWORK_KERNEL(void, gather, (const GatherTable& g, const double* q, double* u), (g, q, u))

template <class V>
FRETWORK_INLINE void gather_together_on(const GatherTable& g, const double* q, int q_stride, double* u,
                                        int u_stride) {
  const double* from[gathered_together];
  double* to[gathered_together];
  for (int n = 0; n < gathered_together; ++n) {
    from[n] = q + n * q_stride;
    to[n] = u + n * u_stride;
  }
  const int packs = static_cast<int>(g.begin.size()) - 1;
  for (int p = 0; p < packs; ++p)
    gather_one<V, gathered_together>(g, p, from, to);
  gather_parts<V, gathered_together>(g, from, to);
}
FRETWORK_KERNEL(void, gather_together,
                (const GatherTable& g, const double* q, int q_stride, double* u, int u_stride),
                (g, q, q_stride, u, u_stride))

template <class V>
FRETWORK_INLINE void scatter_on(int np, int rows, const double* const* row, const double* factor, double* v) {
  for_count(
      rows, [&](auto count) __attribute__((always_inline)) {
        for (int i = 0; i < np; i += size_of<V>) {
          V s = at<V>(v + i);
          for (int r = 0; r < count; ++r)
            s += factor[r] * at<V>(row[r] + i);
          at<V>(v + i) = s;
        }
      });
}
FRETWORK_KERNEL(void, scatter, (int np, int rows, const double* const* row, const double* factor, double* v),
                (np, rows, row, factor, v))

/// Lanes i to i + vectors size_of<V> of all targets.
template <class V, int targets, int vectors>
FRETWORK_INLINE void scatter_here(int i, int rows, const double* const* row, const ScatterTarget* target) {
  V s[targets][vectors];
  for (int t = 0; t < targets; ++t)
    for (int n = 0; n < vectors; ++n)
      s[t][n] = at<V>(target[t].v + i + n * size_of<V>);
  for (int r = 0; r < rows; ++r)
#pragma GCC unroll 4
    for (int n = 0; n < vectors; ++n) {
      const V values = at<V>(row[r] + i + n * size_of<V>);
#pragma GCC unroll 5
      for (int t = 0; t < targets; ++t)
        s[t][n] += target[t].factor[r] * values;
    }
  for (int t = 0; t < targets; ++t)
    for (int n = 0; n < vectors; ++n)
      at<V>(target[t].v + i + n * size_of<V>) = s[t][n];
}
template <class V, int targets>
FRETWORK_INLINE void scatter_to(int np, int rows, const double* const* row, const ScatterTarget* target) {
  constexpr int together = 4 * size_of<V>; // factors are read once for so many
  int i = 0;
  for (; i + together <= np; i += together)
    scatter_here<V, targets, 4>(i, rows, row, target);
  for (; i < np; i += size_of<V>)
    scatter_here<V, targets, 1>(i, rows, row, target);
}
template <class V>
FRETWORK_INLINE void scatter_several_on(int np, int rows, const double* const* row, int targets,
                                        const ScatterTarget* target) {
  if (targets == 2)
    scatter_to<V, 2>(np, rows, row, target);
  else if (targets == 3)
    scatter_to<V, 3>(np, rows, row, target);
  else if (targets == 4)
    scatter_to<V, 4>(np, rows, row, target);
  else
    scatter_to<V, 5>(np, rows, row, target);
}
FRETWORK_KERNEL(void, scatter_several,
                (int np, int rows, const double* const* row, int targets, const ScatterTarget* target),
                (np, rows, row, targets, target))

template <class V>
FRETWORK_INLINE EulerSums euler_step_on(int np, double h, const double* c, const double* k,
                                        const double* load, const double* force, double* q, double* v) {
  Sums<V> energy = {}, power = {}, loss = {};
  for_vectors<V>(
      np, [&](int pack, int part) __attribute__((always_inline)) {
        const int i = pack + part * size_of<V>;
        const V q0 = at<V>(q + i), v0 = at<V>(v + i), ci = at<V>(c + i), kq = at<V>(k + i) * q0,
                f = at<V>(load + i);
        const V v1 = v0 + h * (f + at<V>(force + i) - ci * v0 - kq);
        const V vm = 0.5 * (v0 + v1);
        energy[part] += vm * vm + kq * q0;
        power[part] += f * vm;
        loss[part] += ci * vm * vm;
        at<V>(v + i) = v1;
        at<V>(q + i) = q0 + h * v1;
      });
  return {sum(energy), sum(power), sum(loss)};
}
FRETWORK_KERNEL(EulerSums, euler_step,
                (int np, double h, const double* c, const double* k, const double* load, const double* force,
                 double* q, double* v),
                (np, h, c, k, load, force, q, v))

} // namespace fretwork::kernels
