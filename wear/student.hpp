// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Student's distribution, for intervals of means whose scatter was estimated from few samples.
#pragma once

namespace fretwork::wear {

/// Half-width of the two-sided interval of a mean, in standard errors: t with P(|T| <= t) = confidence.
/// Source: Student, The probable error of a mean, Biometrika 6 (1908) 1-25; computed by Boost.Math.
/// @param degrees  of freedom, > 0, need not be whole   @param confidence  0 < confidence < 1
[[nodiscard]] double student_factor(double degrees, double confidence);

} // namespace fretwork::wear
