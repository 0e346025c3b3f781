// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/chain.hpp"
#include "app/build_flow.hpp"
#include "app/contact_directions.hpp"
#include "app/contact_notes.hpp"
#include "app/contact_questions.hpp"
#include "app/cross_flow.hpp"
#include "app/describe.hpp"
#include "app/flow_coverage.hpp"
#include "app/fluidelastic.hpp"
#include "app/folder_lock.hpp"
#include "app/force_sites.hpp"
#include "app/gap_opening.hpp"
#include "app/held_damping.hpp"
#include "app/judge_fluidelastic.hpp"
#include "app/law_motion.hpp"
#include "app/linear_response.hpp"
#include "app/load_flexibility.hpp"
#include "app/mode_notes.hpp"
#include "app/modes_limit.hpp"
#include "app/motion_facts.hpp"
#include "app/numbering.hpp"
#include "app/pinned_modes.hpp"
#include "app/progress.hpp"
#include "app/python_report.hpp"
#include "app/run_spectra.hpp"
#include "app/scenes.hpp"
#include "app/size_of_results.hpp"
#include "app/stability.hpp"
#include "app/static_modes.hpp"
#include "app/stopwatch.hpp"
#include "app/stored_results.hpp"
#include "app/support_motion.hpp"
#include "app/sweep_check.hpp"
#include "app/transient_stage.hpp"
#include "app/unit_slips.hpp"
#include "app/weight_stiffness.hpp"
#include "core/error.hpp"
#include "core/mpi.hpp"
#include "core/petsc.hpp"
#include "core/printable.hpp"
#include "core/temporary_directory.hpp"
#include "results/figures.hpp"
#include "results/summary_file.hpp"
#include "results/totals.hpp"
#include "results/write.hpp"
#include <algorithm>
#include <array>
#include <cstdlib>
#include <fmt/format.h>
#include <functional>
#include <iterator>
#include <optional>

namespace fretwork::app {
namespace {

namespace fs = std::filesystem;

/// `1 node`, `3 nodes`
template <class Things> std::string counted(const Things& things, const char* what) {
  return results::counted(static_cast<std::int64_t>(things.size()), what);
}

constexpr std::size_t most_motions = 8; ///< that check shows

/// Of a file that may not be there.
void remove_file(const fs::path& file) {
  std::error_code ignored;
  fs::remove(file, ignored);
}

/// The chain up to its last stage: what each stage makes is there for those after it. Every method is collective.
class Chain {
public:
  Chain(MPI_Comm comm, const Request& request, Stage last)
      : comm_(comm), request_(request), last_(last), first_rank_(core::rank(comm) == 0),
        progress_(first_rank_ && !request.quiet) {}

  void run() {
    read();
    if (is_up_to_date() && last_ == Stage::transient)
      return tell_up_to_date();
    keep_a_run();
    make_model();
    if (last_ == Stage::mesh)
      return tell_mesh();
    asking_about_units(unit_slips_, [&] {
      build();
      if (last_ == Stage::check)
        return tell_check();
      if (last_ == Stage::transient)
        run_transient();
    });
    if (last_ == Stage::check)
      return;
    write();
    tell_results();
  }

  /// What a case of a sweep would warn of: stability and response are not part of it.
  std::vector<std::string> warnings_of_case() {
    read();
    inputs_.study.stabilities.clear();
    inputs_.study.responses.clear();
    make_model();
    build();
    return results::all_warnings(out_);
  }

private:
  void tell_mesh() const {
    say(fmt::format("{}, {}, groups: {}\n", counted(mesh_.nodes, "node"), counted(mesh_.lines, "line"),
                    fmt::join(mesh::group_names(mesh_), ", ")));
  }

  /// Of the model all that comes before the first step.
  void build() {
    make_modes();
    if (scenes_wanted_)
      core::agree(comm_, [&] {
        scenes_ = build_scenes(inputs_.study, out_.bases, placed_, nodes_, at_contacts_, out_);
        for (BuiltScene& scene : scenes_)
          follow_forces(out_.force_sites, lacking_forces_, model_, out_.bases, at_contacts_.fields, scene);
      });
  }

  void say(const std::string& text) const {
    if (first_rank_ && !request_.quiet)
      fmt::print("{}", core::printable(text, core::longest_message_line));
  }

