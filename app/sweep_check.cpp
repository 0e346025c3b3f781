// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/sweep_check.hpp"
#include "app/case_run.hpp"
#include "app/sweep_plan.hpp"
#include "core/error.hpp"
#include "core/petsc.hpp"
#include "results/figures.hpp"
#include "sweep/schedule.hpp"
#include "sweep/summary.hpp"
#include <chrono>
#include <fmt/format.h>

namespace fretwork::app {
namespace {

constexpr std::chrono::seconds longest_reading{3};
constexpr std::int64_t most_drawn = 1'000'000;

/// Rows without values of the first cases.
sweep::Table read_cases(CaseRunner& runner, const study::Sweep& sweep, const sweep::Draws& draws) {
  using Clock = std::chrono::steady_clock;
  sweep::Table table{runner.columns(), {}};
  const auto begin = Clock::now();
  for (std::int64_t number = 0; number < draws.rows() && Clock::now() - begin < longest_reading; ++number)
    table.rows.push_back(sweep::evaluated(number, "", [&]() -> sweep::CaseResult {
      return {{}, runner.check(sweep::overrides_of(sweep, draws, number))};
    }));
  return table;
}

} // namespace

std::string sweep_check_text(const Request& request) {
  const core::PetscSession petsc(MPI_COMM_SELF);
  const SweepPlan plan = read_sweep_plan({request, {}, false});
  Inputs inputs = plan.inputs;
  inputs.directory = request.scratch.value();
  use_made_mesh(inputs);
  CaseRunner runner(study::parse(request.study), request.overrides, inputs);
  sweep::check_outputs(plan.sweep, runner.columns());
  if (plan.sweep.draws > most_drawn)
    return fmt::format("  sweep: {} are too many to be read here\n",
                       results::counted(plan.sweep.draws, "case"));
  const sweep::Draws draws = sweep::make_design(plan.sweep, 1);
  const sweep::Table table = read_cases(runner, plan.sweep, draws);
  const auto read = static_cast<std::int64_t>(table.rows.size());
  if (read == draws.rows() && table.done().empty())
    throw core::Error(
        fmt::format("no case of the sweep would be computed; case 0: {}", table.rows.front().message));
  std::string out = fmt::format(
      "  sweep: {} ({}) of {}{}{}\n", results::counted(draws.rows(), "case"),
      study::name_of(plan.sweep.design),
      results::counted(static_cast<std::int64_t>(plan.sweep.variables.size()), "variable"),
      plan.sweep.until ? ", more of them until a quantile is known" : "",
      read < draws.rows() ? fmt::format("; the first {} have been read", results::grouped(read)) : "");
  for (const std::string& line : sweep::case_warnings(table, "with a warning"))
    out += "  warning: " + line + "\n";
  return out;
}

} // namespace fretwork::app
