// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Accelerograms in the format of the PEER ground motion database (.AT2): four lines of header, of which the third names the unit ("IN UNITS OF
/// G") and the fourth gives the number of points and the time between two (`NPTS= 4000, DT= .0050 SEC`, or `4000 .0050 NPTS, DT`); then
/// the values, several a line, the first at t = 0.
#pragma once
#include "signals/time_function.hpp"
#include <filesystem>

namespace fretwork::study {

/// By the ending of the name, .at2 in any case.
[[nodiscard]] bool is_accelerogram(const std::filesystem::path& file);

/// m/s2: values in units of g are multiplied by 9.80665.
/// @throws core::Error naming the file, for one that cannot be read, without this header, or with another number of values
[[nodiscard]] signals::Table read_accelerogram(const std::filesystem::path& file);

} // namespace fretwork::study
