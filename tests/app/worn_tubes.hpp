// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Tubes that rattle and slide a little in holes, and what tests ask of their wear.
#pragma once
#include "program.hpp"

namespace fretwork::app::test::worn_tubes {

inline constexpr double year = 31536000.0;                                   ///< s
inline constexpr double radius = 9.525e-3, clearance = 1e-5, wall = 1.09e-3; ///< m
inline constexpr double coefficient = 2e-14;                                 ///< m2/N
/// Keys of [[wear]]: Archard's law with `coefficient` over 20 mm.
extern const std::string archard;
/// [transient] and [output] of 0.3 s.
extern const std::string short_run;

/// A study of `bundle` (study_text.hpp) with loads across, and [[wear]]. @param wear  its keys
[[nodiscard]] std::string worn_bundle(const Workshop& folder, int tubes, const std::string& wear,
                                      const std::string& run = short_run);
/// One tube whose support wears at a given rate. @param keys  of [[wear]]   @param rate  W, as in TOML
[[nodiscard]] Results with_given_rate(const Workshop& folder, const std::string& keys,
                                      const std::string& rate);

/// Of summary.json.
[[nodiscard]] const nlohmann::json& support(const Results& run, std::size_t i = 0);
[[nodiscard]] double sum(const nlohmann::json& numbers);

} // namespace fretwork::app::test::worn_tubes
