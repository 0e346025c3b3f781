// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Gauss-Legendre quadrature with 8 points, exact for polynomials up to degree 15 (Abramowitz and Stegun,
/// Handbook of Mathematical Functions, table 25.4).
#pragma once
#include <array>

namespace fretwork::fem {

struct GaussPoint {
  double share, weight; ///< of an interval's length
};

inline constexpr std::array<GaussPoint, 8> gauss_points = [] {
  constexpr std::array<double, 4> x{0.1834346424956498, 0.5255324099163290, 0.7966664774136267,
                                    0.9602898564975363};
  constexpr std::array<double, 4> w{0.3626837833783620, 0.3137066458778873, 0.2223810344533745,
                                    0.1012285362903763};
  std::array<GaussPoint, 8> points{};
  for (std::size_t i = 0; i < 4; ++i) {
    points[3 - i] = {0.5 * (1.0 - x[i]), 0.5 * w[i]};
    points[4 + i] = {0.5 * (1.0 + x[i]), 0.5 * w[i]};
  }
  return points;
}();

} // namespace fretwork::fem
