// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/sweep.hpp"
#include "app/case_worker.hpp"
#include "app/chain.hpp"
#include "app/end_signal.hpp"
#include "app/folder_lock.hpp"
#include "app/progress.hpp"
#include "app/python_report.hpp"
#include "app/sweep_plan.hpp"
#include "app/sweep_rows.hpp"
#include "core/error.hpp"
#include "core/mpi.hpp"
#include "core/mpi_counter.hpp"
#include "core/names.hpp"
#include "core/printable.hpp"
#include "results/figures.hpp"
#include "results/summary_file.hpp"
#include "sweep/schedule.hpp"
#include "sweep/summary.hpp"
#include <algorithm>
#include <chrono>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>

namespace fretwork::app {
namespace {

namespace fs = std::filesystem;
using sweep::Table;

/// Of operating states of wear with work rates of other runs, or of the study, where contacts vary; empty: none.
std::string states_that_do_not_vary(const SweepPlan& plan) {
  std::vector<std::string> varied, states;
  for (const study::SweepVariable& variable : plan.sweep.variables)
    for (const std::string& key : variable.keys)
      if (key.starts_with("contacts.") || key.starts_with("contact_defaults."))
        varied.push_back(key);
  for (const study::Wear& entry : plan.inputs.study.wear)
    for (const study::WearState& state : entry.states)
      if (state.results || state.given)
        states.push_back(state.name);
  if (varied.empty() || states.empty())
    return {};
  return fmt::format(
      "{} varies in the cases, but not in the operating states {} of [[wear]]: their work rates are "
      "those of other runs or of the study, with supports of their own",
      core::list_names(varied, 3), core::list_names(states, 3));
}

/// Increments of the counter of ended cases: those without a result are counted in its upper half.
constexpr std::int64_t one_case = 1, one_failure = (std::int64_t{1} << 32) + 1, cases_part = one_failure - 2;

/// Collective: the design of so many blocks, from rank 0.
sweep::Draws shared_design(MPI_Comm comm, const study::Sweep& sweep, std::int64_t blocks) {
  sweep::Draws draws;
  core::agree(comm, [&] {
    if (core::rank(comm) == 0)
      draws = sweep::make_design(sweep, blocks);
  });
  std::int64_t shape[2] = {draws.rows(), draws.cols()};
  MPI_Bcast(shape, 2, MPI_INT64_T, 0, comm);
  draws.resize(shape[0], shape[1]);
  constexpr Eigen::Index part = Eigen::Index{1} << 27; // counts stay within an int
  for (Eigen::Index at = 0; at < draws.size(); at += part)
    MPI_Bcast(draws.data() + at, static_cast<int>(std::min(part, draws.size() - at)), MPI_DOUBLE, 0, comm);
  return draws;
}

/// Of each node its length along the mesh, m, where that is one open chain; else empty.
std::vector<double> abscissae(const mesh::LineMesh& mesh) {
  std::vector<double> out(mesh.nodes.size(), std::numeric_limits<double>::quiet_NaN());
  double length = 0.0;
  for (std::size_t i = 0; i < mesh.lines.size(); ++i) { // in walking order
    const auto [from, to] = mesh.lines[i].nodes;
    const auto begin = static_cast<std::size_t>(from), end = static_cast<std::size_t>(to);
    if ((i > 0 && from != mesh.lines[i - 1].nodes[1]) || !std::isnan(out[end]))
      return {}; // another chain, or a closed one
    out[begin] = length;
    length += (mesh.nodes[end] - mesh.nodes[begin]).norm();
    out[end] = length;
  }
  return out;
}

/// The sweep at work on one rank.
class SweepRun {
public:
  SweepRun(MPI_Comm comm, const SweepRequest& request, SweepPlan plan)
      : comm_(comm), request_(request), plan_(std::move(plan)), first_rank_(core::rank(comm) == 0),
        progress_(first_rank_ && !request.request.quiet) {}

