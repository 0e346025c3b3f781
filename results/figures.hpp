// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Figures as text for the terminal.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace fretwork::results {

/// Below this, in SI units, a figure of the tables is the round-off of a sum and is shown as 0: no force, power or displacement of
/// a structure is so small.
inline constexpr double shown_as_zero = 1e-15;

/// A figure of `digits` digits, those before the point in full from 1000 to 10^6; 0 where it is round-off.
[[nodiscard]] std::string figure(double value, int digits);

/// The value, 0 where it is round-off beside what it was computed with: a force beside the others of its contact, an energy beside the input.
[[nodiscard]] double without_round_off(double value, double beside);

/// 12 345 678
[[nodiscard]] std::string grouped(std::int64_t count);

/// A figure for a sentence, 0 or from 1e-4 on, of `digits` digits: 0.0123, 4.7, 62 000.
[[nodiscard]] std::string without_exponent(double value, int digits);

/// `1 node`, `1 234 nodes`: the plural by "s".
[[nodiscard]] std::string counted(std::int64_t count, const std::string& what);

/// 6.13+-0.05: the error in one digit (two where the first is 1), the value down to it; the value alone where there is no error, or one of
/// round-off.
[[nodiscard]] std::string with_error(double value, double error);

/// Lines of at most `width` characters, broken at spaces, but not between the groups of digits of one number. A longer word is a line.
[[nodiscard]] std::vector<std::string> wrapped(const std::string& text, std::size_t width);

} // namespace fretwork::results
