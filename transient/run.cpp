// SPDX-License-Identifier: GPL-3.0-or-later
#include "transient/run.hpp"
#include "transient/collocation/collocation.hpp"
#include "transient/conserving/energy_conserving.hpp"
#include "transient/explicit/explicit_schemes.hpp"
#include "transient/splitting/replays.hpp"
#include "transient/splitting/splitting.hpp"
#include <algorithm>
#include <cmath>
#include <limits>

namespace fretwork::transient {
namespace {

/// A run whose energy residual passes this many times all the energy put in is unstable: physics cannot
/// recover from it.
constexpr double divergence_threshold = 100.0;
/// Records that it may last: a pulse that ends a rest gives its energy before all of its work is counted.
constexpr int passing = 4;
/// Of a fixed step, below all the parts that schemes cut it into: what the end of a run is told by.
constexpr double least_part = 1.0 / 1024.0;

std::unique_ptr<Scheme> make_splitting_of(const Scene& scene, const StepChoice& c) {
  const SplittingOptions options{c.fastest, c.macro_steps, c.parts};
  if (!(c.replay > 0.0))
    return make_splitting(scene, c.step, options);
  SplittingOptions finer = options;
  if (options.longest > 1) // where the scene allows macro-steps
    finer.longest *= 2;
  finer.fastest *= 2.0;
  return make_replayed(
      make_replayable_splitting(scene, c.step, options),
      make_replayable_splitting(scene, 0.5 * c.step, finer),
      {c.accuracy, c.replay, static_cast<int>(scene.contacts.size()), c.parts, most_refined * c.parts});
}

/// Whether the scheme takes contacts by structures; others take them over all modes.
bool takes_structures(const Scene& scene, SchemeKind scheme) {
  return scheme == SchemeKind::splitting ||
         std::all_of(scene.contacts.begin(), scene.contacts.end(),
                     [](const ContactPoint& point) { return point.modes.empty(); });
}

std::unique_ptr<Scheme> make_scheme(const Scene& scene, const StepChoice& choice) {
  if (!takes_structures(scene, choice.scheme))
    return make_scheme(over_all_modes(scene), choice);
  switch (choice.scheme) {
  case SchemeKind::splitting:
    return make_splitting_of(scene, choice);
  case SchemeKind::collocation:
    return make_collocation(scene, choice.step);
  case SchemeKind::euler:
    return make_euler(scene, choice.step);
  case SchemeKind::energy_conserving:
    return make_energy_conserving(scene, choice.step);
  case SchemeKind::devogelaere:
    return make_devogelaere(scene, choice.step);
  case SchemeKind::runge_kutta_54:
    return make_runge_kutta_54(scene, choice.tolerance, choice.step);
  }
  return nullptr;
}

} // namespace

/// Serves the output instants that lie before the next record.
class OutputQueue {
public:
  OutputQueue(const Scene& scene, Sampler* sampler, const OutputGrid& grid)
      : sampler_(sampler), grid_(grid), size_(static_cast<std::size_t>(scene.system.size())), q_(size_),
        v_(size_), load_(size_), last_(scene.contacts.size()), now_(last_), mixed_(last_) {
    constexpr std::size_t usually_waiting = 64; // instants between records; of more memory is taken once
    if (sampler)
      waiting_.reserve(usually_waiting * size_);
    else
      grid_.count = 0;
  }

  /// States at the instants before `limit`; their forces wait for the next record where the scheme does not give them.
  void states(Scheme& scheme, double limit) {
    first_ = next_;
    waiting_.clear();
    while (next_ < grid_.count && time(next_) < limit) {
      scheme.state_at(time(next_), q_.data(), v_.data());
      sampler_->state(next_, time(next_), q_.data(), v_.data());
      scheme.load_at(time(next_), load_.data()); // with the forces of the motion at that state
      if (scheme.forces_at(time(next_), mixed_)) {
        sampler_->forces(next_, time(next_), load_.data(), mixed_);
        first_ = next_ + 1;
      } else {
        waiting_.insert(waiting_.end(), load_.begin(), load_.end());
      }
      ++next_;
    }
  }

  void forces(const Record& record) {
    if (first_ == next_)
      return;
    fresh(record);
    for (std::int64_t j = first_; j < next_; ++j)
      serve(j, last_time_ < 0.0 ? 1.0 : (time(j) - last_time_) / (record.time - last_time_));
  }

  /// Keeps the forces of a record that output instants will follow before the one after it.
  void keep(const Record& record, double limit) {
    if (grid_.count == 0)
      return;
    last_time_ = record.time;
    if (next_ < grid_.count && time(next_) < limit) {
      fresh(record);
      last_.swap(now_);
    }
  }

  /// After the last record: the instants up to the end, their forces between it and one more, which nobody
  /// else sees.
  void finish(Scheme& scheme) {
    states(scheme, std::numeric_limits<double>::infinity());
    if (first_ < next_)
      forces(scheme.advance());
  }

  /// Between two records.
  void visit(core::StateArchive& state) { state(next_, last_time_, last_); }

private:
  [[nodiscard]] double time(std::int64_t j) const { return static_cast<double>(j) * grid_.every; }

