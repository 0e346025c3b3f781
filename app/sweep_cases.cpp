// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/sweep_cases.hpp"
#include "app/end_signal.hpp"
#include "app/sweep_rows.hpp"
#include "core/error.hpp"
#include "core/mpi.hpp"
#include "results/figures.hpp"
#include "sweep/schedule.hpp"
#include <fmt/format.h>

namespace fretwork::app {
namespace {

constexpr int of_blocks = 0, of_cases = 1; ///< numbers of the counters

/// Increments of the counter of ended cases: those without a result are counted in its upper half.
constexpr std::int64_t one_case = 1, one_failure = (std::int64_t{1} << 32) + 1, cases_part = one_failure - 2;

} // namespace

SweepCases::SweepCases(MPI_Comm comm, const SweepRequest& request, const SweepPlan& plan, Progress& progress)
    : comm_(comm), plan_(plan), progress_(progress), first_rank_(core::rank(comm) == 0) {
  core::agree(comm_, [&] {
    Request nominal = request.request;
    nominal.directory = plan_.inputs.directory;
    worker_.emplace(std::move(nominal), plan_.inputs.whole_key, first_rank_ && !request.shard,
                    [this] { look(); });
  });
}

std::string SweepCases::find_missing(const sweep::Draws& draws) {
  sweep::FoundRows found;
  core::agree(comm_, [&] {
    if (first_rank_)
      found = read_rows(plan_, draws);
  });
  missing_ = missing_cases(comm_, plan_, draws.rows(), found);
  all_ = cases_of_shard(draws);
  there_ = cases_of_shard(draws) - static_cast<std::int64_t>(missing_.size());
  const std::int64_t earlier = there_ - known_;
  known_ = cases_of_shard(draws);
  return first_rank_ ? found_text(earlier, missing_.empty() ? sweep::FoundRows{} : found) : std::string();
}

void SweepCases::compute_missing(const sweep::Draws& draws) {
  progress_.stage("cases");
  core::SharedCounters counters(comm_);
  counters_ = &counters;
  std::optional<EndSignal> signal;
  if (core::size(comm_) == 1) // a launcher ends its ranks by itself
    signal.emplace();
  core::agree(comm_, [&] {
    sweep::ShardFile file(plan_.inputs.directory / fmt::format("rank_{}.rows", core::rank(comm_)));
    sweep::work(
        missing_, core::size(comm_), [&] { return counters.add(of_blocks, 1); },
        [&](std::int64_t number) {
          return (*worker_)(number, identity_of(plan_, draws, number),
                            sweep::overrides_of(plan_.sweep, draws, number));
        },
        [&](const sweep::Row& row) {
          file.append(row);
          counters.add(of_cases, row.outcome == sweep::Outcome::done ? one_case : one_failure);
          look();
        });
  });
  counters_ = nullptr;
}

/// Between cases, and now and then within one: shows how far all ranks are.
void SweepCases::look() {
  if (const std::string signal = EndSignal::came(); !signal.empty())
    throw core::Interrupted(ended_text(signal));
  if (!counters_ || !first_rank_)
    return;
  counters_->progress();
  if (!progress_.shown() || missing_.empty())
    return;
  const std::int64_t counted = ended();
  progress_.update_cases(counted & cases_part, static_cast<std::int64_t>(missing_.size()), counted >> 32);
}

/// The counter of ended cases.
std::int64_t SweepCases::ended() const { return counters_ ? counters_->add(of_cases, 0) : 0; }

std::string SweepCases::ended_text(const std::string& signal) const {
  return fmt::format("ended by {}: {} of {} cases are there; the same command goes on with the others",
                     signal, results::grouped(there_ + (ended() & cases_part)), results::grouped(all_));
}

std::int64_t SweepCases::cases_of_shard(const sweep::Draws& draws) const {
  return (draws.rows() - plan_.shard.index + plan_.shard.count) / plan_.shard.count;
}

} // namespace fretwork::app
