// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/sweep.hpp"
#include "app/chain.hpp"
#include "app/folder_lock.hpp"
#include "app/python_report.hpp"
#include "app/sweep_cases.hpp"
#include "app/sweep_results.hpp"
#include "app/sweep_rows.hpp"
#include "core/error.hpp"
#include "core/mpi.hpp"
#include "core/names.hpp"
#include "core/printable.hpp"
#include "results/figures.hpp"
#include "sweep/summary.hpp"
#include <algorithm>
#include <chrono>
#include <fmt/format.h>
#include <optional>

namespace fretwork::app {
namespace {

namespace fs = std::filesystem;
using sweep::Table;

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

/// The sweep at work on one rank.
class SweepRun {
public:
  SweepRun(MPI_Comm comm, const SweepRequest& request, SweepPlan plan)
      : comm_(comm), request_(request), plan_(std::move(plan)), first_rank_(core::rank(comm) == 0),
        progress_(first_rank_ && !request.request.quiet) {}

  /// Collective: all cases, in stages where the sweep goes on until it knows enough.
  void compute() {
    progress_.stage("basis");
    SweepCases cases(comm_, request_, plan_, progress_);
    for (std::int64_t blocks = 1;; blocks = next_blocks(blocks)) {
      results_.draws = shared_design(comm_, plan_.sweep, blocks); // the first ones while the process starts
      if (blocks == 1)
        core::agree(comm_, [&] {
          results_.facts = cases.facts();
          sweep::check_outputs(plan_.sweep, results_.facts.columns);
          if (first_rank_ && !request_.shard)
            tell_warnings();
        });
      results_.table.outputs = results_.facts.columns;
      if (!request_.gather) {
        say(cases.find_missing(results_.draws));
        cases.compute_missing(results_.draws);
      }
      gather();
      if (request_.shard || enough(blocks))
        return;
    }
  }

  /// Collective: the worst cases once more with all their results.
  void keep_worst() {
    std::vector<std::int64_t> kept;
    if (first_rank_ && plan_.sweep.keep > 0) {
      const Table& table = results_.table;
      const std::string by = plan_.sweep.keep_by.empty() ? sweep::measure_of(table) : plan_.sweep.keep_by;
      kept = sweep::worst_cases(table, by, plan_.sweep.keep);
      results_.summary["worst_by"] = by;
    }
    auto count = static_cast<int>(kept.size());
    MPI_Bcast(&count, 1, MPI_INT, 0, comm_);
    kept.resize(static_cast<std::size_t>(count));
    MPI_Bcast(kept.data(), count, MPI_INT64_T, 0, comm_);
    core::agree(comm_, [&] {
      if (first_rank_)
        remove_runs_but(kept);
    });
    std::vector<std::int64_t> with_results;
    for (const std::int64_t number : kept)
      if (keep(number))
        with_results.push_back(number);
    results_.summary["worst"] = with_results;
  }

  /// On rank 0: table, summary, report; the text for the terminal.
  std::string write() {
    progress_.stage("results");
    std::string text = write_sweep(plan_, results_);
    if (request_.request.report)
      text += report();
    progress_.stage("");
    return text;
  }

  /// @throws core::ComputationError where cases have ended and none has a result
  void check_results() const {
    const std::vector<sweep::Row>& rows = results_.table.rows;
    if (!rows.empty() && results_.table.done().empty())
      throw core::ComputationError(fmt::format("no case of the sweep has a result; case {}: {}",
                                               rows.front().number, rows.front().message));
  }

  [[nodiscard]] std::string shard_text() const {
    return fmt::format("shard {}/{}: {} of {} cases are there; when all shards have ended, the same command "
                       "with --gather in place of --shard makes the table\n",
                       plan_.shard.index, plan_.shard.count,
                       results::grouped(static_cast<std::int64_t>(results_.table.rows.size())),
                       results::grouped(results_.draws.rows()));
  }

private:
  /// Collective: runs a case with all its results. @return whether it has them; if not, a warning says why
  [[nodiscard]] bool keep(std::int64_t number) {
    progress_.stage(fmt::format("case {}", number));
    Request run = request_.request;
    for (const std::string& text : sweep::overrides_of(plan_.sweep, results_.draws, number))
      run.overrides.push_back(text);
    run.directory = folder_of_case(plan_, number);
    run.quiet = true;
    const auto refused = [&](const std::exception& error) { // alike on all ranks
      results_.summary["warnings"].push_back(
          fmt::format("case {} could not be kept: {}", number, error.what()));
      return false;
    };
    try {
      run_chain(comm_, run, Stage::transient);
    } catch (const core::Interrupted&) {
      throw;
    } catch (const core::ComputationError& error) {
      return refused(error);
    } catch (const core::Error& error) {
      return refused(error);
    }
    return true;
  }

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
      nlohmann::json& summary = results_.summary;
      summary = sweep::summarize(plan_.sweep, results_.draws, results_.table);
      const auto& contacts = plan_.inputs.study.contacts;
      const auto has_friction = [](const study::Contact& contact) { return contact.friction_dynamic > 0.0; };
      if (std::any_of(contacts.begin(), contacts.end(), has_friction))
        if (std::string warning = sweep::no_sliding_warning(results_.table); !warning.empty())
          summary["warnings"].push_back(std::move(warning));
      const bool reached = !plan_.sweep.until || !summary.contains("statistics") ||
                           summary["statistics"]["convergence"]["reached"].get<bool>();
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
            return name == folder_of_case(plan_, number).filename();
          }))
        stale.push_back(at->path());
    }
    for (const fs::path& folder : stale)
      fs::remove_all(folder);
  }

  void say(const std::string& text) const {
    if (!text.empty() && !request_.request.quiet)
      fmt::print("{}", core::printable(text, core::longest_message_line));
  }

  /// Before the first case: there may be hours of them.
  void tell_warnings() {
    results_.warnings = results_.facts.warnings;
    if (std::string fixed = states_that_do_not_vary(plan_); !fixed.empty())
      results_.warnings.push_back(std::move(fixed));
    progress_.stage("");
    for (const std::string& warning : results_.warnings)
      say(fmt::format("warning: {}\n", warning));
  }

  /// On rank 0: the table of what the files have.
  void gather() {
    core::agree(comm_, [&] {
      if (!first_rank_)
        return;
      sweep::FoundRows found = read_rows(plan_, results_.draws);
      if (request_.gather && found.rows.empty())
        throw core::Error(fmt::format(
            "{}: no row of this sweep is there{}; give the -o and --set of its shards",
            plan_.directory.string(),
            found.of_others > 0 ? fmt::format(", {} of another state of the study", rows_are(found.of_others))
                                : ""));
      Table& table = results_.table;
      table.rows = std::move(found.rows);
      for (const sweep::Row& row : table.rows)
        if (row.outcome == sweep::Outcome::done && row.values.size() != table.outputs.size())
          throw core::Error(fmt::format("the row of case {} has {} outputs instead of {}; give --force",
                                        row.number, row.values.size(), table.outputs.size()));
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
  SweepResults results_;
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
      remove_rows(request.shard ? plan.inputs.directory : folder_of_rows(plan));
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
