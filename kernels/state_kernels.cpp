// SPDX-License-Identifier: GPL-3.0-or-later
#include "kernels/state_kernels.hpp"
#include "kernels/vector_lanes.hpp"

namespace fretwork::kernels {

/// Complex numbers, or real ones where `pair` is false: one of `lanes` in each place.
template <class V, bool pair> struct Complex { V re, im; };
template <class V> struct Complex<V, false> { V re; };
template <class V, bool pair>
FRETWORK_INLINE Complex<V, pair> numbers_at(const double* array, int i, int pairs) {
  if constexpr (pair)
    return {at<V>(array + i), at<V>(array + pairs + i)};
  else
    return {at<V>(array + i)};
}
/// c x; products are rounded where two of them meet, so that vectors of all sizes give the same bytes.
template <class V, bool pair>
FRETWORK_INLINE Complex<V, pair> product(const Complex<V, pair>& c, const Complex<V, pair>& x) {
  if constexpr (pair)
    return {rounded(c.re * x.re) - c.im * x.im, rounded(c.re * x.im) + c.im * x.re};
  else
    return {rounded(c.re * x.re)};
}
/// s += c x.
template <class V, bool pair>
FRETWORK_INLINE void add_product(Complex<V, pair>& s, const Complex<V, pair>& c, const Complex<V, pair>& x) {
  s.re += c.re * x.re;
  if constexpr (pair) {
    s.re -= c.im * x.im;
    s.im += c.re * x.im;
    s.im += c.im * x.re;
  }
}
/// s += row x, of real numbers.
template <class V, bool pair>
FRETWORK_INLINE void add_power(V& s, const Complex<V, pair>& row, const Complex<V, pair>& x) {
  s += row.re * x.re;
  if constexpr (pair)
    s += row.im * x.im;
}

/// The inputs of a block at both ends of a step.
template <class V, bool pair> struct InputEnds {
  Complex<V, pair> load0, load1, force0, force1;
  /// @param array  which of the three
  static __attribute__((always_inline)) InputEnds of(const StateInputs& x, StateCount count, int array,
                                                     int i) {
    const auto numbers = [&](const double* from) __attribute__((always_inline)) {
      return numbers_at<V, pair>(from + array * count.width(), i, count.pairs);
    };
    const Complex<V, pair> mean = numbers(x.mean), slope = numbers(x.slope);
    InputEnds out{numbers(x.load0), numbers(x.load1), mean, mean};
    out.force0.re -= slope.re;
    out.force1.re += slope.re;
    if constexpr (pair) {
      out.force0.im -= slope.im;
      out.force1.im += slope.im;
    }
    return out;
  }
  /// Load and contact force together.
  static __attribute__((always_inline)) Complex<V, pair> sum(const Complex<V, pair>& a,
                                                             const Complex<V, pair>& b) {
    if constexpr (pair)
      return {a.re + b.re, a.im + b.im};
    else
      return {a.re + b.re};
  }
};

/// step(i, part, pairs or not) for all vectors of a block.
template <class V, class Step> FRETWORK_INLINE void for_states(StateCount count, const Step& step) {
  for_vectors<V>(
      count.pairs, [&](int pack, int part) __attribute__((always_inline)) {
        step(pack + part * size_of<V>, part, std::true_type{});
      });
  for_vectors<V>(
      count.reals, [&](int pack, int part) __attribute__((always_inline)) {
        step(2 * count.pairs + pack + part * size_of<V>, part, std::false_type{});
      });
}

template <class V>
FRETWORK_INLINE void move_states_on(StateCount count, const double* table, const double* y0,
                                    const StateInputs& inputs, double* y, double* rate) {
  for_states<V>(
      count, [&](int i, int, auto pair) __attribute__((always_inline)) {
        using Ends = InputEnds<V, pair>;
        const auto number = [&](int k) __attribute__((always_inline)) {
          return numbers_at<V, pair>(table + k * count.width(), i, count.pairs);
        };
        const Ends g = Ends::of(inputs, count, 0, i);
        auto to = product(number(StateTable::e), numbers_at<V, pair>(y0, i, count.pairs));
        add_product(to, number(StateTable::a0), Ends::sum(g.load0, g.force0));
        add_product(to, number(StateTable::a1), Ends::sum(g.load1, g.force1));
        const auto moves = product(number(StateTable::l), to);
        at<V>(y + i) = to.re;
        at<V>(rate + i) = moves.re;
        if constexpr (pair) {
          at<V>(y + count.pairs + i) = to.im;
          at<V>(rate + count.pairs + i) = moves.im;
        }
      });
}
FRETWORK_KERNEL(void, move_states,
                (StateCount count, const double* table, const double* y0, const StateInputs& inputs,
                 double* y, double* rate),
                (count, table, y0, inputs, y, rate))

template <class V>
FRETWORK_INLINE StateWorks state_works_on(StateCount count, const double* table, const double* y0,
                                          const StateInputs& inputs) {
  Sums<V> load = {}, contact = {}, fluid = {};
  for_states<V>(
      count, [&](int i, int part, auto pair) __attribute__((always_inline)) {
        using Ends = InputEnds<V, pair>;
        const auto number = [&](int k) __attribute__((always_inline)) {
          return numbers_at<V, pair>(table + k * count.width(), i, count.pairs);
        };
        const Ends g = Ends::of(inputs, count, 0, i), power = Ends::of(inputs, count, 1, i),
                   fed = Ends::of(inputs, count, 2, i);
        const auto from = numbers_at<V, pair>(y0, i, count.pairs), g0 = Ends::sum(g.load0, g.force0),
                   g1 = Ends::sum(g.load1, g.force1);
        auto early = product(number(StateTable::p), from), late = product(number(StateTable::r), from);
        add_product(early, number(StateTable::p0), g0);
        add_product(early, number(StateTable::p1), g1);
        add_product(late, number(StateTable::r0), g0);
        add_product(late, number(StateTable::r1), g1);
        add_power(load[part], power.load0, early);
        add_power(load[part], power.load1, late);
        add_power(contact[part], power.force0, early);
        add_power(contact[part], power.force1, late);
        add_power(fluid[part], Ends::sum(fed.load0, fed.force0), early);
        add_power(fluid[part], Ends::sum(fed.load1, fed.force1), late);
      });
  return {sum(load), sum(contact), sum(fluid)};
}
FRETWORK_KERNEL(StateWorks, state_works,
                (StateCount count, const double* table, const double* y0, const StateInputs& inputs),
                (count, table, y0, inputs))

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

} // namespace fretwork::kernels
