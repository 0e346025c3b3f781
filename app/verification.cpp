// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/verification.hpp"
#include "results/error_estimate.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <type_traits>

namespace fretwork::app {

namespace {

/// The run at half the step with what watches it.
class HalfJob {
public:
  HalfJob(const transient::Scene& scene, const transient::StepChoice& half, double from,
          ProgressObserver* progress)
      : contacts_(scene.contacts, from), observers_(watching(progress)),
        run_(scene, half, observers_, nullptr, {}) {}
  [[nodiscard]] transient::Run& run() { return run_; }
  [[nodiscard]] HalfRun result() {
    return {run_.finish(), contacts_.summaries(), contacts_.errors_of_sums()};
  }

private:
  std::vector<transient::Observer*> watching(ProgressObserver* progress) {
    std::vector<transient::Observer*> observers{&contacts_};
    if (progress)
      observers.push_back(progress);
    return observers;
  }

  post::ContactStatistics contacts_;
  std::vector<transient::Observer*> observers_;
  transient::Run run_;
};

} // namespace

HalfRun run_at_half(const transient::Scene& scene, const transient::StepChoice& choice, double from,
                    ProgressObserver* progress, const OwnCheckpoint& own) {
  const transient::StepChoice half = transient::halved(choice);
  const auto make = [&] { return std::make_unique<HalfJob>(scene, half, from, progress); };
  return resumed_run(make, own)->result();
}

void broadcast(MPI_Comm comm, int root, std::size_t contacts, HalfRun& half) {
  static_assert(std::is_trivially_copyable_v<transient::Report> &&
                std::is_trivially_copyable_v<post::ContactSummary>);
  half.contacts.resize(contacts);
  MPI_Bcast(&half.report, static_cast<int>(sizeof half.report), MPI_BYTE, root, comm);
  MPI_Bcast(&half.errors_of_sums, static_cast<int>(sizeof half.errors_of_sums), MPI_BYTE, root, comm);
  MPI_Bcast(half.contacts.data(), static_cast<int>(contacts * sizeof(post::ContactSummary)), MPI_BYTE, root,
            comm);
}

void add_errors(post::StandardErrors& sum, const post::StandardErrors& of) {
  if (!(of.batches > 0.0))
    return; // no contact
  sum.work_rate = std::hypot(sum.work_rate, of.work_rate);
  sum.friction_power = std::hypot(sum.friction_power, of.friction_power);
  sum.impact_rate = std::hypot(sum.impact_rate, of.impact_rate);
  const auto smaller = [](double& batches, double other) {
    batches = batches > 0.0 ? std::min(batches, other) : other;
  };
  smaller(sum.batches, of.batches);
  smaller(sum.work_rate_batches, of.work_rate_batches);
}

void compare_with_half(const std::vector<BuiltScene>& scenes, const std::vector<HalfRun>& halves,
                       results::RunResults& out) {
  results::Verification& v = out.verification.emplace();
  std::vector<post::ContactSummary> half(out.contact_summaries.size());
  post::StandardErrors errors;
  for (std::size_t s = 0; s < scenes.size(); ++s) {
    const transient::Report& report = halves[s].report;
    if (report.outcome != transient::Outcome::done) {
      v.failure = fmt::format("the run at half the step {} at t = {:.6g} s",
                              report.outcome == transient::Outcome::diverged ? "diverged" : "stopped",
                              report.end_time);
      out.warnings.push_back("transient.verify: " + v.failure);
      return;
    }
    v.step_max = std::max(v.step_max, report.counts.step_max);
    add_errors(errors, halves[s].errors_of_sums);
    for (std::size_t c = 0; c < scenes[s].contacts.size(); ++c)
      half[scenes[s].contacts[c]] = halves[s].contacts[c];
  }
  v.factor = post::critical_factor(post::compared_of_a_contact * half.size());
  v.sums = post::compare_sums(out.contact_summaries, out.errors_of_sums, half, errors, {out.accuracy});
  for (std::size_t c = 0; c < half.size(); ++c)
    v.contacts.push_back(post::compare(out.contact_summaries[c], half[c], {out.accuracy, v.factor}));
  const results::Disagreement found = results::disagreement(v, out.contacts);
  if (found.differ > 0)
    out.warnings.push_back(
        fmt::format("{} of {} statistics change with the step by more than their scatter and "
                    "transient.accuracy = {}: {}; take a smaller step, or a smaller accuracy",
                    found.differ, found.compared, out.accuracy, found.worst));
}

} // namespace fretwork::app
