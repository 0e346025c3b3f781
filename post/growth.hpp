// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Whether a motion grows, from its energies E at equal steps. They are cut into two times 16 blocks of means E_0 .. E_31:
///     d_k = ln(E_(16+k)/E_k)/2,   k = 0 .. 15
/// is the growth of the amplitude over half of the time. Its mean over that time is the rate, with the standard error of the mean of d
/// (batch_means.hpp). An exponential growth has no scatter; that of a stationary motion is its own.
#pragma once
#include <optional>
#include <span>

namespace fretwork::post {

struct Growth {
  double rate = 0.0, error = 0.0; ///< 1/s, of the amplitude, and its standard error
  double rms_ratio = 1.0;         ///< of the second half of the time to the first, at this rate
  bool significant = false;       ///< with 99 % probability, and by more than 2 % in the rms
};

/// @param energies  any unit   @param step  s
/// @return nothing of fewer than 128 energies, of a rest, and of what is not finite
[[nodiscard]] std::optional<Growth> amplitude_growth(std::span<const double> energies, double step);

} // namespace fretwork::post
