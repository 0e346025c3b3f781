// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Vector lanes for kernels: packs of `lanes` doubles, and one copy of a function for each width of vector unit, chosen when the
/// program starts. Included by files of kernels only, not by headers.
#pragma once
#include "transient/kernels.hpp"

// Not under the sanitizers (they start after the choice is made), nor with compilers that lack it.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(FRETWORK_SANITIZED)
#define FRETWORK_WIDTHS __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#else
#define FRETWORK_WIDTHS
#endif
#define FRETWORK_INLINE static inline __attribute__((always_inline))

namespace fretwork::transient::kernels {

typedef double Pack __attribute__((vector_size(64)));
typedef double Half __attribute__((
    vector_size(32))); ///< the first lanes of a pack: enough for few contacts, and half the work
typedef long long Mask __attribute__((vector_size(64)));

/// V is a Pack, a Half or a double where a kernel is written for all.
template <class V = Pack> FRETWORK_INLINE const V& at(const double* p) {
  return *reinterpret_cast<const V*>(p);
}
template <class V = Pack> FRETWORK_INLINE V& at(double* p) { return *reinterpret_cast<V*>(p); }
template <class V> inline constexpr int size_of = static_cast<int>(sizeof(V) / sizeof(double));
FRETWORK_INLINE double sum(const Pack& p) {
  return ((p[0] + p[4]) + (p[2] + p[6])) + ((p[1] + p[5]) + (p[3] + p[7]));
}
FRETWORK_INLINE double largest(const Pack& p) {
  const auto max = [](double a, double b) { return a > b ? a : b; };
  return max(max(max(p[0], p[4]), max(p[2], p[6])), max(max(p[1], p[5]), max(p[3], p[7])));
}
FRETWORK_INLINE double sum(const Half& p) {
  return (p[0] + p[2]) + (p[1] + p[3]);
} // as of a pack whose other half is 0
FRETWORK_INLINE double largest(const Half& p) {
  const auto max = [](double a, double b) { return a > b ? a : b; };
  return max(max(p[0], p[2]), max(p[1], p[3]));
}
FRETWORK_INLINE double sum(double p) { return p; }
FRETWORK_INLINE double largest(double p) { return p; }
FRETWORK_INLINE double root(double x) { return __builtin_sqrt(x); }
template <class V> FRETWORK_INLINE V root(const V& x) {
  V r{};
  for (int l = 0; l < size_of<V>; ++l)
    r[l] = __builtin_sqrt(x[l]);
  return r;
}
template <class V> FRETWORK_INLINE V magnitude(const V& p) { return p < 0.0 ? -p : p; }

} // namespace fretwork::transient::kernels
