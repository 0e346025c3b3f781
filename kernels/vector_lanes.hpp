// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Vector lanes for kernels: packs of `lanes` doubles in vectors that are registers of the processor, and one copy of each kernel for
/// each size of these, chosen when the program starts. Included by files of kernels only, not by headers.
///
/// A kernel is a template over the vector type: of one text over Packs GCC would make copies too (target_clones), but keep a Pack that lives
/// from turn to turn of a loop in memory where no register holds it, two to ten times slower.
#pragma once
#include "kernels/kernels.hpp"
#include <type_traits>
#include <utility>

// Not under the sanitizers (with which these take minutes to compile), nor with compilers that lack it.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(FRETWORK_SANITIZED)
#define FRETWORK_KERNELS_BY_PROCESSOR
#include <immintrin.h> // GCC declares the builtins of processors here
/// Defines the kernel `name` by the template name##_on<V>.
#define FRETWORK_KERNEL(result, name, parameters, arguments)                                                 \
  __attribute__((target("arch=x86-64-v4"))) static result name##_by_packs parameters {                       \
    return name##_on<Pack> arguments;                                                                        \
  }                                                                                                          \
  __attribute__((target("arch=x86-64-v3"))) static result name##_by_halves parameters {                      \
    return name##_on<Half> arguments;                                                                        \
  }                                                                                                          \
  static result name##_by_pairs parameters { return name##_on<Pair> arguments; }                             \
  const Kernel<result parameters> name(name##_by_pairs, name##_by_halves, name##_by_packs);
#else
#define FRETWORK_KERNEL(result, name, parameters, arguments)                                                 \
  static result name##_by_pairs parameters { return name##_on<Pair> arguments; }                             \
  const Kernel<result parameters> name(name##_by_pairs, name##_by_pairs, name##_by_pairs);
#endif
#define FRETWORK_INLINE static inline __attribute__((always_inline))

namespace fretwork::kernels {

typedef double Pack __attribute__((vector_size(64)));
typedef double Half __attribute__((
    vector_size(32))); ///< the first lanes of a pack: enough for few contacts, and half the work
typedef double Pair __attribute__((vector_size(16)));

/// V is a Pack, a Half or a double where a kernel is written for all.
template <class V = Pack> FRETWORK_INLINE const V& at(const double* p) {
  return *reinterpret_cast<const V*>(p);
}
template <class V = Pack> FRETWORK_INLINE V& at(double* p) { return *reinterpret_cast<V*>(p); }
template <class V> inline constexpr int size_of = static_cast<int>(sizeof(V) / sizeof(double));
/// By halves: two instructions each where lanes by themselves take one or two each.
FRETWORK_INLINE double sum(const Pair& p) { return p[0] + p[1]; }
FRETWORK_INLINE double sum(const Half& p) {
  return sum(Pair(__builtin_shufflevector(p, p, 0, 1) + __builtin_shufflevector(p, p, 2, 3)));
}
FRETWORK_INLINE double sum(const Pack& p) {
  return sum(Half(__builtin_shufflevector(p, p, 0, 1, 2, 3) + __builtin_shufflevector(p, p, 4, 5, 6, 7)));
}
FRETWORK_INLINE double largest(const Pack& p) {
  const auto max = [](double a, double b) { return a > b ? a : b; };
  return max(max(max(p[0], p[4]), max(p[2], p[6])), max(max(p[1], p[5]), max(p[3], p[7])));
}
FRETWORK_INLINE double largest(const Half& p) {
  const auto max = [](double a, double b) { return a > b ? a : b; };
  return max(max(p[0], p[2]), max(p[1], p[3]));
}
FRETWORK_INLINE double sum(double p) { return p; }
FRETWORK_INLINE double largest(double p) { return p; }
FRETWORK_INLINE double largest(const Pair& p) { return p[0] > p[1] ? p[0] : p[1]; }
/// Sums as they grow, in registers of any kernel: those of all lanes in any vectors give the same bytes.
template <class V> FRETWORK_INLINE double sum(const V (&p)[1]) { return sum(p[0]); }
template <class V> FRETWORK_INLINE double sum(const V (&p)[2]) { return sum(p[0] + p[1]); }
FRETWORK_INLINE double sum(const Pair (&p)[4]) { return sum((p[0] + p[2]) + (p[1] + p[3])); }
template <class V> using Sums = V[lanes / size_of<V>];
/// Whether any flag of a vector is set (1, not 0).
FRETWORK_INLINE bool any(double flag) { return flag != 0.0; }
FRETWORK_INLINE bool any(const Pair& flags) { return flags[0] + flags[1] != 0.0; }
#ifdef FRETWORK_KERNELS_BY_PROCESSOR
// One instruction each; sums of all lanes take some fifteen.
FRETWORK_INLINE bool any(const Half& flags) {
  typedef long long Bits __attribute__((vector_size(32)));
  return __builtin_ia32_ptestz256(reinterpret_cast<Bits>(flags), reinterpret_cast<Bits>(flags)) == 0;
}
FRETWORK_INLINE bool any(const Pack& flags) {
  typedef long long Bits __attribute__((vector_size(64)));
  return __builtin_ia32_ptestmq512(reinterpret_cast<Bits>(flags), reinterpret_cast<Bits>(flags), 0xff) != 0;
}
#endif
/// step(pack, part) for all vectors, `part` that of the pack whose first lane is `pack`.
template <class V, class Step> FRETWORK_INLINE void for_vectors(int lanes_in_all, const Step& step) {
  for (int pack = 0; pack < lanes_in_all; pack += lanes)
#pragma GCC unroll 4
    for (int part = 0; part < lanes / size_of<V>; ++part)
      step(pack, part);
}

/// A place of contacts in the vectors of a kernel: a Pack, a Half or a double in parts that are no wider than `Widest`.
template <class Widest, class Place> struct Grain {
  using V = std::conditional_t<(sizeof(Place) < sizeof(Widest)), Place, Widest>;
  static constexpr int parts = static_cast<int>(sizeof(Place) / sizeof(V));
  using Sums = V[parts];
  static constexpr int together = static_cast<int>(sizeof(Place) / sizeof(double)); ///< contacts of a place
};
/// look(grain): by the grain that suits so many contacts.
template <class Widest, class Look>
FRETWORK_INLINE auto by_grain(const LaneCount& contacts, const Look& look) {
  if (contacts.few())
    return look(Grain<Widest, double>{});
  if (contacts.half())
    return look(Grain<Widest, Half>{});
  return look(Grain<Widest, Pack>{});
}
/// step(part) for all parts of a grain, known to the compiler: what stands in arrays by part stays in registers.
template <class G, class Step> FRETWORK_INLINE void for_parts(const Step& step) {
  [&]<int... part>(std::integer_sequence<int, part...>) __attribute__((always_inline)) {
    (step(std::integral_constant<int, part>{}), ...);
  }
  (std::make_integer_sequence<int, G::parts>{});
}

/// step(count), `count` known to the compiler where it is small: loops over it have no turns then.
template <class Step> FRETWORK_INLINE void for_count(int count, const Step& step) {
  switch (count) {
  case 1:
    return step(std::integral_constant<int, 1>{});
  case 2:
    return step(std::integral_constant<int, 2>{});
  case 3:
    return step(std::integral_constant<int, 3>{});
  case 4:
    return step(std::integral_constant<int, 4>{});
  default:
    return step(count);
  }
}

/// A product that is rounded before it is added to another one: GCC fuses one of two such products with the sum, not the same one for all
/// sizes of vectors.
template <class V> FRETWORK_INLINE V rounded(const V& product) {
#ifdef FRETWORK_KERNELS_BY_PROCESSOR
  return __builtin_assoc_barrier(product);
#else
  return product;
#endif
}

FRETWORK_INLINE double root(double x) { return __builtin_sqrt(x); }
template <class V> FRETWORK_INLINE V root(const V& x) {
  V r{};
  for (int l = 0; l < size_of<V>; ++l)
    r[l] = __builtin_sqrt(x[l]);
  return r;
}
template <class V> FRETWORK_INLINE V clipped(const V& p) { return p > 0.0 ? p : V{}; }
template <class V> FRETWORK_INLINE V magnitude(const V& p) { return p < 0.0 ? -p : p; }

} // namespace fretwork::kernels
