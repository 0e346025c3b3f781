// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The run of a transient: the loop over steps, what watches it and what samples it.
#pragma once
#include "transient/step_rule.hpp"
#include <span>

namespace fretwork::transient {

/// Sees every step. Must not allocate or throw.
class Observer {
public:
  virtual ~Observer() = default;
  virtual void step(const Record& record) = 0;
  /// What it asks of a record that comes next; of this one only its times are known.   @param next  s, time of the record after it
  [[nodiscard]] virtual RecordParts parts_of(const Record& /*record*/, double /*next*/) const { return {}; }
  /// What it has seen so far.
  virtual void visit(core::StateArchive& state) = 0;
};

/// An observer of times and contacts alone.
class ContactObserver : public Observer {
  [[nodiscard]] RecordParts parts_of(const Record&, double) const final { return {false, false}; }
};

/// Receives the output instants 0, every, 2 every ... Must not allocate or throw.
class Sampler {
public:
  virtual ~Sampler() = default;
  /// State at output `index`.
  virtual void state(std::int64_t index, double time, const double* q, const double* v) = 0;
  /// Afterwards, for the same output: modal force of the loads, and the contacts' forces (those of the scheme
  /// at the instant where it gives them, Scheme::forces_at, else linear between the records around it).
  virtual void forces(std::int64_t index, double time, const double* load,
                      std::span<const ContactForce> contacts) = 0;
  /// What it has received so far.
  virtual void visit(core::StateArchive& state) = 0;
};

/// The output instants of a run: from the steps' own continuous extension, the step is never changed for
/// them.
struct OutputGrid {
  double every = 0.0;     ///< s, > 0
  std::int64_t count = 0; ///< instants, the one at t = 0 included
};
[[nodiscard]] OutputGrid output_grid(double duration, double every);

enum class Outcome { done, diverged, step_failed };

struct Report {
  Outcome outcome = Outcome::done;
  double end_time = 0.0;    ///< s: of the last record
  std::int64_t records = 0; ///< seen by the observers
  StepCounts counts;
  StepFailure failure = StepFailure::none;
  Energy energy;                  ///< at the last step
  double residual_relative = 0.0; ///< largest |residual| over largest scale
};

class OutputQueue;

/// A run that goes on in portions, so that its state can be saved between two of them. A run made anew from the same arguments that
/// restores the state gives the same bytes as one that was never left.
class Run {
public:
  /// All arguments must live longer; `sampler` may be null.
  Run(const Scene& scene, const StepChoice& choice, std::span<Observer* const> observers, Sampler* sampler,
      const OutputGrid& grid);
  ~Run();
  Run(const Run&) = delete;
  Run& operator=(const Run&) = delete;

  /// Up to `records` more records. No allocation, no exception and no output. Returns whether there are more to come.
  bool advance(std::int64_t records);
  [[nodiscard]] double time() const { return report_.end_time; }
  /// After the last record: what was asked for up to the end. To be called once.
  [[nodiscard]] Report finish();
  /// So far, contact by contact; empty: not measured.
  [[nodiscard]] std::vector<StepError> step_errors() const { return scheme_->step_errors(); }
  /// With all that its scheme, observers and sampler know.
  void visit(core::StateArchive& state);

private:
  void complete(const Record& record, double next);

  std::span<Observer* const> observers_;
  Sampler* sampler_;
  std::unique_ptr<Scheme> scheme_;
  std::unique_ptr<OutputQueue> outputs_;
  double end_; ///< s: a record at or after it is not made
  Report report_;
  double largest_residual_ = 0.0, largest_energy_scale_ = 0.0;
  int diverged_records_ = 0; ///< in a row
};

/// Runs the scene with the step chosen, from start to end.
/// Diverged: the energy is not finite, or has grown far beyond all that was put in. Step failed: the scheme
/// could not meet its tolerance.
[[nodiscard]] Report run(const Scene& scene, const StepChoice& choice, std::span<Observer* const> observers,
                         Sampler* sampler, const OutputGrid& grid);

} // namespace fretwork::transient
