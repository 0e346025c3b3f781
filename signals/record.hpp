// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Records: tables whose points follow each other at nearly equal intervals, as what was measured or computed by another program. How fast they
/// change, and the polygon with corners a step apart that stands for one whose points are closer.
#pragma once
#include "signals/time_function.hpp"

namespace fretwork::signals {

/// 64 points at least, none closer than half their mean interval: no jumps.
[[nodiscard]] bool is_record(const Table& table);
/// s, of a table of two points at least.
[[nodiscard]] double mean_interval(const Table& table);

/// How fast a record changes within the band of the modes: the rms of its second differences over that of the first, of means over windows of
/// 1/highest (at least half its mean interval), in rad/s; at most `highest`. 0 of one that never changes.
/// @param highest  rad/s, > 0, of the modes   @param duration  s, of the run: rows before 0 and after it do not count
[[nodiscard]] double rate_of_record(const Table& record, double highest, double duration);

/// The least-squares projection of a table on polygons with corners at 0, step, 2 step ... (order 4, as splines of degree 1). It has the
/// mean of the table, and of what moves with w the share 1 - (w step)^4/720; what is too fast for it does not come back as something slow.
/// @param corners  2 at least
[[nodiscard]] std::vector<double> nearest_polygon(const Table& table, double step, std::size_t corners);

} // namespace fretwork::signals
