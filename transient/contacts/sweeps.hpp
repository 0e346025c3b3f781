// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// When sweeps over contacts have converged.
#pragma once

namespace fretwork::transient {

/// The largest change of a sweep is small, or what is still to come (largest change r/(1 - r), r the ratio of the changes of two sweeps) is, times
/// `caution`; r is believed only where changes fall clearly.
[[nodiscard]] inline bool converged(double largest, double last, double tolerance, double caution) {
  const bool falls = largest <= 0.5 * last;
  return largest <= tolerance || (falls && largest * largest <= caution * tolerance * (last - largest));
}

} // namespace fretwork::transient
