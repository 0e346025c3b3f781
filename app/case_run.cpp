// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/case_run.hpp"
#include "app/checkpoints.hpp"
#include "app/expected_time.hpp"
#include "app/job.hpp"
#include "app/jobs.hpp"
#include "app/judge_contacts.hpp"
#include "app/judge_run.hpp"
#include "app/modal_truncation.hpp"
#include "app/shared_signals.hpp"
#include "app/verification.hpp"
#include "app/wear_of_run.hpp"
#include "core/error.hpp"
#include "results/grouped_messages.hpp"
#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace fretwork::app {
namespace {

constexpr double no_number = results::no_value;

/// A figure of contacts.
struct Figure {
  const char *name, *unit;
  double post::ContactSummary::*value;
  double post::StandardErrors::*error; ///< nullptr: none
};
constexpr std::array figures{
    Figure{"work_rate", "W", &post::ContactSummary::work_rate, &post::StandardErrors::work_rate},
    Figure{"normal_rms", "N", &post::ContactSummary::normal_rms, &post::StandardErrors::normal_rms},
    Figure{"normal_max", "N", &post::ContactSummary::normal_max, nullptr},
    Figure{"impact_rate", "1/s", &post::ContactSummary::impact_rate, &post::StandardErrors::impact_rate},
    Figure{"contact_time_ratio", "", &post::ContactSummary::contact_time_ratio, nullptr}};
constexpr std::size_t worst_figures = 3; ///< the first ones are given of the worst contact too

/// A row while it is filled.
class Filling {
public:
  explicit Filling(const std::vector<sweep::Column>& columns)
      : columns_(columns), values_(columns.size(), no_number) {}

