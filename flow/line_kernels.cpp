// SPDX-License-Identifier: GPL-3.0-or-later
#include "flow/line_kernels.hpp"
#include "flow/philox.hpp"
#include <bit>
#include <numbers>

// One text, one copy for each width of vectors; not under the sanitizers, nor with compilers that lack it.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(FRETWORK_SANITIZED)
#define FRETWORK_LINES_BY_PROCESSOR
#endif
#define FRETWORK_INLINE static inline __attribute__((always_inline))

namespace fretwork::flow {
namespace {

typedef double Pack __attribute__((vector_size(64)));
typedef double Half __attribute__((vector_size(32)));
typedef double Pair __attribute__((vector_size(16)));

constexpr int calls = group_lines / 2; ///< of Philox in a group

struct Words {
  alignas(64) std::uint32_t c[4][calls];
};

FRETWORK_INLINE void draw_words(const LineSequence& s, std::uint32_t group, Words& w) {
  using P = PhiloxConstants;
  for (int l = 0; l < calls; ++l) {
    w.c[0][l] = static_cast<std::uint32_t>(calls) * group + static_cast<std::uint32_t>(l);
    w.c[1][l] = s.block;
    w.c[2][l] = s.point;
    w.c[3][l] = s.stream;
  }
  std::uint32_t k0 = s.seed, k1 = s.draw;
  for (int round = 0; round < P::rounds; ++round) {
    for (int l = 0; l < calls; ++l) {
      const std::uint64_t a = std::uint64_t{P::m0} * w.c[0][l], b = std::uint64_t{P::m1} * w.c[2][l];
      w.c[0][l] = static_cast<std::uint32_t>(b >> 32) ^ w.c[1][l] ^ k0;
      w.c[1][l] = static_cast<std::uint32_t>(b);
      w.c[2][l] = static_cast<std::uint32_t>(a >> 32) ^ w.c[3][l] ^ k1;
      w.c[3][l] = static_cast<std::uint32_t>(a);
    }
    k0 += P::w0;
    k1 += P::w1;
  }
}

/// c0 + c1 z + c2 z^2 ...
FRETWORK_INLINE double series(double, double last) { return last; }
template <class... More> FRETWORK_INLINE double series(double z, double first, More... more) {
  return series(z, more...) * z + first;
}

/// ln((x + 1/2)/2^32): u = 2^k m, m between sqrt(1/2) and sqrt 2, ln m = 2 artanh((m - 1)/(m + 1)).
FRETWORK_INLINE double log_of_word(std::uint32_t x) {
  const double u =
      static_cast<double>(static_cast<std::int32_t>(x ^ 0x80000000u)) * 0x1p-32 + (0.5 + 0x1p-33);
  constexpr std::uint64_t root_half = 0x3FE6A09E667F3BCD, shift = std::uint64_t{1024} << 52;
  const auto bits = std::bit_cast<std::uint64_t>(u);
  const std::uint64_t exponent = (bits - root_half + shift) >> 52; // k + 1024
  const double m = std::bit_cast<double>(bits - (exponent << 52) + shift);
  const double k = std::bit_cast<double>(exponent | 0x4330000000000000) - (0x1p52 + 1024.0);
  const double s = (m - 1.0) / (m + 1.0), z = s * s;
  return k * std::numbers::ln2 + 2.0 * s *
                                     series(z, 1.0, 1.0 / 3.0, 1.0 / 5.0, 1.0 / 7.0, 1.0 / 9.0, 1.0 / 11.0,
                                            1.0 / 13.0, 1.0 / 15.0, 1.0 / 17.0);
}

/// r times cosine and sine of 2 pi y/2^32, by the nearest quarter turn and the series of what is left.
FRETWORK_INLINE void polar(double r, std::uint32_t y, double& re, double& im) {
  const std::uint32_t quarter = (y + 0x20000000u) >> 30;
  const double a = static_cast<double>(static_cast<std::int32_t>(y - (quarter << 30))) *
                   (2.0 * std::numbers::pi * 0x1p-32);
  const double z = a * a;
  const double cosine = series(z, 1.0, -0.5, 1.0 / 24.0, -1.0 / 720.0, 1.0 / 40320.0, -1.0 / 3628800.0,
                               1.0 / 479001600.0, -1.0 / 87178291200.0, 1.0 / 20922789888000.0);
  const double sine = a * series(z, 1.0, -1.0 / 6.0, 1.0 / 120.0, -1.0 / 5040.0, 1.0 / 362880.0,
                                 -1.0 / 39916800.0, 1.0 / 6227020800.0, -1.0 / 1307674368000.0);
  const bool odd = (quarter & 1u) != 0;
  const double c = r * (odd ? sine : cosine), s = r * (odd ? cosine : sine);
  const auto sign = [](std::uint32_t bit_1) { return static_cast<std::uint64_t>(bit_1 & 2u) << 62; };
  re = std::bit_cast<double>(std::bit_cast<std::uint64_t>(c) ^ sign(quarter + 1u));
  im = std::bit_cast<double>(std::bit_cast<std::uint64_t>(s) ^ sign(quarter));
}

FRETWORK_INLINE void draw_lines_on(const LineSequence& sequence, std::uint32_t group, double* e) {
  Words w;
  draw_words(sequence, group, w);
  for (int half = 0; half < 2; ++half) {
    const std::uint32_t *x = w.c[2 * half], *y = w.c[2 * half + 1];
    double* re = e + half * calls;
    double* im = re + group_lines;
    if (sequence.phase_only)
      for (int l = 0; l < calls; ++l)
        polar(std::numbers::sqrt2, y[l], re[l], im[l]);
    else
      for (int l = 0; l < calls; ++l)
        polar(__builtin_sqrt(-2.0 * log_of_word(x[l])), y[l], re[l], im[l]);
  }
}

FRETWORK_INLINE void advance_lines_on(const LineSequence& sequence, std::uint32_t group, double r,
                                      const double* amplitude, double* __restrict z, double* __restrict y) {
  alignas(64) double e[group_size];
  draw_lines_on(sequence, group, e);
  const double fresh = __builtin_sqrt((1.0 - r) * (1.0 + r));
  for (int part = 0; part < group_size; part += group_lines)
    for (int l = 0; l < group_lines; ++l) {
      const double value = r * z[part + l] + fresh * e[part + l];
      z[part + l] = value;
      y[part + l] = amplitude[l] * value;
    }
}

/// Two vectors of columns of four modes at a time: the sums stay in registers over all points.
template <class V>
FRETWORK_INLINE void project_lines_on(int blocks, int points, const double* shapes, const double* lines,
                                      double* sums, std::ptrdiff_t stride) {
  constexpr int width = sizeof(V) / sizeof(double);
  for (int column = 0; column < group_size; column += 2 * width)
    for (int block = 0; block < blocks; ++block) {
      V sum[mode_block][2] = {};
      const double* shape = shapes + static_cast<std::ptrdiff_t>(block) * points * mode_block;
      const double* line = lines + column;
      for (int k = 0; k < points; ++k, shape += mode_block, line += group_size) {
        const V a = *reinterpret_cast<const V*>(line), b = *reinterpret_cast<const V*>(line + width);
#pragma GCC unroll 4
        for (int i = 0; i < mode_block; ++i) {
          sum[i][0] += shape[i] * a;
          sum[i][1] += shape[i] * b;
        }
      }
      for (int i = 0; i < mode_block; ++i) {
        V* to = reinterpret_cast<V*>(sums + (block * mode_block + i) * stride + column);
        to[0] += sum[i][0];
        to[1] += sum[i][1];
      }
    }
}

/// The copies of all kernels for vectors V, compiled for `target`.
#define FRETWORK_COPIES(name, V, target)                                                                     \
  target void draw_##name(const LineSequence& s, std::uint32_t group, double* e) {                           \
    draw_lines_on(s, group, e);                                                                              \
  }                                                                                                          \
  target void advance_##name(const LineSequence& s, std::uint32_t group, double r, const double* amplitude,  \
                             double* z, double* y) {                                                         \
    advance_lines_on(s, group, r, amplitude, z, y);                                                          \
  }                                                                                                          \
  target void project_##name(int blocks, int points, const double* shapes, const double* lines,              \
                             double* sums, std::ptrdiff_t stride) {                                          \
    project_lines_on<V>(blocks, points, shapes, lines, sums, stride);                                        \
  }
