// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Random spectral lines and their projection on modes: where the time of a random draw goes. Lines come in groups of 64, real parts
/// before imaginary parts. Each kernel is compiled for several widths of vector unit; AVX2 and AVX-512 give the same bytes.
///
/// Line n of a sequence, e = r exp(i theta): x, y are words 0 and 1 (lines 0 to 31 of a group) or 2 and 3 (32 to 63) of
///     philox(counter = (32 (n / 64) + n % 32, block, point, stream), key = (seed, draw))
///     theta = 2 pi y/2^32
///     normal:      r = sqrt(-2 ln((x + 1/2)/2^32)): real and imaginary part N(0, 1), independent (Box and Muller); |e| <= 6.8
///     phase_only:  r = sqrt 2
/// Logarithm, sine and cosine are their series, to 1e-13.
#pragma once
#include <cstddef>
#include <cstdint>

namespace fretwork::flow {

inline constexpr int group_lines = 64;
inline constexpr int group_size = 2 * group_lines; ///< numbers of a group

/// What the lines of a sequence depend on, but for n.
struct LineSequence {
  std::uint32_t seed, draw;
  std::uint32_t stream; ///< of zone and axis
  std::uint32_t point;  ///< patch
  std::uint32_t block;
  bool phase_only;
};

/// Lines e of 64 group to 64 group + 63.  @param e  group_size numbers, aligned to 64 bytes
void draw_lines(const LineSequence& sequence, std::uint32_t group, double* e);

/// One step of a Markov sequence over points: z <- r z + sqrt(1 - r^2) e, y = amplitude z.
/// @param r  correlation with the point before, 0 <= r < 1   @param amplitude  of group_lines lines
/// @param z, y  group_size numbers   (all aligned to 64 bytes)
void advance_lines(const LineSequence& sequence, std::uint32_t group, double r, const double* amplitude,
                   double* z, double* y);

inline constexpr int mode_block = 4; ///< modes that are projected together

/// sums(i, :) += sum over points k of shapes(i, k) lines(k, :)
/// @param blocks  of mode_block modes   @param shapes  block after block, points x mode_block each
/// @param lines  points x group_size, aligned to 64 bytes   @param sums  of a mode group_size numbers, `stride` apart; aligned
void project_lines(int blocks, int points, const double* shapes, const double* lines, double* sums,
                   std::ptrdiff_t stride);

} // namespace fretwork::flow