  /// Collective: all cases, in stages where the sweep goes on until it knows enough.
  void compute() {
    progress_.stage("basis");
    std::optional<CaseWorker> worker;
    core::agree(comm_, [&] {
      Request nominal = request_.request;
      nominal.directory = plan_.inputs.directory;
      worker.emplace(std::move(nominal), plan_.inputs.whole_key, first_rank_ && !request_.shard,
                     [this] { look(); });
    });
    for (std::int64_t blocks = 1;; blocks = next_blocks(blocks)) {
      draws_ = shared_design(comm_, plan_.sweep, blocks); // the first ones while the worker starts
      if (blocks == 1)
        core::agree(comm_, [&] {
          facts_ = worker->facts();
          sweep::check_outputs(plan_.sweep, facts_.columns);
          if (first_rank_ && !request_.shard)
            tell_warnings();
        });
      table_.outputs = facts_.columns;
      if (!request_.gather)
        compute_missing(*worker);
      gather();
      if (request_.shard || enough(blocks))
        return;
    }
  }

  /// Collective: the worst cases once more with all their results.
  void keep_worst() {
    std::vector<std::int64_t> kept;
    if (first_rank_ && plan_.sweep.keep > 0) {
      const std::string by = plan_.sweep.keep_by.empty() ? sweep::measure_of(table_) : plan_.sweep.keep_by;
      kept = sweep::worst_cases(table_, by, plan_.sweep.keep);
      summary_["worst_by"] = by;
    }
    auto count = static_cast<int>(kept.size());
    MPI_Bcast(&count, 1, MPI_INT, 0, comm_);
    kept.resize(static_cast<std::size_t>(count));
    MPI_Bcast(kept.data(), count, MPI_INT64_T, 0, comm_);
    core::agree(comm_, [&] {
      if (first_rank_)
        remove_runs_but(kept);
    });
    for (const std::int64_t number : kept) {
      progress_.stage(fmt::format("case {}", number));
      Request run = request_.request;
      for (const std::string& text : sweep::overrides_of(plan_.sweep, draws_, number))
        run.overrides.push_back(text);
      run.directory = plan_.directory / "runs" / fmt::format("case_{}", number);
      run.quiet = true;
      run_chain(comm_, run, Stage::transient);
    }
    summary_["worst"] = kept;
  }

  /// On rank 0: table, summary, report; the text for the terminal.
  std::string write() {
    progress_.stage("results");
    const std::map<std::string, std::string> record{{"version", FRETWORK_VERSION},
                                                    {"title", plan_.inputs.study.title},
                                                    {"study", plan_.inputs.study.text},
                                                    {"input_sha256", plan_.inputs.whole_key}};
    sweep::write_csv(plan_.directory / "table.csv", plan_.sweep, draws_, table_);
    sweep::write_archive(plan_.directory / "table.h5", plan_.sweep, draws_, table_, record);
    const std::vector<double> places = abscissae(mesh_stage(MPI_COMM_SELF, plan_.inputs));
    for (const auto& [name, node] : facts_.contacts) {
      summary_["contacts"].push_back({{"name", name}, {"node", node}});
      if (!places.empty() && !std::isnan(places[static_cast<std::size_t>(node)]))
        summary_["contacts"].back()["abscissa_m"] = places[static_cast<std::size_t>(node)];
    }
    for (const auto& [name, text] : record)
      summary_[name] = text;
    const std::string lines = sweep::summary_text(summary_); // warnings of the study have been told
    std::vector<std::string> warnings = warnings_;
    for (const auto& later : summary_["warnings"])
      warnings.push_back(later.get<std::string>());
    summary_["warnings"] = warnings;
    results::save_summary(plan_.directory / "summary.json", summary_);
    std::string text =
        plan_.inputs.study.title.empty() ? "Sweep\n" : "Sweep: " + plan_.inputs.study.title + "\n";
    text += lines;
    if (plan_.sweep.design == study::SweepDesign::grid)
      text += sweep::range_lines(table_);
    for (const auto& number : summary_["worst"])
      text += fmt::format(
          "  kept         {}\n",
          (plan_.directory / "runs" / fmt::format("case_{}", number.get<std::int64_t>())).string());
    if (request_.request.report)
      text += report();
    progress_.stage("");
    return text;
  }

  /// @throws core::ComputationError where cases have ended and none has a result
  void check_results() const {
    if (!table_.rows.empty() && table_.done().empty())
      throw core::ComputationError(fmt::format("no case of the sweep has a result; case {}: {}",
                                               table_.rows.front().number, table_.rows.front().message));
  }

