// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// What a run says on its fluidelastic laws: roots of the modes without contacts, amplitudes beyond a linear law.
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

/// After a run: a warning for each flow with a law beyond whose range of amplitudes contacts or observed nodes of its tube moved. The laws are
/// linear in the displacement: good to some 0.1 of the diameter.
/// @param placed, nodes  those of `out`
void judge_amplitudes(const TubesInFlow& tubes, const std::vector<PlacedContact>& placed,
                      const std::vector<NamedNode>& nodes, results::RunResults& out);

} // namespace fretwork::app
