// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Slopes of a shape-preserving curve through the rows of a table: cubic Hermite pieces, continuous in value and slope, whose second
/// derivative is linear inside an interval and may jump at a row.
///
/// The curve is the cubic spline with slope 0 at both ends (C. de Boor, A Practical Guide to Splines, 1978, chapter IV) wherever that keeps
/// within the range of the two rows of its interval. Where it leaves the range, both rows are limited (J. Hyman, SIAM J. Sci. Stat. Comput. 4
/// (1983) 645): with c and d the slopes of the chords beside a row,
///     c d <= 0: slope 0,      c d > 0: slope between 0 and 3 min(|c|, |d|), of their sign,
/// for which a cubic is monotone between two rows (F. Fritsch and R. Carlson, SIAM J. Numer. Anal. 17 (1980) 238). This is repeated until no
/// interval is left that leaves its range, since a limited row may spoil its other interval. So a hold is a hold and nothing swings out.
///
/// Smooth maxima and minima between rows are kept, which clipping would reduce to order 2: an interval may leave its range where the second
/// differences at its rows and the next row on either side have one sign, the largest at most twice the smallest, and the excess is at most
/// twice that of a parabola, h^2/8 times the largest. A sine with at least 12 rows a period meets this. Beyond the ends the table counts
/// as reflected, as its slope there is 0.
///
/// Order of the displacement: 4 through rows of a smooth curve that rests at both ends, 2 where rows are limited.
#pragma once
#include "signals/time_function.hpp"
#include <vector>

namespace fretwork::signals {

/// @param table  at least two rows, times that increase
/// @return the slope of the curve at each row, per second
[[nodiscard]] std::vector<double> shape_preserving_slopes(const Table& table);

} // namespace fretwork::signals