  [[nodiscard]] std::string shard_text() const {
    return fmt::format("shard {}/{}: {} of {} cases are there; when all shards have ended, the same command "
                       "with --gather in place of --shard makes the table\n",
                       plan_.shard.index, plan_.shard.count,
                       results::grouped(static_cast<std::int64_t>(table_.rows.size())),
                       results::grouped(draws_.rows()));
  }

private:
  [[nodiscard]] std::int64_t next_blocks(std::int64_t blocks) const {
    return std::min(2 * blocks, plan_.sweep.until->most_draws / plan_.sweep.draws);
  }

  /// Collective: whether the sweep ends here; its summary.
  bool enough(std::int64_t blocks) {
    int enough = 1;
    core::agree(comm_, [&] {
      if (!first_rank_)
        return;
      progress_.stage("statistics");
      summary_ = sweep::summarize(plan_.sweep, draws_, table_);
      const auto& contacts = plan_.inputs.study.contacts;
      const auto has_friction = [](const study::Contact& contact) { return contact.friction_dynamic > 0.0; };
      if (std::any_of(contacts.begin(), contacts.end(), has_friction))
        if (std::string warning = sweep::no_sliding_warning(table_); !warning.empty())
          summary_["warnings"].push_back(std::move(warning));
      const bool reached = !plan_.sweep.until || !summary_.contains("statistics") ||
                           summary_["statistics"]["convergence"]["reached"].get<bool>();
      enough = reached || next_blocks(blocks) <= blocks ? 1 : 0;
    });
    MPI_Bcast(&enough, 1, MPI_INT, 0, comm_);
    return enough == 1;
  }

  /// Runs of an earlier state of the study, or of fewer cases, are not those of this table.
  void remove_runs_but(const std::vector<std::int64_t>& kept) const {
    std::vector<fs::path> stale;
    std::error_code absent;
    for (fs::directory_iterator at(plan_.directory / "runs", absent), end; at != end; at.increment(absent)) {
      const std::string name = at->path().filename().string();
      if (name.starts_with("case_") && std::none_of(kept.begin(), kept.end(), [&](std::int64_t number) {
            return name == fmt::format("case_{}", number);
          }))
        stale.push_back(at->path());
    }
    for (const fs::path& folder : stale)
      fs::remove_all(folder);
  }

  [[nodiscard]] sweep::FoundRows read() const {
    return sweep::read_rows(plan_.directory / "shards", draws_.rows(),
                            [&](std::int64_t number) { return identity_of(plan_, draws_, number); });
  }

  void compute_missing(CaseWorker& worker) {
    sweep::FoundRows found;
    core::agree(comm_, [&] {
      if (first_rank_)
        found = read();
    });
    const std::vector<std::int64_t> missing = missing_cases(comm_, plan_, draws_.rows(), found);
    there_ = cases_of_shard() - static_cast<std::int64_t>(missing.size());
    if (first_rank_)
      say(found_text(there_ - known_, missing.empty() ? sweep::FoundRows{} : found));
    known_ = cases_of_shard(); // after this stage
    found = {};
    progress_.stage("cases");
    core::SharedCounters counters(comm_);
    counters_ = &counters;
    to_do_ = static_cast<std::int64_t>(missing.size());
    std::optional<EndSignal> signal;
    if (core::size(comm_) == 1) // a launcher ends its ranks by itself
      signal.emplace();
    core::agree(comm_, [&] {
      sweep::ShardFile file(plan_.inputs.directory / fmt::format("rank_{}.rows", core::rank(comm_)));
      sweep::work(
          missing, core::size(comm_), [&] { return counters.add(0, 1); },
          [&](std::int64_t number) {
            return worker(number, identity_of(plan_, draws_, number),
                          sweep::overrides_of(plan_.sweep, draws_, number));
          },
          [&](const sweep::Row& row) {
            file.append(row);
            counters.add(1, row.outcome == sweep::Outcome::done ? one_case : one_failure);
            look();
          });
    });
    counters_ = nullptr;
  }

  [[nodiscard]] std::int64_t cases_of_shard() const {
    return (draws_.rows() - plan_.shard.index + plan_.shard.count) / plan_.shard.count;
  }

  void say(const std::string& text) const {
    if (!request_.request.quiet)
      fmt::print("{}", core::printable(text, core::longest_message_line));
  }

