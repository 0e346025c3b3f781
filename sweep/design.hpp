// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The cases of a sweep: what each gives to each variable.
#pragma once
#include "study/sweep.hpp"
#include <Eigen/Core>

namespace fretwork::sweep {

/// Cases by rows, variables that are drawn by columns: numbers, of listed values their places in the list.
using Draws = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Numbers of the variables that are drawn: all but seeds.
[[nodiscard]] std::vector<std::size_t> drawn_variables(const study::Sweep& sweep);

/// All combinations of the listed values, the last variable's first.
[[nodiscard]] Draws full_grid(const study::Sweep& sweep);

/// The design, by OpenTURNS unless it is a grid. A sweep that goes on has blocks of `draws` cases, each drawn by itself: the first blocks
/// do not depend on how many follow.
/// @throws core::Error without OpenTURNS, or for correlations that no variables can have
[[nodiscard]] Draws make_design(const study::Sweep& sweep, std::int64_t blocks);

/// The value of a variable in a case as TOML text.
[[nodiscard]] std::string value_text(const study::SweepVariable& variable, double drawn, std::int64_t number);

/// Texts of the listed values that are not all numbers, by the number that stands for them (`value_number`): of booleans "false" and "true",
/// else the list. Empty: the values are numbers.
[[nodiscard]] std::vector<std::string> value_names(const study::SweepVariable& variable);

/// The value of a variable in a case as a number, of tables and statistics: the number itself; false 0 and true 1; of other listed texts
/// the place in the list.
[[nodiscard]] double value_number(const study::SweepVariable& variable, double drawn, std::int64_t number);

/// The overrides (`key=value`) of a case.
[[nodiscard]] std::vector<std::string> overrides_of(const study::Sweep& sweep, const Draws& draws,
                                                    std::int64_t number);

} // namespace fretwork::sweep
