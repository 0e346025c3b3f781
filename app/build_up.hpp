// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Statistics that begin at t = 0 contain the build-up of the motion from rest.
#pragma once
#include "app/build_scene.hpp"
#include "study/study.hpp"
#include <string>
#include <vector>

namespace fretwork::app {

/// What the build-up of the linear response is of the statistics, without contacts.
struct BuildUp {
  double share = 0.0;      ///< of the mean square of the modal displacements of the steady state
  double frequency = 0.0;  ///< Hz, of the mode that has most of it
  double decay_time = 0.0; ///< s, 1/(zeta omega) of that mode
};

/// From rest the mean square of a mode under a random force is 1 - exp(-2 t/T) of that of the steady state, T = 1/(zeta omega); a harmonic force
/// sets off a free vibration that decays so. Over a window of D from t = 0 that is
///
///     share = T/(2 D) (1 - exp(-2 D/T))
///
/// of each mode, weighted with the mean squares of modes (harmonic: exact; random: white noise at the mode where that is in the band, outside no
/// build-up). Share 0 of a scene with undamped modes that are excited, dashpots or forces of motion, whose modes these are not.
[[nodiscard]] BuildUp build_up(const vibration::ForcedSystem& forced);

/// A note where the statistics begin at t = 0 and more than `least_build_up` of a scene's mean square is build-up; else empty. None with [[initial]].
inline constexpr double least_build_up = 0.05;
[[nodiscard]] std::string build_up_note(const study::Study& study, const std::vector<BuiltScene>& scenes);

} // namespace fretwork::app
