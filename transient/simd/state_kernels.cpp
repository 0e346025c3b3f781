// SPDX-License-Identifier: GPL-3.0-or-later
#include "transient/simd/state_kernels.hpp"
#include "transient/simd/vector_lanes.hpp"

namespace fretwork::transient::kernels {

template <class V> FRETWORK_INLINE void decay_states_on(StateCount count, const double* decay, double* y) {
  double* im = y + count.pairs;
  for (int i = 0; i < count.pairs; i += size_of<V>) {
    const V e = at<V>(decay + i), f = at<V>(decay + count.pairs + i), a = at<V>(y + i), b = at<V>(im + i);
    at<V>(y + i) = e * a - f * b;
    at<V>(im + i) = f * a + e * b;
  }
  for (int i = 2 * count.pairs; i < count.width(); i += size_of<V>)
    at<V>(y + i) = at<V>(decay + i) * at<V>(y + i);
}
FRETWORK_KERNEL(void, decay_states, (StateCount count, const double* decay, double* y), (count, decay, y))

template <class V>
FRETWORK_INLINE void load_states_on(StateCount count, const double* answer, const double* g0,
                                    const double* g1, double* y) {
  const double* late = answer + count.width();
  for (int i = 0, j = count.pairs; i < count.pairs; i += size_of<V>, j += size_of<V>) {
    const V a = at<V>(answer + i), b = at<V>(answer + j), c = at<V>(late + i), d = at<V>(late + j);
    const V re0 = at<V>(g0 + i), im0 = at<V>(g0 + j), re1 = at<V>(g1 + i), im1 = at<V>(g1 + j);
    at<V>(y + i) += a * re0 - b * im0 + c * re1 - d * im1;
    at<V>(y + j) += a * im0 + b * re0 + c * im1 + d * re1;
  }
  for (int i = 2 * count.pairs; i < count.width(); i += size_of<V>)
    at<V>(y + i) += at<V>(answer + i) * at<V>(g0 + i) + at<V>(late + i) * at<V>(g1 + i);
}
FRETWORK_KERNEL(void, load_states,
                (StateCount count, const double* answer, const double* g0, const double* g1, double* y),
                (count, answer, g0, g1, y))

/// A tile of so many packs of rows, two columns at once: enough sums that none waits for another.
template <class V, int packs>
FRETWORK_INLINE void multiply_tile(int columns, const double* values, const double* x, double* y) {
  constexpr int rows = packs * lanes, vectors = rows / size_of<V>;
  V sum[2][vectors] = {};
  int k = 0;
  for (; k + 1 < columns; k += 2, values += 2 * rows)
#pragma GCC unroll 8
    for (int n = 0; n < vectors; ++n) {
      sum[0][n] += x[k] * at<V>(values + n * size_of<V>);
      sum[1][n] += x[k + 1] * at<V>(values + rows + n * size_of<V>);
    }
  if (k < columns)
    for (int n = 0; n < vectors; ++n)
      sum[0][n] += x[k] * at<V>(values + n * size_of<V>);
  for (int n = 0; n < vectors; ++n)
    at<V>(y + n * size_of<V>) = sum[0][n] + sum[1][n];
}

template <class V>
FRETWORK_INLINE void multiply_on(int np, int columns, const double* matrix, const double* x, double* y) {
  int first = 0;
  for (; first + tile <= np; first += tile, matrix += static_cast<std::ptrdiff_t>(tile) * columns)
    multiply_tile<V, 2>(columns, matrix, x, y + first);
  if (first < np)
    multiply_tile<V, 1>(columns, matrix, x, y + first);
}
FRETWORK_KERNEL(void, multiply, (int np, int columns, const double* matrix, const double* x, double* y),
                (np, columns, matrix, x, y))

template <class V>
FRETWORK_INLINE OwnWorks own_works_on(int np, const FlowTable& table, const double* inverse, const double* q0,
                                      const double* v0, const double* q1, const double* v1, const double* l0,
                                      const double* l1, const double* mean, const double* slope, double* own0,
                                      double* own1, double* mean_q) {
  Sums<V> load = {}, contact = {}, own = {}, energy = {};
  for_vectors<V>(
      np, [&](int pack, int part) __attribute__((always_inline)) {
        const int offset = part * size_of<V>, i = pack + offset;
        const double* of = table.data() + FlowTable::numbers * pack + offset;
        const double* to = inverse + 4 * pack + offset;
        const auto number = [&](int k) __attribute__((always_inline)) { return at<V>(of + k * lanes); };
        const V q = at<V>(q0 + i), v = at<V>(v0 + i), qe = at<V>(q1 + i), ve = at<V>(v1 + i);
        const V g0 = at<V>(mean + i) - at<V>(slope + i), g1 = at<V>(mean + i) + at<V>(slope + i);
        const V a = at<V>(l0 + i) + g0, b = at<V>(l1 + i) + g1;
        const V dq = qe - (number(1) * q + number(2) * v + number(3) * a + number(4) * b);
        const V dv = ve - (number(5) * q + number(6) * v + number(7) * a + number(8) * b);
        const V f0 = at<V>(to) * dq + at<V>(to + lanes) * dv;
        const V f1 = at<V>(to + 2 * lanes) * dq + at<V>(to + 3 * lanes) * dv;
        const V mean_of_q = number(9) * q + number(10) * v + number(11) * (a + f0) + number(12) * (b + f1);
        const V way = qe - q, late = qe - mean_of_q; // int f q' dt by parts, f linear
        load[part] += at<V>(l0 + i) * way + (at<V>(l1 + i) - at<V>(l0 + i)) * late;
        contact[part] += g0 * way + (g1 - g0) * late;
        own[part] += f0 * way + (f1 - f0) * late;
        energy[part] += ve * ve + number(0) * qe * qe;
        at<V>(own0 + i) = f0;
        at<V>(own1 + i) = f1;
        at<V>(mean_q + i) = mean_of_q;
      });
  return {sum(load), sum(contact), sum(own), sum(energy)};
}
FRETWORK_KERNEL(OwnWorks, own_works,
                (int np, const FlowTable& table, const double* inverse, const double* q0, const double* v0,
                 const double* q1, const double* v1, const double* l0, const double* l1, const double* mean,
                 const double* slope, double* own0, double* own1, double* mean_q),
                (np, table, inverse, q0, v0, q1, v1, l0, l1, mean, slope, own0, own1, mean_q))

} // namespace fretwork::transient::kernels
