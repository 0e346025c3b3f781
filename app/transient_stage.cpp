// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/transient_stage.hpp"
#include "app/gap_opening.hpp"
#include "app/jobs.hpp"
#include "app/judge_contacts.hpp"
#include "app/judge_wear.hpp"
#include "app/watched_wear.hpp"
#include <fmt/format.h>

namespace fretwork::app {
namespace {

/// The runs of the scenes and their wear.
/// @param stage  of gap opening, from 1 on
void run_scenes(const AroundTransient& around, const study::Study& study, std::vector<BuiltScene>& scenes,
                std::int64_t stage, results::RunResults& out) {
  WatchedWear watched = watched_wear(study, around.worn, around.placed.size());
  watched.by_place = stage > 1;
  for (BuiltScene& scene : scenes)
    scene.watched_wear = watched.at(scene.contacts);
  const ProgressCallback progress =
      around.progress.shown()
          ? ProgressCallback([&](double share, double time) { around.progress.update(share, time); })
          : ProgressCallback();
  const std::size_t runs = 2 * scenes.size(); // of a stage at most: one may be verified
  run_jobs(around.comm, study, scenes,
           {progress, around.checkpoints, runs * static_cast<std::size_t>(stage - 1),
            study.gap_opening.has_value()},
           out);
  core::agree(around.comm, [&] { add_wear(study, around.worn, around.placed, around.other_runs, out); });
  if (stage > 1)
    return; // work rates that stay for years are those of the first stage; open_gaps warns of the others
  judge_contacts(study, around.placed, scenes, out);
  judge_reach(out);
  judge_wear(study, around.worn, around.placed, out);
}

/// A later stage of gap opening.
results::RunResults run_opened(const AroundTransient& around, const study::Study& study,
                               const std::vector<modal::Basis>& bases,
                               const std::vector<PlacedContact>& opened, std::int64_t stage) {
  around.progress.stage(fmt::format("gap opening, stage {}", stage));
  results::RunResults built, out; // what building says was said in the first stage
  std::vector<BuiltScene> scenes;
  core::agree(around.comm,
              [&] { scenes = build_scenes(study, bases, opened, {}, around.at_contacts, built); });
  out.bases = bases;
  out.contacts = std::move(built.contacts);
  run_scenes(around, study, scenes, stage, out);
  return out;
}

} // namespace

void run_transient(const AroundTransient& around, std::vector<BuiltScene>& scenes, results::RunResults& out) {
  around.progress.stage("transient");
  run_scenes(around, around.study, scenes, 1, out);
  const study::Study later = without_series(around.study);
  open_gaps(
      around.study, around.worn, around.placed,
      [&](const std::vector<PlacedContact>& opened, std::int64_t stage) {
        return run_opened(around, later, out.bases, opened, stage);
      },
      out);
}

} // namespace fretwork::app