  /// The study, its folder and its mesh file.
  void read() {
    core::agree(comm_, [&] {
      inputs_ = read_inputs(request_);
      scenes_wanted_ = last_ == Stage::transient || (last_ == Stage::check && inputs_.study.transient);
      refuse_what_is_missing();
      if (fs::exists(inputs_.directory / "table.h5") || fs::exists(inputs_.directory / "shards"))
        throw core::Error(fmt::format("{} holds the results of a sweep; give another folder with -o",
                                      inputs_.directory.string()));
      make_directory(inputs_.directory);
      if (first_rank_) {
        lock_.emplace(inputs_.directory, inputs_.study.file.string());
        const bool before_transient =
            last_ == Stage::modes || last_ == Stage::stability || last_ == Stage::response;
        inputs_.keeps_run = before_transient && !request_.force && has_run(inputs_.directory);
      }
    });
    if (inputs_.study.varied && last_ != Stage::mesh) {
      out_.notes.emplace_back(
          "[sweep] varies keys of this study: fretwork sweep computes its cases, this run has the values of "
          "the study (and of --set)");
      if (last_ != Stage::check) // which prints all notes once
        say("note: " + out_.notes.back() + "\n");
    }
    out_.timings.read = watch_.lap();
    progress_.stage("mesh");
    make_mesh_file(comm_, inputs_);
    core::agree(comm_, [&] { make_keys(request_, inputs_); });
  }

  void refuse_what_is_missing() const {
    if (last_ == Stage::transient && !inputs_.study.transient)
      throw core::Error(
          "the study has no [transient]; add it, or compute its modes with: fretwork modes STUDY");
    if (last_ == Stage::stability && inputs_.study.flows.empty())
      throw core::Error("the study has no [[flow]] to be stable in; add it (doc/study-file.md)");
    if (last_ == Stage::response && inputs_.study.turbulence.empty())
      throw core::Error("the study has no [[turbulence]] to respond to; add it (doc/study-file.md)");
  }

  [[nodiscard]] bool is_up_to_date() {
    const auto tell = [&](const std::string& line) {
      if (!inputs_.keeps_run) // else it is refused
        say(line + "\n");
    };
    int current = first_rank_ && !request_.force && up_to_date(inputs_, tell) ? 1 : 0;
    MPI_Bcast(&current, 1, MPI_INT, 0, comm_);
    return up_to_date_ = current != 0;
  }

  /// A stage before the transient does not take the place of a run of other inputs.
  void keep_a_run() const {
    core::agree(comm_, [&] {
      if (first_rank_ && !up_to_date_)
        refuse_to_replace_run(inputs_);
    });
  }

  void tell_up_to_date() const {
    if (first_rank_ && request_.report && !fs::exists(inputs_.directory / "report.html"))
      say(make_report(inputs_.directory));
    say(fmt::format("Nothing has changed: the results in {} are up to date (--force computes them again).\n",
                    inputs_.directory.string()));
  }

  /// The mesh, the model and where contacts, flows and loads are on it.
  void make_model() {
    mesh_ = mesh_stage(comm_, inputs_);
    out_.timings.mesh = watch_.lap();
    out_.record = make_record(inputs_, core::size(comm_));
    core::agree(comm_, [&] {
      model_ = build_model(inputs_.study, mesh_);
      unit_slips_ = unit_slips(inputs_.study, mesh_, model_);
      out_.warnings = unit_slips_;
      asking_about_units(unit_slips_, [&] { place_on_model(); });
      out_.modes_limit = take_modes_limit(inputs_.study, model_, placed_, turbulence_);
      if (out_.modes_limit)
        limit_modes();
    });
    note_coincident_nodes(mesh_, out_);
    if (out_.modes_limit)
      say(early_warnings(out_));
    if (last_ == Stage::transient && !other_runs_.missing.empty()) // likewise
      say("warning: " + other_runs_.missing + "\n");
    out_.timings.assembly = watch_.lap();
  }

