// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// What a sweep is to compute, before any case: its study, its variables, its folders, and what names a case whatever computes it.
#pragma once
#include "app/sweep.hpp"
#include "study/sweep.hpp"
#include "sweep/design.hpp"
#include <map>

namespace fretwork::app {

struct SweepPlan {
  study::Document document; ///< as it stands, [sweep] included
  study::Sweep sweep;
  Inputs inputs;                            ///< of the nominal case; its directory is that of the shard
  std::filesystem::path directory;          ///< of the sweep
  sweep::Shard shard;                       ///< 1/1: all cases
  std::map<std::string, std::string> files; ///< digests of files that listed values name
};

/// @throws core::Error for what is wrong with the study, its [sweep] or what is asked of it
[[nodiscard]] SweepPlan read_sweep_plan(const SweepRequest& request);

/// The same for the same study, files and drawn values, whatever the number of cases.
[[nodiscard]] std::string identity_of(const SweepPlan& plan, const sweep::Draws& draws, std::int64_t number);

/// The warning of operating states of wear with work rates of other runs, or of the study, where contacts vary; empty: none.
[[nodiscard]] std::string states_that_do_not_vary(const SweepPlan& plan);

} // namespace fretwork::app
