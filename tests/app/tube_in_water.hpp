// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// A pinned tube in uniform flow of water, whose damping and stability by Connors' formula have closed forms.
#pragma once
#include "mesh_text.hpp"
#include "program.hpp"
#include <numbers>

namespace fretwork::app::test::tube_in_water {

inline constexpr double pi = std::numbers::pi, outer = 0.01905, density = 740.0, pitch_ratio = 1.44,
                        velocity = 1.5; ///< m, kg/m3, -, m/s
/// (pi/40)^4/1440 of the first frequency, and the digits of a residual of 1e-8
inline constexpr double of_mesh = 1e-7;
/// A rod of 1000 times the stiffness of the beams: pinned_model.hpp
inline constexpr double of_pins = 1e-6;
extern const double bending; ///< N m2
extern const double mass;    ///< kg/m, with water inside and added mass

/// Components that are restrained all along the tube.
extern const std::string in_one_plane, in_two_planes;

/// A pinned tube of 1 m along x, 40 elements. @param held  components restrained all along it   @param more  what follows
[[nodiscard]] std::string tube(const std::string& held, const std::string& more);
/// Its [[flow]], T1. @param more  keys before the zones   @param zone  of the zone
[[nodiscard]] std::string flow(const std::string& more = {}, const std::string& zone = "velocity = 1.5\n");
/// [[contacts]] at a group. @param keys  further ones
[[nodiscard]] std::string contact(const std::string& group, const std::string& keys);
[[nodiscard]] std::string modes(int count, const std::string& more = {});
/// With the points `middle` and, at 0.35 m, `third`.
[[nodiscard]] MeshText mesh();

/// Runs the program on the tube; the results are in `out`. @param more  arguments   @param ranks  0: without mpirun
Outcome outcome_of(const Workshop& folder, const std::string& study, const std::string& command = "stability",
                   const std::vector<std::string>& more = {}, int ranks = 0);
[[nodiscard]] nlohmann::json summary_of(const Workshop& folder, const std::string& study,
                                        const std::string& command = "stability",
                                        const std::vector<std::string>& more = {});
/// Hz, of the modes of an assessment.
[[nodiscard]] std::vector<double> frequencies(const nlohmann::json& assessment);
/// Viscous damping of a mode, ratio to critical.
[[nodiscard]] double viscous_ratio(double hertz);

} // namespace fretwork::app::test::tube_in_water
