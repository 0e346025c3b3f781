// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// What a run says on its fluidelastic laws: roots of the modes without contacts.
#pragma once
#include "app/build_scene.hpp"
#include "app/flow_damping.hpp"
#include "results/run_results.hpp"

namespace fretwork::app {

/// Of the modes without contacts: a note, or where the tubes are unstable a warning, for each law: the root of largest growth at
/// the working point with its reduced velocity, and the factor of all velocities at which they become unstable first.
/// @param placed  contacts of the run
void judge_fluidelastic(const TubesInFlow& tubes, const std::vector<modal::Basis>& bases,
                        const std::vector<PlacedContact>& placed, results::RunResults& out);

} // namespace fretwork::app
