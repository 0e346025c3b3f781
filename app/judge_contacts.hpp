// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Warnings of contacts whose laws are not what their study means, by the statistics of the run.
#pragma once
#include "app/build_contacts.hpp"
#include "app/build_scene.hpp"
#include "results/run_results.hpp"
#include "study/study.hpp"

namespace fretwork::app {

/// By how much the restitution at the rms impact velocity may differ from that asked for.
constexpr double restitution_tolerance = 0.05;

/// Hunt and Crossley's law has `restitution` e at `restitution_velocity` only: a warning for each entry of [[contacts]] where the restitution at the
/// rms velocity of its impacts (of all its points) differs from e by more than `restitution_tolerance`. Entries whose impacts bring less than a
/// hundredth of the kinetic energy (sum of squared velocities) of the busiest entry are left out.
/// @param placed  as out.contact_summaries
void judge_restitution(const study::Study& study, const std::vector<PlacedContact>& placed,
                       results::RunResults& out);

/// Of the energy dissipated: what the automatic tangential dampers of contacts that stick may take.
constexpr double taken_by_stuck = 0.1;

/// R5.06.03's tangential damping is critical for the mass of a mode, made to stop contacts that touch. In one that stays closed and sticks it holds the
/// structure instead of the spring: a warning where such contacts (closed and sticking for more than half of the time) take more than
/// `taken_by_stuck` of the energy dissipated by their dampers.
/// @param placed  as out.contact_summaries   @param scenes  those of out.transients
void judge_stuck_dampers(const study::Study& study, const std::vector<PlacedContact>& placed,
                         const std::vector<BuiltScene>& scenes, results::RunResults& out);

/// Impacts of contacts with friction of which none slides, under loads that follow one random signal: a motion along one line. A warning with
/// the first two of the loads, which `note_loads` (scenes.cpp) notes of every run.
/// @param placed  as out.contact_summaries
void judge_sliding(const study::Study& study, const std::vector<PlacedContact>& placed,
                   results::RunResults& out);

/// All of these, in this order, of a run or the case of a sweep.
void judge_contacts(const study::Study& study, const std::vector<PlacedContact>& placed,
                    const std::vector<BuiltScene>& scenes, results::RunResults& out);

/// A note where no contact closes.
void judge_reach(results::RunResults& out);

} // namespace fretwork::app
