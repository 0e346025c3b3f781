// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Rows of a GatherTable one by one, for kernels. Included by them alone.
#pragma once
#include "transient/simd/vector_lanes.hpp"

namespace fretwork::transient::kernels {

/// Of `count` vectors.
template <int rows, std::size_t count> struct RowSums { double of[count][rows]; };
/// The rows of pack p times vectors of the modes.
template <class V, int rows, std::size_t count>
FRETWORK_INLINE RowSums<rows, count> row_sums(const GatherTable& g, int p,
                                              const double* const (&from)[count]) {
  const double* row = g.values.data() + static_cast<std::ptrdiff_t>(g.begin[p]) * g.padded_modes;
  Sums<V> sums[count][rows] = {};
  for_vectors<V>(
      g.padded_modes, [&](int pack, int part) __attribute__((always_inline)) {
        const int i = pack + part * size_of<V>;
        for (std::size_t n = 0; n < count; ++n)
          for (int r = 0; r < rows; ++r)
            sums[n][r][part] += at<V>(row + r * g.padded_modes + i) * at<V>(from[n] + i);
      });
  RowSums<rows, count> out;
  for (std::size_t n = 0; n < count; ++n)
    for (int r = 0; r < rows; ++r)
      out.of[n][r] = sum(sums[n][r]);
  return out;
}
/// As a vector, as it will be read: from numbers stored one by one processors load a vector late.
template <class V, int rows> FRETWORK_INLINE void store_rows(const double (&values)[rows], double* to) {
  V all{};
  all[0] = values[0];
  if constexpr (rows > 1)
    all[1] = values[1];
  at<V>(to) = all;
}

} // namespace fretwork::transient::kernels
