// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/chain.hpp"
#include "app/build_flow.hpp"
#include "app/contact_notes.hpp"
#include "app/folder_lock.hpp"
#include "app/jobs.hpp"
#include "app/linear_response.hpp"
#include "app/modal_truncation.hpp"
#include "app/modes_limit.hpp"
#include "app/progress.hpp"
#include "app/python_report.hpp"
#include "app/residual_flexibility.hpp"
#include "app/run_spectra.hpp"
#include "app/size_of_results.hpp"
#include "app/stability.hpp"
#include "app/static_modes.hpp"
#include "app/support_motion.hpp"
#include "app/unit_slips.hpp"
#include "app/wear_of_run.hpp"
#include "core/error.hpp"
#include "core/mpi.hpp"
#include "core/petsc.hpp"
#include "core/printable.hpp"
#include "results/figures.hpp"
#include "results/grouped_messages.hpp"
#include "results/summary_file.hpp"
#include "results/totals.hpp"
#include "results/write.hpp"
#include "transient/simd/kernels.hpp"
#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <fmt/format.h>
#include <functional>
#include <limits>
#include <numbers>
#include <optional>
#include <petscversion.h>
#include <slepcversion.h>

namespace fretwork::app {
namespace {

namespace fs = std::filesystem;

/// Seconds since it was made, or since the last lap.
class Stopwatch {
public:
  double lap() {
    const auto now = Clock::now();
    const double seconds = std::chrono::duration<double>(now - last_).count();
    last_ = now;
    return seconds;
  }
  [[nodiscard]] double total() const { return std::chrono::duration<double>(Clock::now() - begin_).count(); }

private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point begin_ = Clock::now(), last_ = begin_;
};

results::RunRecord make_record(const Inputs& inputs, int ranks) {
  results::RunRecord record;
  record.version = FRETWORK_VERSION;
  record.title = inputs.study.title;
  record.study_text = inputs.study.text;
  record.overrides = inputs.study.overrides;
  record.input_sha256 = inputs.whole_key;
  for (const auto& load : inputs.study.loads)
    if (const auto* random = std::get_if<transient::Random>(&load.function))
      record.seeds.push_back(random->seed);
  for (const study::Turbulence& turbulence : inputs.study.turbulence)
    record.seeds.push_back(turbulence.seed);
  for (const auto& motion : inputs.study.base_motions)
    if (const auto* random = std::get_if<transient::Random>(&motion.acceleration))
      record.seeds.push_back(random->seed);
  for (const auto& motion : inputs.study.support_motions)
    if (const auto* random = std::get_if<transient::Random>(&motion.function))
      record.seeds.push_back(random->seed);
  record.libraries = {
      {"PETSc", fmt::format("{}.{}.{}", PETSC_VERSION_MAJOR, PETSC_VERSION_MINOR, PETSC_VERSION_SUBMINOR)},
      {"SLEPc", fmt::format("{}.{}.{}", SLEPC_VERSION_MAJOR, SLEPC_VERSION_MINOR, SLEPC_VERSION_SUBMINOR)},
      {"Eigen", fmt::format("{}.{}.{}", EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION)}};
  record.vector_width = transient::kernels::vector_width();
  record.ranks = ranks;
  return record;
}

/// What the beams are made of: elements that differ by their masses alone (of the flow) have one property.
void describe_beams(const fem::Model& model, results::RunResults& out) {
  std::vector<core::Index> number;
  for (fem::BeamProperty property : model.properties) {
    property.added_mass = 0.0;
    property.added_mass_direction = fem::AddedMass::transverse;
    property.fluid = {};
    if (property.taper)
      property.taper = fem::Taper{property.taper->section};
    const auto found = std::find(out.properties.begin(), out.properties.end(), property);
    number.push_back(static_cast<core::Index>(found - out.properties.begin()));
    if (found == out.properties.end())
      out.properties.push_back(property);
  }
  out.beams = model.beams;
  for (fem::Beam& beam : out.beams)
    beam.property = number[static_cast<std::size_t>(beam.property)];
}

void describe_model(const mesh::LineMesh& mesh, const fem::Model& model,
                    const std::vector<fem::Structure>& structures, results::RunResults& out) {
  out.nodes = model.nodes;
  for (const std::string& name : mesh::group_names(mesh))
    out.groups[name] = mesh::group_nodes(mesh, name, "the results");
  for (const auto& beam : model.beams)
    out.lines.push_back({beam.a, beam.b});
  describe_beams(model, out);
  out.model.nodes = static_cast<std::int64_t>(model.nodes.size());
  out.model.elements = static_cast<std::int64_t>(model.beams.size());
  for (const auto& structure : structures)
    out.model.dofs += structure.equations;
  out.model.mass_kg = fem::total_mass(model);
}

results::ContactFacts facts_of(const study::Contact& contact, const PlacedContact& placed,
                               const contact::Support& support) {
  results::ContactFacts facts;
  facts.name = placed.name;
  facts.node = placed.node;
  facts.other = placed.other;
  facts.point = {placed.place, placed.motion};
  facts.axes = placed.frame.rotation();
  facts.obstacle = study::name_of(contact.obstacle);
  facts.gap = placed.other < 0
                  ? contact::locate(support.obstacle, 0.0, 0.0).gap // of a tube at the obstacle's centre
                  : contact::locate(support.obstacle, placed.rest.y(), placed.rest.z()).gap;
  facts.rest = placed.rest;
  const auto outline = contact::outline_of(support.obstacle);
  facts.outline.resize(static_cast<Eigen::Index>(outline.size()), 2);
  for (std::size_t i = 0; i < outline.size(); ++i)
    facts.outline.row(static_cast<Eigen::Index>(i)) << outline[i].y, outline[i].z;
  facts.normal_stiffness = support.normal.stiffness;
  facts.normal_damping = support.normal.damping;
  facts.normal_dissipation = support.normal.dissipation;
  facts.tangential_stiffness = support.friction.stiffness;
  facts.tangential_damping = support.friction.damping;
  facts.friction_static = support.friction.mu_static;
  facts.friction_dynamic = support.friction.mu_dynamic;
  facts.friction_along = {support.friction.along.x, support.friction.along.t};
  return facts;
}

/// What scenes are built from besides the modes.
struct AtContacts {
  Fields fields;
  std::vector<TurbulentLoad> turbulence;
  std::vector<std::vector<std::size_t>> joined;  ///< structures of each scene
  std::vector<ContactFlexibility> flexibilities; ///< of each scene
};

/// Of a table of accelerations that ends before the run and not at 0, which drives the base or support away; else empty.
std::string goes_on_note(const Fields::Load& load, double duration) {
  constexpr double rest = 1e-3; // of the largest value: what a record is cut off at
  const auto* table = std::get_if<transient::Table>(&load.function);
  if (!load.inertial || !table || table->time.back() >= duration)
    return {};
  double largest = 0.0;
  for (const double value : table->value)
    largest = std::max(largest, std::abs(value));
  return std::abs(table->value.back()) > rest * largest
             ? fmt::format("{}: the table ends at {:g} s, before the run; its last acceleration, {:g} m/s2, "
                           "goes on to "
                           "the end: let it end at 0 where it should not",
                           load.name, table->time.back(), table->value.back())
             : std::string();
}

/// What the modes make of contacts and loads, for every structure that can move.
std::vector<BuiltScene> build_scenes(const study::Study& study, const std::vector<modal::Basis>& bases,
                                     const std::vector<PlacedContact>& placed,
                                     const std::vector<NamedNode>& nodes, const AtContacts& at_contacts,
                                     results::RunResults& out) {
  const auto& [fields, turbulence, joined, flexibilities] = at_contacts;
  std::vector<BuiltScene> scenes;
  out.contacts.resize(placed.size());
  for (std::size_t i = 0; i < joined.size(); ++i) {
    const ContactFlexibility& flexibility = flexibilities[i];
    scenes.push_back(build_scene(study, fields, sampled_loads(turbulence, bases, joined[i], out.notes), bases,
                                 joined[i], placed, flexibility, nodes));
    const BuiltScene& scene = scenes.back();
    for (std::size_t k = 0; k < scene.contacts.size(); ++k) {
      const std::size_t c = scene.contacts[k];
      out.contacts[c] = facts_of(study.contacts[placed[c].entry], placed[c], scene.scene.contacts[k].support);
      if (flexibility.failure.empty())
        out.contacts[c].static_flexibility = flexibility.at(k, placed[c].obstacle);
    }
    if (!flexibility.failure.empty())
      out.notes.push_back("no static flexibility at the contacts: " + flexibility.failure);
    out.warnings.insert(out.warnings.end(), scene.warnings.begin(), scene.warnings.end());
    out.notes.insert(out.notes.end(), scene.notes.begin(), scene.notes.end());
  }
  out.warnings.insert(out.warnings.end(), fields.warnings.begin(), fields.warnings.end());
  const auto of_contacts = contact_notes(study, placed, scenes);
  out.notes.insert(out.notes.end(), of_contacts.begin(), of_contacts.end());
  if (const std::string note = flexibility_note(study, scenes); !note.empty())
    out.notes.insert(out.notes.begin(), note);
  for (const std::string& warning :
       {missing_flexibility_warning(study, scenes), load_band_warning(study, bases, fields.loads)})
    if (!warning.empty()) // what makes forces wrong by factors comes first
      out.warnings.insert(out.warnings.begin(), warning);
  for (std::size_t k = 0; k < fields.loads.size(); ++k)
    for (std::size_t j = 0; j < k; ++j) {
      const auto* one = std::get_if<transient::Random>(&fields.loads[j].function);
      const auto* two = std::get_if<transient::Random>(&fields.loads[k].function);
      if (one && two && one->seed == two->seed && one->low == two->low && one->high == two->high)
        out.notes.push_back(
            fmt::format("{} and {} follow one random signal: they have the same seed {} and band; give one "
                        "another seed if they are independent",
                        fields.loads[j].name, fields.loads[k].name, one->seed));
    }
  for (const Fields::Load& load : fields.loads)
    if (const std::string note = goes_on_note(load, study.transient->duration); !note.empty())
      out.notes.push_back(note);
  // a support that moves nothing by its inertia may still carry an obstacle
  for (std::size_t k = 0; k < fields.loads.size() && !fields.loads[k].of_support; ++k) {
    const auto idle = [&](const BuiltScene& scene) { return scene.scene.loads[k].modal_force.isZero(0.0); };
    if (std::all_of(scenes.begin(), scenes.end(), idle))
      out.warnings.push_back(
          fmt::format("{} moves nothing: its nodes are restrained in its direction; apply it elsewhere",
                      fields.loads[k].name));
  }
  for (const NamedNode& node : nodes) {
    const auto has = [&](const modal::Basis& basis) { return basis.row_of(node.node) >= 0; };
    if (std::none_of(bases.begin(), bases.end(), has))
      throw core::Error(fmt::format(
          "[output] nodes: \"{}\" belongs to no structure that moves; observe another node", node.name));
  }
  return scenes;
}

/// `1 node`, `3 nodes`
template <class Things> std::string counted(const Things& things, const char* what) {
  return results::counted(static_cast<std::int64_t>(things.size()), what);
}

/// True where the results in the folder are whole and were computed from the same inputs. Damage is told.
bool up_to_date(const Inputs& inputs, const std::function<void(const std::string&)>& tell) {
  const results::FoundSummary found = results::read_summary(inputs.directory / "summary.json");
  if (!found.refusal.empty())
    tell(found.refusal + ": the results are computed again");
  const nlohmann::json& summary = found.summary;
  if (!summary.is_object() || !summary.contains("transient") ||
      summary.value("input_sha256", "") != inputs.whole_key ||
      summary.value("version", "") != FRETWORK_VERSION)
    return false;
  const fs::path archive = inputs.directory / "results.h5";
  const std::string refusal = results::archive_refusal(archive, inputs.whole_key);
  if (!refusal.empty() && fs::exists(archive))
    tell(fmt::format("{} is not as it was written ({}): the results are computed again", archive.string(),
                     refusal));
  return refusal.empty();
}

/// Share of a frequency that the mesh may add before the user is told.
constexpr double told_mesh_error = 0.01;

/// Modes that the mesh is too coarse for.
void report_mesh_error(results::RunResults& out) {
  std::size_t coarse = 0, all = 0;
  double lowest = std::numeric_limits<double>::infinity(), worst = 0.0;
  for (const auto& basis : out.bases)
    for (Eigen::Index i = 0; i < basis.size(); ++i, ++all)
      if (basis.error(i) > told_mesh_error) {
        ++coarse;
        lowest = std::min(lowest, basis.omega(i) / (2.0 * std::numbers::pi));
        worst = std::max(worst, basis.error(i));
      }
  if (coarse > 0)
    out.warnings.push_back(
        fmt::format("the mesh is coarse for {} of {} modes, from {:.4g} Hz on: it adds more than 1 % to "
                    "their frequencies, up to "
                    "about {:.2g} % (too few elements a half wave); mesh more finely, or ask for fewer modes",
                    coarse, all, lowest, 100.0 * worst));
}

/// Of ratios given as per cent, most often.
std::string overdamped_note(const std::vector<modal::Basis>& bases) {
  double lowest = std::numeric_limits<double>::infinity(), ratio = 0.0;
  for (const modal::Basis& basis : bases)
    for (Eigen::Index i = 0; i < basis.true_modes(); ++i)
      if (basis.omega(i) > 0.0 && basis.omega(i) < lowest) {
        lowest = basis.omega(i);
        ratio = basis.damping(i);
      }
  return ratio >= 1.0 ? fmt::format("the lowest mode has a damping ratio of {:.3g} and does not oscillate; "
                                    "modes.damping = 0.02 "
                                    "is 2 % of the critical damping",
                                    ratio)
                      : std::string();
}

/// What the user should know of the modes.
void report_modes(const study::Study& study, results::RunResults& out) {
  std::size_t split = 0, short_of = 0;
  for (const auto& basis : out.bases) {
    split += basis.splits_group ? 1 : 0;
    short_of += study.modes.count_given && basis.size() < *study.modes.count ? 1 : 0;
  }
  if (split > 0)
    out.warnings.push_back(fmt::format("modes.count = {} cuts a group of equal frequencies{}: the two planes "
                                       "of a tube are not treated alike; take "
                                       "one more or one less",
                                       *study.modes.count,
                                       split > 1 ? fmt::format(" of {} structures", split) : ""));
  report_mesh_error(out);
  if (const std::string note = overdamped_note(out.bases); !note.empty())
    out.notes.push_back(note);
  if (const auto all = static_cast<std::int64_t>(out.bases.size()); out.model.different_structures < all)
    out.notes.push_back(
        fmt::format("{} structures, {} different ones: the others are copies and take their modes", all,
                    out.model.different_structures));
  if (short_of > 0)
    out.notes.push_back(out.bases.size() == 1
                            ? fmt::format("modes.count = {} is more than the {} that the structure has",
                                          *study.modes.count, out.bases[0].size())
                            : fmt::format("{} of {} structures have fewer modes than modes.count = {}",
                                          short_of, out.bases.size(), *study.modes.count));
}

/// The report, or why there is none: the results are whole without it.
std::string make_report(const fs::path& directory) {
  try {
    write_report(directory);
    return fmt::format("report: {}\n", (directory / "report.html").string());
  } catch (const core::Error& error) {
    return fmt::format("no report: {}\n", error.what());
  }
}

void report_coincident(const mesh::LineMesh& mesh, results::RunResults& out) {
  if (!mesh.coincident.empty())
    out.notes.push_back(
        fmt::format("{} of nodes at the same place {} not joined (mesh.merge_tolerance would join them)",
                    mesh.coincident.size() == 1 ? "1 pair" : fmt::format("{} pairs", mesh.coincident.size()),
                    mesh.coincident.size() == 1 ? "is" : "are"));
}

/// A line a warning, for `check`.
std::string told_warnings(const results::RunResults& out) {
  std::string told;
  for (const std::string& warning : results::grouped_messages(out.warnings))
    told += "  warning: " + warning + "\n";
  return told;
}

/// How long a run would be and how much it would write; warnings of its steps go to `out`.
std::string forecast_text(MPI_Comm comm, const study::Study& study, const std::vector<BuiltScene>& scenes,
                          const std::vector<PlacedContact>& placed, results::RunResults& out) {
  const Forecast forecast = check_jobs(comm, study, scenes);
  out.warnings.insert(out.warnings.end(), forecast.warnings.begin(), forecast.warnings.end());
  const SizeOfResults size = size_of_results(study, scenes, placed, forecast.outputs, forecast.impact_rows);
  const std::string steps = forecast.steps > 0.0
                                ? results::counted(static_cast<std::int64_t>(forecast.steps), "step")
                                : std::string("steps as the tolerance asks for");
  return fmt::format("  {}; a run: {:g} s, {}; results.h5: {} of series, up to {} of impacts\n",
                     counted(results::sorted_modes(out.bases), "mode"), study.transient->duration, steps,
                     size_text(size.series), size_text(size.impacts));
}

} // namespace

void run_chain(MPI_Comm comm, const Request& request, Stage last) {
  Stopwatch watch;
  const bool first_rank = core::rank(comm) == 0;
  Progress progress(first_rank && !request.quiet);
  const auto say = [&](const std::string& text) {
    if (first_rank && !request.quiet)
      fmt::print("{}", core::printable(text, core::longest_message_line));
  };
  Inputs inputs;
  bool scenes_wanted = last == Stage::transient;
  std::optional<FolderLock> lock;
  core::agree(comm, [&] {
    inputs = read_inputs(request);
    scenes_wanted = scenes_wanted || (last == Stage::check && inputs.study.transient);
    if (last == Stage::transient && !inputs.study.transient)
      throw core::Error(
          "the study has no [transient]; add it, or compute its modes with: fretwork modes STUDY");
    if (last == Stage::stability && inputs.study.flows.empty())
      throw core::Error("the study has no [[flow]] to be stable in; add it (doc/study-file.md)");
    if (last == Stage::response && inputs.study.turbulence.empty())
      throw core::Error("the study has no [[turbulence]] to respond to; add it (doc/study-file.md)");
    make_directory(inputs.directory);
    if (first_rank)
      lock.emplace(inputs.directory, inputs.study.file.string());
  });
  results::RunResults out;
  out.timings.read = watch.lap();
  progress.stage("mesh");
  make_mesh_file(comm, inputs);
  core::agree(comm, [&] { make_keys(request, inputs); });
  int current =
      first_rank && !request.force && up_to_date(inputs, [&](const std::string& line) { say(line + "\n"); })
          ? 1
          : 0;
  MPI_Bcast(&current, 1, MPI_INT, 0, comm);
  if (current && last == Stage::transient) {
    if (first_rank && request.report && !fs::exists(inputs.directory / "report.html"))
      say(make_report(inputs.directory));
    return say(
        fmt::format("Nothing has changed: the results in {} are up to date (--force computes them again).\n",
                    inputs.directory.string()));
  }

  const mesh::LineMesh mesh = mesh_stage(comm, inputs);
  out.timings.mesh = watch.lap();
  out.record = make_record(inputs, core::size(comm));
  fem::Model model;
  std::vector<PlacedContact> placed, inactive;
  std::vector<PlacedFlow> flows;
  std::vector<TurbulentLoad> turbulence;
  std::vector<NamedNode> nodes;
  std::vector<MovedSupport> moved;
  std::vector<WornPlace> worn;
  OtherRuns other_runs;
  core::agree(comm, [&] {
    model = build_model(inputs.study, mesh);
    out.warnings = unit_slips(inputs.study, mesh, model);
    placed = place_contacts(inputs.study, mesh, model, out.warnings);
    inactive = take_inactive(inputs.study, placed);
    flows = place_flows(inputs.study, mesh, model, out.notes);
    turbulence = turbulent_loads(inputs.study, model, flows, out.notes);
    nodes = observed_nodes(inputs.study, mesh);
    moved = moved_supports(inputs.study, mesh, model);
    worn = worn_places(inputs.study, model, placed);
    other_runs = read_other_runs(inputs.study, worn, placed);
    if (inputs.study.modes.accuracy) {
      out.modes_limit = modes_limit(inputs.study, model, placed);
      inputs.study.modes.up_to_hz = out.modes_limit->up_to;
      report_modes_limit(inputs.study, *out.modes_limit, out);
    }
  });
  report_coincident(mesh, out);
  out.timings.assembly = watch.lap();
  if (last == Stage::mesh)
    return say(fmt::format("{}, {}, groups: {}\n", counted(mesh.nodes, "node"), counted(mesh.lines, "line"),
                           fmt::join(mesh::group_names(mesh), ", ")));

  progress.stage("modes");
  AtContacts at_contacts;
  {
    const core::PetscSession petsc;
    ModesStage modes = modes_stage(comm, inputs, model, out.record, request.force);
    describe_model(mesh, model, modes.structures, out);
    out.model.different_structures = static_cast<std::int64_t>(modes.different);
    out.warnings.insert(out.warnings.end(), modes.warnings.begin(), modes.warnings.end());
    out.notes.insert(out.notes.end(), modes.notes.begin(), modes.notes.end());
    out.bases = std::move(modes.bases);
    report_modes(inputs.study, out);
    if (inputs.study.modes.static_modes == study::StaticModes::added) {
      add_static_modes(comm, inputs.study, model, modes.structures, placed, out.bases);
      out.notes.push_back(static_modes_note(inputs.study, out.bases));
    }
    const TubesInFlow tubes{inputs.study, mesh, model, flows};
    if (inputs.study.modes.flow_damping)
      core::agree(comm, [&] {
        out.flow_damping = damp_by_flow(tubes, DampingSet::transient, placed, inactive, out.bases);
        for (const results::TubeDamping& tube : out.flow_damping)
          out.notes.insert(out.notes.end(), tube.limits.begin(), tube.limits.end());
      });
    if (last == Stage::stability || (scenes_wanted && !inputs.study.stabilities.empty()))
      assess_stability(comm, tubes, together(placed, inactive), out);
    if (last == Stage::response || (scenes_wanted && !inputs.study.responses.empty()))
      linear_responses(comm, tubes, turbulence, together(placed, inactive), nodes, out);
    out.timings.modes = watch.lap();
    if (scenes_wanted) {
      progress.stage("basis");
      core::agree(comm, [&] {
        at_contacts.fields =
            build_fields(inputs.study, mesh, model, support_fields(moved, model, modes.structures));
        at_contacts.turbulence = turbulence;
        at_contacts.joined = joined_structures(out.bases, placed);
      });
      at_contacts.flexibilities =
          contact_flexibilities(comm, inputs.study, model, modes.structures, out.bases, at_contacts.joined,
                                placed, at_contacts.fields.loads);
    }
  }
  std::vector<BuiltScene> scenes;
  if (scenes_wanted)
    core::agree(comm,
                [&] { scenes = build_scenes(inputs.study, out.bases, placed, nodes, at_contacts, out); });
  if (last == Stage::check) {
    progress.stage("");
    const std::string forecast = scenes_wanted ? forecast_text(comm, inputs.study, scenes, placed, out) : "";
    return say(fmt::format(
        "{}: fine\n  {}, {}, {} in {}, {:.6g} kg\n  {}, {}, {}{}\n{}{}", request.study.string(),
        counted(mesh.nodes, "node"), counted(model.beams, "beam"),
        results::counted(out.model.dofs, "free dof"), counted(out.bases, "structure"), out.model.mass_kg,
        counted(placed, "contact"), counted(inputs.study.loads, "load"), counted(nodes, "observed node"),
        worn.empty() ? "" : ", " + counted(worn, "support") + " that wear", forecast, told_warnings(out)));
  }
  if (last == Stage::transient) {
    const WatchedWear watched = watched_wear(inputs.study, worn, placed.size());
    for (BuiltScene& scene : scenes)
      scene.watched_wear = watched.at(scene.contacts);
    for (const NamedNode& node : nodes)
      out.node_names.push_back(node.name);
    out.duration = inputs.study.transient->duration;
    out.statistics_from = inputs.study.output.statistics_from;
    out.timings.basis = watch.lap();
    progress.stage("transient");
    const ProgressCallback callback =
        progress.shown() ? ProgressCallback([&](double share, double time) { progress.update(share, time); })
                         : ProgressCallback();
    const CheckpointOptions checkpoints{
        inputs.directory,
        FRETWORK_VERSION,
        inputs.whole_key,
        inputs.study.output.checkpoint,
        !request.force,
        [&](const std::string& line) { // from whichever rank makes the run
          if (!request.quiet)
            fmt::print("{}\n", line);
        },
        {inputs.study.transient->duration, inputs.study.transient->max_hours, [&](const std::string& line) {
           if (!request.quiet)
             fmt::print("{}\n", line);
         }}};
    run_jobs(comm, inputs.study, scenes, placed.size(), nodes.size(), callback, checkpoints, out);
    core::agree(comm, [&] { add_wear(inputs.study, worn, placed, other_runs, out); });
    out.timings.transient = watch.lap();
  }
  progress.stage("results");
  core::agree(comm, [&] {
    if (first_rank && !out.stability.empty())
      results::write_stability_csv(inputs.directory / "stability.csv", out);
    for (const char* file : {"flow.csv", "spectra.csv"}) { // of an earlier state of the study
      std::error_code ignored;
      if (first_rank && last == Stage::transient)
        fs::remove(inputs.directory / file, ignored);
    }
    if (first_rank && !flows.empty())
      results::write_flow_csv(inputs.directory / "flow.csv", flow_rows(inputs.study, model, flows));
    if (first_rank && last == Stage::transient && !turbulence.empty())
      results::write_spectra_csv(inputs.directory / "spectra.csv", run_spectra(turbulence, out));
    if (first_rank && !out.responses.empty())
      results::write_response_csv(inputs.directory / "response.csv", out);
    if (!first_rank || current) // the results of a whole run hold its modes too: `modes` leaves them
      return;
    // whatever is interrupted from here on, no summary or report tells of other results than those in results.h5
    for (const char* file : {"summary.json", "report.html"}) {
      std::error_code ignored;
      fs::remove(inputs.directory / file, ignored);
    }
    leave_out_series(inputs.study, placed, out);
    results::write_archive(inputs.directory / "results.h5", out);
    out.timings.output = watch.lap();
    out.timings.total = watch.total();
    results::write_summary(inputs.directory / "summary.json", out);
    if (last == Stage::transient)
      Checkpoints::remove(inputs.directory);
  });
  std::string report_line;
  if (first_rank && request.report && last == Stage::transient) {
    progress.stage("report");
    report_line = make_report(inputs.directory);
  }
  progress.stage("");
  if (last == Stage::modes)
    say(results::modes_table(out));
  if (last != Stage::transient)
    say(results::flow_damping_table(out) + results::stability_table(out) + results::response_table(out));
  std::error_code absent;
  const auto bytes = static_cast<double>(fs::file_size(inputs.directory / "results.h5", absent));
  const std::string size = absent ? "" : fmt::format(" ({} of series and modes)", size_text(bytes));
  say(results::terminal_table(out) + fmt::format("results: {}{}\n", inputs.directory.string(), size) +
      report_line);
}

void check(const Request& request) {
  std::string folder = (fs::temp_directory_path() / "fretwork_check_XXXXXX").string();
  if (!mkdtemp(folder.data()))
    throw core::Error("no temporary folder can be made in " + fs::temp_directory_path().string());
  struct Removed {
    fs::path folder;
    ~Removed() {
      std::error_code ignored;
      fs::remove_all(folder, ignored);
    }
  } const removed{folder};
  Request in_folder = request;
  in_folder.directory = folder;
  run_chain(MPI_COMM_SELF, in_folder, Stage::check);
}

} // namespace fretwork::app
