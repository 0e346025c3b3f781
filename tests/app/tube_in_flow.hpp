// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// A pinned tube under a fluidelastic law, whose roots and limit cycles are known.
#pragma once
#include "mesh_text.hpp"
#include "program.hpp"

namespace fretwork::app::test::tube_in_flow {

inline constexpr double outer = 0.01905, bore = outer - 2.0 * 0.00109, metal = 8320.0; ///< m, kg/m3
/// 40 elements: (pi/40)^4/1440 of the first frequency, more of the others.
inline constexpr double of_mesh = 2e-7;

/// The law S1 of doc/fluidelastic.md: lift alone, one lag.
extern const std::string s1;

/// A group of lines along x as a pinned tube that moves along z alone.
[[nodiscard]] std::string pinned(const std::string& group);
/// A pinned tube of 1 m along x that moves along z alone, which is lift, in twelve modes of 1 %.  @param more  what follows
[[nodiscard]] std::string tube(const std::string& more);
/// The tube's [[flow]], T1.
[[nodiscard]] std::string flow(const std::string& law, const std::string& zones);
/// @param inside  kg/m3
[[nodiscard]] std::string zone(double from, double to, double velocity, double density, double inside);
/// Density inside that makes up for 300 kg/m3 outside instead of 1000: 1.0993164814 kg/m in all.
[[nodiscard]] double inside_of_light();

/// Runs the program on tubes of a mesh; the results are in `out`.
Outcome outcome_on(const MeshText& mesh, const Workshop& folder, const std::string& study,
                   const std::string& command);
/// Runs the program on the tube, whose middle is the group `middle`; the results are in `out`.
Outcome outcome_of(const Workshop& folder, const std::string& study,
                   const std::string& command = "stability");
[[nodiscard]] nlohmann::json summary_of(const Workshop& folder, const std::string& study,
                                        const std::string& command = "stability");

} // namespace fretwork::app::test::tube_in_flow