  void fresh(const Record& record) {
    for (std::size_t c = 0; c < now_.size(); ++c) {
      const ContactState& s = record.states[c];
      now_[c] = {s.normal_force, s.friction, s.axes, s.slides};
    }
  }

  void serve(std::int64_t j, double share) {
    const auto at = static_cast<std::size_t>(j - first_) * size_;
    sampler_->forces(j, time(j), waiting_.data() + at, between(share));
  }

  std::span<const ContactForce> between(double share) {
    for (std::size_t c = 0; c < now_.size(); ++c) {
      const ContactForce &a = last_[c], &b = now_[c];
      const ContactForce& direction = b.normal > 0.0 ? b : a;
      mixed_[c] = {a.normal + share * (b.normal - a.normal), a.friction + share * (b.friction - a.friction),
                   direction.axes, direction.slides};
    }
    return mixed_;
  }

  Sampler* sampler_;
  OutputGrid grid_;
  std::size_t size_;
  std::vector<double> q_, v_, load_;
  std::vector<double> waiting_; ///< loads of the instants from first_ on, whose contact forces follow
  std::vector<ContactForce> last_, now_, mixed_;
  std::int64_t first_ = 0, next_ = 0;
  double last_time_ = -1.0;
};

OutputGrid output_grid(double duration, double every) {
  return {every, static_cast<std::int64_t>(std::floor(duration / every * (1.0 + 1e-12) + 1e-9)) + 1};
}

// A fixed step covers whole steps, so that round-off of the time adds none; a scheme may have cut them into records of their own.
Run::Run(const Scene& scene, const StepChoice& choice, std::span<Observer* const> observers, Sampler* sampler,
         const OutputGrid& grid)
    : observers_(observers), sampler_(sampler), scheme_(make_scheme(scene, choice)),
      outputs_(std::make_unique<OutputQueue>(scene, sampler, grid)),
      end_(choice.steps > 0 ? (static_cast<double>(choice.steps) - least_part) * choice.step
                            : scene.duration) {
  if (scheme_->failure() != StepFailure::none)
    report_.outcome = Outcome::step_failed;
}

Run::~Run() = default;

/// What observers, and the report after the last record, ask for.
void Run::complete(const Record& record, double next) {
  RecordParts parts{false, next >= end_};
  for (const Observer* observer : observers_) {
    const RecordParts asked = observer->parts_of(record, next);
    parts.modes = parts.modes || asked.modes;
    parts.energies = parts.energies || asked.energies;
  }
  if (parts.modes || parts.energies)
    scheme_->complete(parts);
}

bool Run::advance(std::int64_t records) {
  const auto goes_on = [&](double next) { return report_.outcome == Outcome::done && next < end_; };
  const Record* last = nullptr;
  double next = scheme_->next_time();
  for (std::int64_t i = 0; i < records && goes_on(next); ++i) {
    outputs_->states(*scheme_, next);
    const Record& record = scheme_->advance();
    next = scheme_->next_time(); // infinite where the scheme fails: the loop ends
    last = &record;
    outputs_->forces(record);
    outputs_->keep(record, next + 0.5 * record.step); // the last output may lie at the end
    const double residual = std::abs(record.energy.residual());
    largest_residual_ = std::max(largest_residual_, residual);
    largest_energy_scale_ = std::max(largest_energy_scale_, record.energy.scale);
    complete(record, next);
    for (Observer* observer : observers_)
      observer->step(record);
    diverged_records_ = residual <= divergence_threshold * largest_energy_scale_ ? 0 : diverged_records_ + 1;
    if (!std::isfinite(residual + record.energy.scale) || diverged_records_ > passing) {
      report_.outcome = Outcome::diverged;
      scheme_->complete({false, true});
    }
    ++report_.records;
  }
  if (last) {
    report_.end_time = last->time;
    report_.energy = last->energy;
  }
  if (report_.outcome == Outcome::done && scheme_->failure() != StepFailure::none)
    report_.outcome = Outcome::step_failed;
  return goes_on(next);
}

Report Run::finish() {
  Report report = report_;
  report.counts = scheme_->counts();
  report.failure = scheme_->failure();
  if (report.outcome == Outcome::done)
    outputs_->finish(*scheme_);
  report.residual_relative = largest_energy_scale_ > 0.0 ? largest_residual_ / largest_energy_scale_ : 0.0;
  return report;
}

void Run::visit(core::StateArchive& state) {
  state(*scheme_, *outputs_, report_, largest_residual_, largest_energy_scale_, diverged_records_);
  for (Observer* observer : observers_)
    state(*observer);
  if (sampler_)
    state(*sampler_);
}

Report run(const Scene& scene, const StepChoice& choice, std::span<Observer* const> observers,
           Sampler* sampler, const OutputGrid& grid) {
  Run all(scene, choice, observers, sampler, grid);
  all.advance(std::numeric_limits<std::int64_t>::max());
  return all.finish();
}

} // namespace fretwork::transient