  void place_on_model() {
    const study::Study& study = inputs_.study;
    placed_ = place_contacts(study, mesh_, model_, out_.warnings);
    inactive_ = take_inactive(placed_);
    warn(placement_warnings(study, model_, placed_));
    if (std::string few = few_outputs(study); !few.empty() && scenes_wanted_)
      out_.notes.push_back(std::move(few));
    if (scenes_wanted_)
      describe_motions(study, out_);
    flows_ = place_flows(study, mesh_, model_, out_.notes);
    warn(parts_without_fluid(study, model_, flows_));
    for (std::string& note : cross_flow_in_legs(study, model_, flows_, placed_))
      out_.notes.push_back(std::move(note));
    // without entries, stability assesses tubes with their supports
    if (are_damped_by_supports(study) || (last_ == Stage::stability && study.stabilities.empty()))
      for (std::string& note : supports_without_length({study, mesh_, model_, flows_}, placed_))
        out_.notes.push_back(std::move(note));
    turbulence_ = turbulent_loads(study, model_, flows_, out_.notes);
    warn(spectra_of_one_phase(study, turbulence_));
    nodes_ = observed_nodes(study, mesh_);
    out_.force_sites = force_sites(study, mesh_, model_);
    moved_ = moved_supports(study, mesh_, model_);
    worn_ = worn_places(study, model_, placed_);
    check_gap_opening(study, worn_, placed_);
    other_runs_ = read_other_runs(study, inputs_.run_directory);
    check_contacts_of(other_runs_, study, worn_, placed_);
    warn(compare_with_other_runs(other_runs_, study, worn_, placed_, model_));
    placement_notes_ = {directions_text(study, model_, placed_),
                        numbering_text(study, model_, together(placed_, inactive_), flows_)};
    note_other_runs(other_runs_, out_);
  }

  void warn(const std::vector<std::string>& warnings) {
    out_.warnings.insert(out_.warnings.end(), warnings.begin(), warnings.end());
  }

  void limit_modes() {
    if (std::string capped = cap_default_modes(inputs_.study, model_, placed_, *out_.modes_limit);
        !capped.empty())
      out_.warnings.push_back(std::move(capped));
    else
      report_modes_limit(inputs_.study, *out_.modes_limit, out_);
  }

  /// Modes, stability and response in flow, and what scenes are built from.
  void make_modes() {
    progress_.stage("modes");
    const core::PetscSession petsc(comm_);
    ModesStage modes = modes_stage(comm_, inputs_, model_, out_.record, request_.force);
    describe_model(mesh_, model_, modes.structures, out_);
    out_.model.different_structures = static_cast<std::int64_t>(modes.different);
    warn(modes.warnings);
    out_.notes.insert(out_.notes.end(), modes.notes.begin(), modes.notes.end());
    out_.bases = std::move(modes.bases);
    note_modes(inputs_.study, out_);
    if (std::string few = few_modes_warning(inputs_.study, model_, placed_, out_.bases); !few.empty())
      out_.warnings.insert(out_.warnings.begin(), std::move(few)); // forces may be wrong by factors
    if (inputs_.study.modes.static_modes == study::StaticModes::added) {
      add_static_modes(comm_, inputs_.study, model_, modes.structures, placed_, out_.bases);
      out_.notes.push_back(static_modes_note(inputs_.study, out_.bases));
    }
    judge_in_flow();
    note_weight_stiffness(comm_, inputs_.study, model_, modes.structures, out_.bases, placed_, out_);
    if (last_ == Stage::modes)
      out_.closed_frequencies = closed_frequencies(comm_, inputs_.study, model_, placed_);
    out_.timings.modes = watch_.lap();
    if (!scenes_wanted_)
      return;
    progress_.stage("basis");
    core::agree(comm_, [&] {
      at_contacts_.fields = build_fields(inputs_.study, mesh_, model_, flows_,
                                         support_fields(moved_, model_, modes.structures));
      at_contacts_.fields.motion = fluidelastic_forces({inputs_.study, mesh_, model_, flows_}, out_.bases);
      lacking_forces_ = lacking_forces(out_.force_sites, {model_, modes.structures, out_.bases},
                                       at_contacts_.fields, placed_, out_.notes);
      at_contacts_.turbulence = turbulence_;
      at_contacts_.joined = joined_structures(out_.bases, placed_, at_contacts_.fields.motion);
    });
    warn_of_load_flexibility(comm_, inputs_.study, model_, modes.structures, out_.bases, placed_,
                             at_contacts_.fields);
    note_held_damping(inputs_.study, model_, out_.bases, placed_, out_);
    at_contacts_.flexibilities = contact_flexibilities(comm_, inputs_.study, model_, modes.structures,
                                                       out_.bases, at_contacts_.joined, placed_);
  }

