// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The error of a run by its step, measured while it goes on. From time to time a second scheme of half the step and interval, with heavier modes
/// (modes/mass_scaling.hpp) at twice the frequency, takes over the state of the running one and replays what follows, over a few periods of the
/// contacts: too short for both to part by chaos. Let s be what a statistic of a contact sums over the replayed times and d by how much a
/// replay's part of it differs. Then
///     error = 2 d/s +- 2 (sum of d^2)^1/2/s
/// the error that the step makes in that time (of impacts, which are counted, with one more in the sum of d^2); statistics of long runs may keep less of it, for a contact that slips too far sticks the longer.
/// 2: of errors of order 1 half the interval takes away a half; of higher orders more, and the error told is too large. Contacts whose error
/// exceeds three quarters of the accuracy by two standard errors are moved in twice as many intervals from then on.
#pragma once
#include "transient/splitting/splitting.hpp"

namespace fretwork::transient {

/// A scheme that can go on from where another one of the same scene is.
class Replayable : public Scheme {
public:
  /// Goes on after the last step that `running` has made, which is of the same class and has a whole multiple of this one's step; its modes may have
  /// other masses; energies then are not those of the record. No allocation.
  /// Returns the time from which on its records are to come, s.
  virtual double continue_from(const Replayable& running) = 0;
  /// From now on a contact moves in so many intervals a step, >= 1. No allocation.
  virtual void divide(int contact, int parts) = 0;
};

struct ReplayOptions {
  double accuracy; ///< of statistics
  double length;   ///< s, of a replay
  int contacts;    ///< of the scene
  int parts;       ///< intervals of a step of the running scheme at its start
  int most_parts;  ///< and at most
};

/// As make_splitting.
[[nodiscard]] std::unique_ptr<Replayable> make_replayable_splitting(const Scene& scene, double step,
                                                                    const SplittingOptions& options);
/// @param running  whose records are those of the whole   @param finer  of half its step
[[nodiscard]] std::unique_ptr<Scheme> make_replayed(std::unique_ptr<Replayable> running,
                                                    std::unique_ptr<Replayable> finer,
                                                    const ReplayOptions& options);

} // namespace fretwork::transient
