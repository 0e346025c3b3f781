// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Studies of tubes side by side, and what tests ask of them.
#pragma once
#include "program.hpp"

namespace fretwork::app::test {

/// Tubes of 1 m and a little more, side by side every 25 mm along y, clamped at both ends; their middles are mid0, mid1 ... The sections
/// are "tube" and "rod".
[[nodiscard]] std::string tubes(const Workshop& folder, int count, const std::string& section = "tube");
/// A constant force on the middle of a tube, N.
[[nodiscard]] std::string push(int tube, double force);
/// Tubes a and b meet after 1 mm.
[[nodiscard]] std::string meeting(int a, int b);
[[nodiscard]] const results::ContactFacts& facts(const Results& run, const std::string& name);
/// The message of a study that is refused.
[[nodiscard]] std::string refused(const Workshop& folder, const std::string& study);

} // namespace fretwork::app::test