  /// @throws core::Error for an output that the nominal case does not have
  void set(const std::string& name, double value) { values_[place(name)] = value; }
  /// Keeps the worst, with its error. @param largest  is worst; false: the smallest
  void worsen(const std::string& name, double value, double error, bool largest) {
    const std::size_t at = place(name);
    if (std::isnan(value) || (largest ? value <= values_[at] : value >= values_[at]))
      return;
    values_[at] = value;
    if (at + 1 < columns_.size() && columns_[at + 1].name == name + ".error")
      values_[at + 1] = error;
  }
  [[nodiscard]] std::vector<double> values() && { return std::move(values_); }

private:
  [[nodiscard]] std::size_t place(const std::string& name) {
    // rows are filled in the order of the columns
    for (std::size_t i = 0; i < columns_.size(); ++i, ++next_) {
      next_ = next_ < columns_.size() ? next_ : 0;
      if (columns_[next_].name == name)
        return next_;
    }
    throw core::Error(fmt::format("the case has an output \"{}\" that the study without its sweep has not; "
                                  "let the study have all contacts, and make some inactive in cases",
                                  name));
  }
  const std::vector<sweep::Column>& columns_;
  std::vector<double> values_;
  std::size_t next_ = 0;
};

/// Half of an interval of one standard error on both sides (CaseRunner::read_case); not a number of lives without end.
double half(const results::Bounds& bounds) {
  return std::isinf(bounds.low) ? std::numeric_limits<double>::quiet_NaN() : 0.5 * (bounds.high - bounds.low);
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
  const double from = study.output.statistics_from;
  post::ContactStatistics contacts(built.scene.contacts, from);
  post::SectorStatistics sectors(built.watched_wear.sectors, from);
  post::ForceSpeedClasses classes(built.watched_wear.maxima, from);
  std::vector<transient::Observer*> observers;
  if (!built.scene.contacts.empty())
    observers.push_back(&contacts);
  if (!built.watched_wear.sectors.empty())
    observers.push_back(&sectors);
  if (built.watched_wear.counts_forces())
    observers.push_back(&classes);
  transient::Run run(built.scene, choice, observers, nullptr,
                     transient::output_grid(study.transient->duration, output_interval(study)));
  const TimeLimit limit{study.transient->duration, study.transient->max_hours, [](const std::string&) {}};
  ExpectedTime expected(limit, 0.0);
  while (run.advance(Checkpoints::records_between_looks))
    expected.look(run.time());
  const transient::Report report = run.finish();
  judge_run(study, built, choice, report, out);
  out.transients.push_back({choice, report});
  const std::vector<transient::StepError> step_errors = run.step_errors();
  if (!step_errors.empty())
    out.step_errors.resize(out.contact_summaries.size());
  add_errors(out.errors_of_sums, contacts.errors_of_sums());
  const auto summaries = contacts.summaries();
  const auto rates = sectors.rates();
  const auto counted = classes.classes();
  std::size_t next = 0;
  for (std::size_t c = 0; c < built.contacts.size(); ++c) {
    out.contact_summaries[built.contacts[c]] = summaries[c];
    if (!step_errors.empty())
      out.step_errors[built.contacts[c]] = without_round_off(step_errors[c], summaries[c]);
    if (c < rates.size())
      out.sector_rates[built.contacts[c]] = rates[c];
    if (c < built.watched_wear.maxima.size() && built.watched_wear.maxima[c])
      out.force_speed_classes[built.contacts[c]] = counted[next++];
  }
}

void fill_contacts(const std::vector<PlacedContact>& placed, const results::RunResults& run, Filling& row) {
  double work = 0.0, impacts = 0.0, residual = 0.0;
  for (std::size_t k = 0; k < placed.size(); ++k) {
    const post::ContactSummary& statistics = run.contact_summaries[k];
    for (std::size_t f = 0; f < figures.size(); ++f) {
      const double value = statistics.*figures[f].value,
                   error = figures[f].error ? statistics.error.*figures[f].error : no_number;
      const std::string name = fmt::format("{}.{}", placed[k].name, figures[f].name);
      row.set(name, value);
      if (figures[f].error)
        row.set(name + ".error", error);
      if (f < worst_figures)
        row.worsen(fmt::format("worst.{}", figures[f].name), value, error, true);
    }
    work += statistics.work_rate;
    impacts += statistics.impact_rate;
  }
  for (const results::TransientFacts& transient : run.transients)
    residual = std::max(residual, transient.report.residual_relative);
  row.set("total.work_rate", work);
  row.set("total.work_rate.error", run.errors_of_sums.work_rate);
  row.set("total.impact_rate", impacts);
  row.set("total.impact_rate.error", run.errors_of_sums.impact_rate);
  row.set("total.energy_residual", residual);
}

void fill_wear(const results::Wear& wear, Filling& row) {
  for (const results::WearOfSupport& support : wear.supports) {
    const results::Bounds years = support.life.years;
    results::Bounds depth = support.depth.last();
    if (support.outside.empty() && std::isnan(depth.value)) // beyond the geometry
      depth.value = std::numeric_limits<double>::infinity();
    row.set(support.name + ".wear_depth", depth.value);
    row.set(support.name + ".wear_depth.error", half(depth));
    row.set(support.name + ".years", years.value);
    row.set(support.name + ".years.error", half(years));
    row.worsen("worst.wear_depth", depth.value, half(depth), true);
    row.worsen("worst.years", years.value, half(years), false);
  }
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
  OtherRuns other_runs;
  std::vector<std::string> warnings; ///< of where the contacts are
};

std::vector<std::string> CaseRunner::warnings_of(const Case& c, const std::vector<BuiltScene>& scenes) {
  std::vector<std::string> out = c.warnings;
  for (const BuiltScene& built : scenes)
    out.insert(out.end(), built.warnings.begin(), built.warnings.end());
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
  std::vector<BuiltScene> scenes;
  for (std::size_t i = 0; i < c.contacts->joined.size(); ++i) {
    std::vector<signals::SampledLoad> turbulence;
    for (std::size_t e = 0; e < c.study.turbulence.size(); ++e)
      if (const auto& load = c.contacts->turbulence[i][e])
        turbulence.push_back(with_seed(*load, c.study.turbulence[e].seed));
    scenes.push_back(build_scene(c.study, fields, std::move(turbulence), c.contacts->bases,
                                 c.contacts->joined[i], c.placed, c.contacts->flexibilities[i], {}));
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
  name_columns(nominal_case);
  // refuses runs of another tube; its warnings are those of the run before its first step
  (void)compare_with_other_runs(nominal_case.other_runs, nominal_case.study, nominal_case.worn,
                                nominal_case.placed, nominal_case.structure->model);
}

CaseRunner::Case CaseRunner::read_case(const std::vector<std::string>& overrides) {
  study::Document document = document_;
  study::complete(document, overrides);
  Case out{study::read(document, {}), overrides, {}, {}, {}, {}, {}, {}, {}};
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
  out.worn = worn_places(out.study, out.structure->model, out.placed);
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

void CaseRunner::compute_nominal() {
  const Case nominal_case = with_bases(read_case({}));
  known_ = warnings_of(nominal_case, scenes_of(nominal_case));
}

void CaseRunner::name_columns(const Case& nominal) {
  const auto add = [&](const std::string& name, const char* unit, bool has_error) {
    columns_.push_back({name, unit});
    if (has_error)
      columns_.push_back({name + ".error", unit});
  };
  const std::vector<PlacedContact> all = together(nominal.placed, nominal.inactive);
  if (all.empty())
    throw core::Error("the study has no [[contacts]]; a sweep gives their statistics");
  for (const PlacedContact& contact : all) {
    contacts_.emplace_back(contact.name, contact.node);
    for (const Figure& figure : figures)
      add(fmt::format("{}.{}", contact.name, figure.name), figure.unit, figure.error != nullptr);
  }
  const std::vector<WornPlace> worn = worn_places(nominal.study, nominal.structure->model, all);
  for (const WornPlace& place : worn) {
    add(place.name + ".wear_depth", "m", true);
    add(place.name + ".years", "a", true);
  }
  add("total.work_rate", "W", true);
  add("total.impact_rate", "1/s", true);
  add("total.energy_residual", "", false);
  for (std::size_t f = 0; f < worst_figures; ++f)
    add(fmt::format("worst.{}", figures[f].name), figures[f].unit, figures[f].error != nullptr);
  if (!worn.empty()) {
    add("worst.wear_depth", "m", true);
    add("worst.years", "a", true);
  }
  for (std::size_t i = 0; i < columns_.size(); ++i)
    if (std::find(columns_.begin(), columns_.begin() + static_cast<std::ptrdiff_t>(i), columns_[i]) !=
        columns_.begin() + static_cast<std::ptrdiff_t>(i))
      throw core::Error(
          fmt::format("two outputs of the sweep are called \"{}\"; rename the contact (\"total\" "
                      "and \"worst\" are all contacts together, and the worst)",
                      columns_[i].name));
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
  out.contact_summaries.resize(c.placed.size());
  out.sector_rates.resize(c.placed.size());
  out.force_speed_classes.resize(c.placed.size());
  for (std::size_t i = 0; i < scenes.size(); ++i)
    run_scene(c.study, scenes[i], choices[i], out);
  out.bases = nodes_of(c.contacts->bases);
  add_wear(c.study, c.worn, c.placed, c.other_runs, out);
  Filling row(columns_);
  fill_contacts(c.placed, out, row);
  if (out.wear)
    fill_wear(*out.wear, row);
  judge_restitution(c.study, c.placed, out);
  judge_stuck_dampers(c.study, c.placed, scenes, out);
  judge_sliding(c.study, c.placed, out);
  judge_step_errors(out);
  return {std::move(row).values(), results::grouped_messages(out.warnings)};
}

} // namespace fretwork::app