  /// Damping by the flow, stability and linear response.
  void judge_in_flow() {
    const study::Study& study = inputs_.study;
    const TubesInFlow tubes{study, mesh_, model_, flows_};
    if (study.modes.flow_damping)
      core::agree(comm_, [&] {
        out_.flow_damping = damp_by_flow(tubes, DampingSet::transient, placed_, inactive_, out_.bases);
        for (const results::TubeDamping& tube : out_.flow_damping)
          out_.notes.insert(out_.notes.end(), tube.limits.begin(), tube.limits.end());
      });
    if (last_ == Stage::stability || (scenes_wanted_ && !study.stabilities.empty()))
      assess_stability(comm_, tubes, together(placed_, inactive_), out_);
    if (scenes_wanted_)
      core::agree(comm_, [&] { judge_fluidelastic(tubes, out_.bases, placed_, out_); });
    if (last_ == Stage::response || (scenes_wanted_ && !study.responses.empty()))
      linear_responses(comm_, tubes, turbulence_, together(placed_, inactive_), nodes_, out_);
  }

  void tell_check() {
    progress_.stage("");
    note_places();
    const std::string forecast =
        scenes_wanted_ ? forecast_text(comm_, inputs_.study, scenes_, placed_, out_)
                       : "  no [transient]: run would refuse it; modes, stability and response take it\n";
    std::string motions;
    for (std::size_t k = 0; k < std::min(most_motions, out_.motions.size()); ++k)
      motions += fmt::format("  {}\n", results::motion_text(out_.motions[k]));
    const std::string sweep = inputs_.study.varied && scenes_wanted_ ? sweep_check_text(request_) : "";
    say(fmt::format("{}: fine\n  {}, {}, {} in {}, {:.6g} kg\n  {}, {}, {}{}\n{}{}{}",
                    request_.study.string(), counted(mesh_.nodes, "node"), counted(model_.beams, "beam"),
                    results::counted(out_.model.dofs, "free dof"), counted(out_.bases, "structure"),
                    out_.model.mass_kg, counted(placed_, "contact"), counted(inputs_.study.loads, "load"),
                    counted(nodes_, "observed node"),
                    worn_.empty() ? "" : ", " + counted(worn_, "support") + " that wear", motions + forecast,
                    check_messages(out_, out_.modes_limit.has_value()), sweep));
  }

  void run_transient() {
    for (const NamedNode& node : nodes_)
      out_.node_names.push_back(node.name);
    out_.duration = inputs_.study.transient->duration;
    out_.statistics_from = inputs_.study.output.statistics_from;
    out_.timings.basis = watch_.lap();
    const auto print_line = [&](const std::string& line) { // from whichever rank makes the run
      if (!request_.quiet)
        fmt::print("{}\n", line);
      (void)std::fflush(stdout); // a process of its own may say it, or this one may soon be killed
    };
    Checkpoints checkpoints(
        {inputs_.directory,
         FRETWORK_VERSION,
         inputs_.whole_key,
         inputs_.study.output.checkpoint,
         !request_.force,
         print_line,
         {inputs_.study.transient->duration, inputs_.study.transient->max_hours, print_line}});
    app::run_transient(
        {comm_, inputs_.study, placed_, worn_, other_runs_, at_contacts_, progress_, checkpoints}, scenes_,
        out_);
    core::agree(comm_, [&] { judge_motion({inputs_.study, mesh_, model_, flows_}, placed_, nodes_, out_); });
    out_.timings.transient = watch_.lap();
  }

  /// After all notes that may tell of something wrong.
  void note_places() {
    std::copy_if(placement_notes_.begin(), placement_notes_.end(), std::back_inserter(out_.notes),
                 [](const std::string& note) { return !note.empty(); });
  }

  void write() {
    progress_.stage("results");
    note_places();
    core::agree(comm_, [&] {
      if (!first_rank_)
        return;
      write_tables();
      if (!up_to_date_) // the results of a whole run hold its modes too: `modes` leaves them
        write_results();
    });
    if (first_rank_ && request_.report && last_ == Stage::transient) {
      progress_.stage("report");
      report_line_ = make_report(inputs_.directory);
    }
  }