FRETWORK_COPIES(pairs, Pair, )
#ifdef FRETWORK_LINES_BY_PROCESSOR
FRETWORK_COPIES(halves, Half, __attribute__((target("arch=x86-64-v3"))))
FRETWORK_COPIES(packs, Pack, __attribute__((target("arch=x86-64-v4"))))
#endif

struct Kernels {
  decltype(&draw_pairs) draw = draw_pairs;
  decltype(&advance_pairs) advance = advance_pairs;
  decltype(&project_pairs) project = project_pairs;
  Kernels() {
#ifdef FRETWORK_LINES_BY_PROCESSOR
    __builtin_cpu_init();
    if (__builtin_cpu_supports("x86-64-v4")) {
      draw = draw_packs;
      advance = advance_packs;
      project = project_packs;
    } else if (__builtin_cpu_supports("x86-64-v3")) {
      draw = draw_halves;
      advance = advance_halves;
      project = project_halves;
    }
#endif
  }
};

/// For the processor that runs the program.
const Kernels& kernels() {
  static const Kernels chosen;
  return chosen;
}

} // namespace

void draw_lines(const LineSequence& sequence, std::uint32_t group, double* e) {
  kernels().draw(sequence, group, e);
}

void advance_lines(const LineSequence& sequence, std::uint32_t group, double r, const double* amplitude,
                   double* z, double* y) {
  kernels().advance(sequence, group, r, amplitude, z, y);
}

void project_lines(int blocks, int points, const double* shapes, const double* lines, double* sums,
                   std::ptrdiff_t stride) {
  kernels().project(blocks, points, shapes, lines, sums, stride);
}

} // namespace fretwork::flow