  /// Before the first case: there may be hours of them.
  void tell_warnings() {
    warnings_ = facts_.warnings;
    if (std::string fixed = states_that_do_not_vary(plan_); !fixed.empty())
      warnings_.push_back(std::move(fixed));
    progress_.stage("");
    for (const std::string& warning : warnings_)
      say(fmt::format("warning: {}\n", warning));
  }

  /// @throws core::Interrupted after SIGTERM or SIGINT
  void look() {
    if (const std::string signal = EndSignal::came(); !signal.empty())
      throw core::Interrupted(ended_text(signal));
    if (!counters_ || !first_rank_)
      return;
    counters_->progress();
    if (!progress_.shown() || to_do_ == 0)
      return;
    const std::int64_t ended = counters_->add(1, 0);
    progress_.update_cases(ended & cases_part, to_do_, ended >> 32);
  }

  [[nodiscard]] std::string ended_text(const std::string& signal) const {
    const std::int64_t there = there_ + (counters_ ? counters_->add(1, 0) & cases_part : 0);
    return fmt::format("ended by {}: {} of {} cases are there; the same command goes on with the others",
                       signal, results::grouped(there), results::grouped(draws_.rows()));
  }

  /// On rank 0: the table of what the files have.
  void gather() {
    core::agree(comm_, [&] {
      if (!first_rank_)
        return;
      sweep::FoundRows found = read();
      if (request_.gather && found.rows.empty())
        throw core::Error(fmt::format(
            "{}: no row of this sweep is there{}; give the -o and --set of its shards",
            plan_.directory.string(),
            found.of_others > 0 ? fmt::format(", {} of another state of the study", rows_are(found.of_others))
                                : ""));
      table_.rows = std::move(found.rows);
      for (const sweep::Row& row : table_.rows)
        if (row.outcome == sweep::Outcome::done && row.values.size() != table_.outputs.size())
          throw core::Error(fmt::format("the row of case {} has {} outputs instead of {}; give --force",
                                        row.number, row.values.size(), table_.outputs.size()));
    });
  }

  [[nodiscard]] std::string report() const {
    try {
      write_sweep_report(plan_.directory);
      return fmt::format("  report       {}\n", (plan_.directory / "report.html").string());
    } catch (const core::Error& error) {
      return fmt::format("no report: {}\n", error.what());
    }
  }

  MPI_Comm comm_;
  const SweepRequest& request_;
  SweepPlan plan_;
  bool first_rank_;
  Progress progress_;
  sweep::Draws draws_;
  SweepFacts facts_;
  std::vector<std::string> warnings_; ///< on rank 0: of the study as it stands
  Table table_;                       ///< rows on rank 0 only
  nlohmann::json summary_;
  core::SharedCounters* counters_ = nullptr;
  std::int64_t to_do_ = 0;
  std::int64_t there_ = 0; ///< cases that this stage has found
  std::int64_t known_ = 0; ///< cases of the stages before
};

} // namespace

void run_sweep(MPI_Comm comm, const SweepRequest& request) {
  const auto begin = std::chrono::steady_clock::now();
  const bool first_rank = core::rank(comm) == 0;
  SweepPlan plan;
  std::optional<FolderLock> lock;
  core::agree(comm, [&] {
    plan = read_sweep_plan(request);
    if (fs::exists(plan.directory / "results.h5"))
      throw core::Error(fmt::format("{} holds the results of a run; give the sweep another folder with -o",
                                    plan.directory.string()));
    make_directory(plan.inputs.directory);
    if (first_rank)
      lock.emplace(plan.inputs.directory, request.request.study.string());
    if (first_rank && request.request.force && !request.gather)
      remove_rows(plan, !request.shard);
  });
  make_mesh_file(comm, plan.inputs);
  core::agree(comm, [&] { make_keys(request.request, plan.inputs); });
  SweepRun run(comm, request, std::move(plan));
  run.compute();
  if (!request.shard)
    run.keep_worst();
  std::string text;
  core::agree(comm, [&] {
    if (first_rank)
      text = request.shard ? run.shard_text() : run.write();
  });
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
  if (first_rank && !request.request.quiet)
    fmt::print("{}  time         {:.3g} s on {}\n", core::printable(text, core::longest_message_line),
               seconds.count(), results::counted(core::size(comm), "rank"));
  core::agree(comm, [&] {
    if (first_rank)
      run.check_results();
  });
}

} // namespace fretwork::app
