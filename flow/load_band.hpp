// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The band of frequencies of turbulent forces and the period of the blocks of their draws (draws.hpp), from the forces alone: what modes
/// make of them has no part in it, so that forces are the same for any basis.
///
///     P(f) = sum over zones, axes and patches of w G(s_k, f) ds_k,   mean square of the force per length, summed along the tube
///
/// Band. Its lower end is 0, its upper one the frequency above which a thousandth of int P df lies: for the slope -3.5 of reference
/// spectra some 10 times the corner, where G is 3e-4 of its value there, and a mode follows with the square of that less.
///
/// Block. T_b is the power of 2 s with which a block has 1024 to 2047 lines up to the upper end. A block then has as many samples
/// whatever the velocity: cost and memory do not grow with the time scale of the flow. Lines resolve a thousandth of the band, the corner of reference
/// spectra lies at line 100: fading errs by 4.5/(f T_b)^2, 0.05 % there (draws.hpp). Forces below 2/T_b are too small.
#pragma once
#include "flow/draws.hpp"

namespace fretwork::flow {

struct LoadBand {
  double low = 0.0, high = 0.0; ///< Hz
  double below = 0.0;           ///< share of the mean square of the forces below `low`
  double above = 0.0;           ///< share above `high`
  double block_period = 0.0;    ///< T_b, s
};

inline constexpr double lost_above_band = 1e-3; ///< share of the mean square of the forces

/// The band that the spectra give.
/// @throws core::Error for zones that check refuses, and where no force acts between 1e-3 and 1e5 Hz
[[nodiscard]] LoadBand load_band(const std::vector<TurbulentZone>& zones);
/// A band that is given, and what it loses.  @param low, high  Hz, 0 <= low < high
[[nodiscard]] LoadBand load_band(const std::vector<TurbulentZone>& zones, double low, double high);

/// Mean square of each modal force in the band, N^2 times the square of the shapes' unit: int G_ii df.
[[nodiscard]] Eigen::VectorXd modal_mean_squares(const std::vector<TurbulentZone>& zones,
                                                 const LoadBand& band);

/// What a draw with this band holds in memory, bytes: two blocks of samples of each mode and the amplitudes of lines.
[[nodiscard]] double draw_bytes(const std::vector<TurbulentZone>& zones, const LoadBand& band);

} // namespace fretwork::flow
