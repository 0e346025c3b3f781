// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/case_run.hpp"
#include "app/case_row.hpp"
#include "app/checkpoints.hpp"
#include "app/contact_notes.hpp"
#include "app/expected_time.hpp"
#include "app/force_sites.hpp"
#include "app/job.hpp"
#include "app/jobs.hpp"
#include "app/judge_contacts.hpp"
#include "app/judge_run.hpp"
#include "app/judge_wear.hpp"
#include "app/modal_truncation.hpp"
#include "app/scene_statistics.hpp"
#include "app/shared_signals.hpp"
#include "app/wear_of_run.hpp"
#include "core/error.hpp"
#include "results/grouped_messages.hpp"
#include <algorithm>
#include <fmt/format.h>

namespace fretwork::app {
namespace {

/// What is followed besides contacts.
void observe(const std::vector<NamedNode>& nodes, const std::vector<results::ForceSite>& sites,
             results::RunResults& out) {
  for (const NamedNode& node : nodes)
    out.node_names.push_back(node.name);
  out.force_sites = sites;
}

/// Names of what is assessed, in the order of connors_stability.
std::vector<results::StabilityAssessment> assessments_named(const study::Study& study,
                                                            const std::vector<PlacedFlow>& flows) {
  std::vector<results::StabilityAssessment> out;
  for (const study::Stability& one : study.stabilities)
    for (const PlacedFlow& placed : flows) {
      out.emplace_back();
      out.back().name = one.name;
      out.back().damping.tube = study.flows[placed.entry].name;
    }
  return out;
}

/// What numbers of tubes are found by.
std::vector<modal::Basis> nodes_of(const std::vector<modal::Basis>& bases) {
  std::vector<modal::Basis> out(bases.size());
  for (std::size_t s = 0; s < bases.size(); ++s)
    out[s].nodes = bases[s].nodes;
  return out;
}

/// What warnings call the contacts.
std::vector<results::ContactFacts> names_of(const std::vector<PlacedContact>& placed) {
  std::vector<results::ContactFacts> out(placed.size());
  for (std::size_t k = 0; k < placed.size(); ++k)
    out[k].name = placed[k].name;
  return out;
}

/// The run of one scene, its statistics at their places among those of the case.
void run_scene(const study::Study& study, const BuiltScene& built, const transient::StepChoice& choice,
               results::RunResults& out) {
  SceneStatistics statistics(study, built);
  const std::vector<transient::Observer*> observers = statistics.observers();
  transient::Run run(built.scene, choice, observers, nullptr,
                     transient::output_grid(study.transient->duration, output_interval(study)));
  const TimeLimit limit{study.transient->duration, study.transient->max_hours, [](const std::string&) {}};
  ExpectedTime expected(limit, 0.0);
  while (run.advance(Checkpoints::records_between_looks))
    expected.look(run.time());
  const transient::Report report = run.finish();
  judge_run(study, built, choice, report, out);
  out.transients.push_back({choice, report});
  merge_summaries(built, statistics.summaries(run), out);
}

} // namespace

/// A case before its first step.
struct CaseRunner::Case {
  study::Study study;
  std::vector<std::string> overrides;
  std::shared_ptr<const CaseStructure> structure;
  std::shared_ptr<const CaseContacts> contacts; ///< none before with_bases
  std::vector<PlacedContact> placed, inactive;
  std::vector<WornPlace> worn;
  std::vector<NamedNode> nodes;
  std::vector<results::ForceSite> force_sites;
  OtherRuns other_runs;
  std::vector<std::string> warnings; ///< of where the contacts are
};

std::vector<std::string> CaseRunner::warnings_of(const Case& c, const std::vector<BuiltScene>& scenes) {
  std::vector<std::string> out = c.warnings;
  for (const BuiltScene& built : scenes)
    out.insert(out.end(), built.warnings.begin(), built.warnings.end());
  for (std::string& warning : start_warnings(c.study, c.placed, scenes))
    out.push_back(std::move(warning));
  if (std::string missing = missing_flexibility_warning(c.study, scenes); !missing.empty())
    out.push_back(std::move(missing));
  return out;
}

std::vector<BuiltScene> CaseRunner::scenes_of(const Case& c) {
  Fields fields = c.structure->fields;
  fields.motion = c.contacts->fluid;
  for (std::size_t e = 0; e < c.study.loads.size(); ++e)
    fields.loads[e].function = c.study.loads[e].function;
  const WatchedWear watched = watched_wear(c.study, c.worn, c.placed.size());
  std::vector<std::string> notes; // cases have none
  const std::vector<LackingForce> lacking =
      lacking_forces(c.force_sites, {c.structure->model, c.structure->structures, c.contacts->bases}, fields,
                     c.placed, notes);
  std::vector<BuiltScene> scenes;
  for (std::size_t i = 0; i < c.contacts->joined.size(); ++i) {
    std::vector<signals::SampledLoad> turbulence;
    for (std::size_t e = 0; e < c.study.turbulence.size(); ++e)
      if (const auto& load = c.contacts->turbulence[i][e])
        turbulence.push_back(with_seed(*load, c.study.turbulence[e].seed));
    scenes.push_back(
        build_scene(c.study, c.contacts->bases, c.placed, c.nodes, fields,
                    {c.contacts->joined[i], c.contacts->flexibilities[i], std::move(turbulence)}));
    follow_forces(c.force_sites, lacking, c.structure->model, c.contacts->bases, fields, scenes.back());
    scenes.back().watched_wear = watched.at(scenes.back().contacts);
  }
  return scenes;
}

CaseRunner::CaseRunner(study::Document document, std::vector<std::string> base_overrides,
                       const Inputs& nominal)
    : document_(std::move(document)), base_overrides_(std::move(base_overrides)), bases_(nominal) {
  for (const std::string& text : base_overrides_)
    study::apply_override(document_.root, text);
  const Case nominal_case = read_case({});
  shared_signals_ = shared_signals(nominal_case.study).size();
  const std::vector<PlacedContact> all = together(nominal_case.placed, nominal_case.inactive);
  for (const PlacedContact& contact : all)
    contacts_.emplace_back(contact.name, contact.node);
  results::RunResults facts;
  observe(nominal_case.nodes, nominal_case.force_sites, facts);
  facts.stability = assessments_named(nominal_case.study, nominal_case.structure->flows);
  columns_ = case_columns(all, worn_places(nominal_case.study, nominal_case.structure->model, all), facts);
  // refuses runs of another tube; its warnings are those of the run before its first step
  (void)compare_with_other_runs(nominal_case.other_runs, nominal_case.study, nominal_case.worn,
                                nominal_case.placed, nominal_case.structure->model);
}

CaseRunner::Case CaseRunner::read_case(const std::vector<std::string>& overrides) {
  study::Document document = document_;
  study::complete(document, overrides);
  Case out{study::read(document, {}), overrides, {}, {}, {}, {}, {}, {}, {}, {}, {}};
  for (study::Wear& entry : out.study.wear)
    entry.confidence.reset(); // a table has standard errors
  if (!out.study.transient)
    throw core::Error("the study has no [transient]; a sweep needs it (doc/study-file.md)");
  if (out.study.gap_opening)
    throw core::Error(
        "the study has [gap_opening]; a sweep computes wear at the gaps of each case: leave it out there");
  out.structure = bases_.structure(out.study, overrides);
  out.placed = place_contacts(out.study, out.structure->mesh, out.structure->dry, out.warnings);
  out.inactive = take_inactive(out.placed);
  for (std::string& warning : placement_warnings(out.study, out.structure->dry, out.placed))
    out.warnings.push_back(std::move(warning));
  out.worn = worn_places(out.study, out.structure->model, out.placed);
  out.nodes = observed_nodes(out.study, out.structure->mesh);
  out.force_sites = force_sites(out.study, out.structure->mesh, out.structure->model);
  out.other_runs = read_other_runs(out.study, {}); // a case has no folder that a state could name
  if (!out.other_runs.missing.empty())
    throw core::Error(out.other_runs.missing);
  check_contacts_of(out.other_runs, out.study, out.worn, out.placed);
  return out;
}

CaseRunner::Case CaseRunner::with_bases(Case read) {
  read.contacts = bases_.contacts(read.study, read.overrides, *read.structure, read.placed, read.inactive);
  return read;
}

ConnorsStability CaseRunner::stability_of(const Case& of) {
  if (of.study.stabilities.empty())
    return {};
  try {
    return *bases_.stability(of.study, of.overrides, *of.structure, together(of.placed, of.inactive));
  } catch (const core::Error& error) {
    return {{}, {fmt::format("{}; the case has no V/Vc", error.what())}};
  }
}

std::vector<std::string> CaseRunner::check(const std::vector<std::string>& overrides) {
  const Case read = read_case(overrides);
  const auto& contacts = read.study.contacts;
  const std::vector<SharedSignal> shared = shared_signals(read.study);
  if (shared.size() <= shared_signals_ ||
      std::none_of(contacts.begin(), contacts.end(),
                   [](const study::Contact& contact) { return contact.friction_dynamic > 0.0; }))
    return {};
  return {
      text_of(shared.back()) +
      ", which may move the structure along one line, without sliding; give each a seed of its own (seeds, "
      "or each = true)"};
}

void CaseRunner::compute_nominal(bool keeps_cases) {
  const Case nominal_case = with_bases(read_case({}));
  const std::vector<BuiltScene> scenes = scenes_of(nominal_case);
  if (keeps_cases)
    check_size_of_series(nominal_case.study, scenes);
  known_ = warnings_of(nominal_case, scenes);
}

sweep::CaseResult CaseRunner::operator()(const std::vector<std::string>& overrides) {
  const Case c = with_bases(read_case(overrides));
  const std::vector<BuiltScene> scenes = scenes_of(c);
  const auto choices = choose_steps(MPI_COMM_SELF, c.study, scenes);
  results::RunResults out;
  out.warnings = warnings_of(c, scenes);
  std::erase_if(out.warnings, [&](const std::string& warning) {
    return std::find(known_.begin(), known_.end(), warning) != known_.end();
  });
  out.accuracy = c.study.transient->accuracy;
  out.contacts = names_of(c.placed);
  observe(c.nodes, c.force_sites, out);
  resize_summaries(out);
  ConnorsStability stability = stability_of(c);
  out.stability = std::move(stability.assessments);
  out.warnings.insert(out.warnings.end(), stability.warnings.begin(), stability.warnings.end());
  for (std::size_t i = 0; i < scenes.size(); ++i)
    run_scene(c.study, scenes[i], choices[i], out);
  out.bases = nodes_of(c.contacts->bases);
  add_wear(c.study, c.worn, c.placed, c.other_runs, out);
  judge_wear(c.study, c.worn, c.placed, out);
  judge_contacts(c.study, c.placed, scenes, out);
  judge_step_errors(out);
  return {case_row(columns_, c.placed, out), results::grouped_messages(out.warnings)};
}

} // namespace fretwork::app
