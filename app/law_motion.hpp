// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// What a run found of the motion under its fluidelastic laws, and whether its statistics are those of a steady state.
#pragma once
#include "app/build_scene.hpp"
#include "app/flow_damping.hpp"
#include "results/run_results.hpp"

namespace fretwork::app {

/// After a run: LawAtWork::motion of each law of `out` that is unstable without contacts.
///
/// The later part of a run is its second half, as far as the statistics see it. Energies are those of the law's modes at the outputs,
/// sum (v^2 + omega^2 (a - mean of a later)^2)/2, whatever contacts store. Growth: post/growth.hpp.
/// The dominant frequency is that of the largest line of Welch's spectrum of the outputs in four stretches, between lines by its larger
/// neighbour. There is none where the mean frequency, the rms of the speed over 2 pi times that of the displacement, is above
/// three quarters of half the output rate: lines are then folded.
///
/// Warnings: of every law beyond whose range of amplitudes contacts or observed nodes of its tubes moved, laws being linear in the
/// displacement, good to some 0.1 of the diameter; of a motion that still grows, with 99 % probability and by more than 2 % in the rms; of
/// statistics that begin before a motion has built up.
/// @param placed, nodes  those of `out`
void judge_motion(const TubesInFlow& tubes, const std::vector<PlacedContact>& placed,
                  const std::vector<NamedNode>& nodes, results::RunResults& out);

} // namespace fretwork::app