  void write_tables() {
    const fs::path& folder = inputs_.directory;
    if (!up_to_date_) // of an earlier state of the study
      for (const char* file : {"flow.csv", "spectra.csv"})
        remove_file(folder / file);
    if (!up_to_date_ && last_ != Stage::modes) // or of another command that assesses
      for (const char* file : {"stability.csv", "stability_diagram.csv", "response.csv"})
        remove_file(folder / file);
    if (!out_.stability.empty())
      results::write_stability_csv(folder, out_);
    if (!flows_.empty())
      results::write_flow_csv(folder / "flow.csv", flow_rows(inputs_.study, model_, flows_));
    if (last_ == Stage::transient && !turbulence_.empty()) {
      const std::vector<results::Spectrum> spectra = run_spectra(turbulence_, out_);
      results::write_spectra_csv(folder / "spectra.csv", spectra);
      if (std::string note = folding_note(spectra); !note.empty())
        out_.notes.push_back(std::move(note));
    }
    if (!out_.responses.empty())
      results::write_response_csv(folder / "response.csv", out_);
  }

  void write_results() {
    // whatever is interrupted from here on, no summary or report tells of other results than those in results.h5
    for (const char* file : {"summary.json", "report.html"})
      remove_file(inputs_.directory / file);
    leave_out_series(inputs_.study, placed_, out_);
    results::write_archive(inputs_.directory / "results.h5", out_);
    out_.timings.output = watch_.lap();
    out_.timings.total = watch_.total();
    results::write_summary(inputs_.directory / "summary.json", out_);
    if (last_ == Stage::transient)
      Checkpoints::remove(inputs_.directory);
  }

  void tell_results() {
    progress_.stage("");
    if (last_ == Stage::modes)
      say(results::modes_table(out_));
    if (last_ != Stage::transient)
      say(results::stability_table(out_) + results::response_table(out_) + results::flow_damping_table(out_));
    std::error_code absent;
    const auto bytes = static_cast<double>(fs::file_size(inputs_.directory / "results.h5", absent));
    const std::string size = absent ? "" : fmt::format(" ({} of series and modes)", size_text(bytes));
    say(results::terminal_table(out_) + fmt::format("results: {}{}\n", inputs_.directory.string(), size) +
        report_line_);
  }

  MPI_Comm comm_;
  const Request& request_;
  Stage last_;
  bool first_rank_;
  Stopwatch watch_;
  Progress progress_;
  bool scenes_wanted_ = false, up_to_date_ = false;
  Inputs inputs_;
  std::optional<FolderLock> lock_;
  mesh::LineMesh mesh_;
  fem::Model model_;
  std::vector<PlacedContact> placed_, inactive_;
  std::vector<PlacedFlow> flows_;
  std::vector<TurbulentLoad> turbulence_;
  std::vector<NamedNode> nodes_;
  std::array<std::string, 2>
      placement_notes_; ///< directions of flat obstacles, numbers of supports along tubes
  std::vector<LackingForce> lacking_forces_; ///< by force sites
  std::vector<MovedSupport> moved_;
  std::vector<WornPlace> worn_;
  OtherRuns other_runs_;
  std::vector<std::string> unit_slips_; ///< questions about values in other units than those of the SI
  AtContacts at_contacts_;
  std::vector<BuiltScene> scenes_;
  results::RunResults out_;
  std::string report_line_;
};

} // namespace

void run_chain(MPI_Comm comm, const Request& request, Stage last) { Chain(comm, request, last).run(); }

std::vector<std::string> warnings_of_case(const Request& request) {
  const core::TemporaryDirectory folder;
  Request in_folder = request;
  in_folder.scratch = folder.path();
  in_folder.quiet = true;
  return Chain(MPI_COMM_SELF, in_folder, Stage::check).warnings_of_case();
}

void check(const Request& request) {
  const core::TemporaryDirectory folder;
  Request in_folder = request;
  in_folder.scratch = folder.path();
  run_chain(MPI_COMM_SELF, in_folder, Stage::check);
}

} // namespace fretwork::app
