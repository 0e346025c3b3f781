// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// A work rate with the interval in which it is known.
///
/// Interval: value +- standard error of a run (post::StandardErrors), that of a given confidence, or bounds. A lower end below 0 becomes 0,
/// which is returned as `low_at_zero`.
/// Of a confidence, with w the value, s its standard error, n - 1 the degrees of freedom of s:
///     w exp(-+ t s/w),   1/d = 1/(n - 1) + (s/w)^2/2,   d >= 2 (n - 1 if less),   t of Student's distribution with d degrees of freedom
/// Runs with few or weak impacts have a low w and a low s: w + t s is too low far more often than w - t s too high. In ln w, whose error is s/w,
/// both ends fail about equally often (W. Q. Meeker and L. A. Escobar, Statistical Methods for Reliability Data, Wiley 1998, section 7.3).
/// N independent equal events have s/w = N^-1/2, and their variance is known to a relative variance of 1/N, which adds to the 2/(n - 1) of
/// batches (F. E. Satterthwaite, Biometrics Bulletin 2 (1946) 110: the sum is 2/d).
/// Points of one support (nodes along it) wear one scar: values, lower and upper ends are summed.
/// Ends are summed linearly since contacts of one tube are not independent: an upper bound of the interval.
#pragma once
#include <span>

namespace fretwork::wear {

struct WorkRate {
  double value;             ///< W, >= 0
  double low, high;         ///< W, low <= value <= high
  bool low_at_zero = false; ///< the lower end of value +- standard error was below 0
  bool has_interval = true; ///< false: only the value is known, low = high = value
};

/// Without an interval. @throws core::Error for a value that is not finite and >= 0
[[nodiscard]] WorkRate work_rate(double value);
/// @param standard_error  W, >= 0, or not a number: there is none   @throws core::Error
[[nodiscard]] WorkRate work_rate_with_error(double value, double standard_error);
/// The interval that covers the mean with this confidence, by the formula above; of a value 0 from 0 to the standard error.
/// @param batches  effective number behind the error, > 1   @param confidence  0 < confidence < 1   @throws core::Error
[[nodiscard]] WorkRate work_rate_with_confidence(double value, double standard_error, double batches,
                                                 double confidence);
/// @throws core::Error unless 0 <= low <= value <= high, finite
[[nodiscard]] WorkRate work_rate_between(double low, double value, double high);

/// Of one support. @throws core::Error for no point
[[nodiscard]] WorkRate sum_of_points(std::span<const WorkRate> points);

} // namespace fretwork::wear
