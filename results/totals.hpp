// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The run as a whole: what the structures' modes and transients give together.
#pragma once
#include "results/run_results.hpp"

namespace fretwork::results {

/// A mode among those of all structures.
struct ModeOf {
  std::size_t structure;
  Eigen::Index mode;
  double frequency; ///< Hz
};

/// All modes by ascending frequency, equal ones by structure; static modes apart.
[[nodiscard]] std::vector<ModeOf> sorted_modes(const std::vector<modal::Basis>& bases);
[[nodiscard]] std::vector<ModeOf> sorted_static_modes(const std::vector<modal::Basis>& bases);

/// Energies in J over the whole run: input + fluid = stored + modal_damping + contact_damping + friction + residual.
struct EnergyTotals {
  double initial = 0.0; ///< in the structure at t = 0
  double input = 0.0;   ///< initial + work of the loads
  double fluid = 0.0;   ///< work of forces that depend on the motion
  double stored = 0.0, modal_damping = 0.0, contact_damping = 0.0, friction = 0.0;
  double residual_relative = 0.0; ///< the largest of the structures (not finite where one of them is not)
  [[nodiscard]] double residual() const {
    return input + fluid - stored - modal_damping - contact_damping - friction;
  }
};

/// The longest step times what it has to resolve (transient/step_rule.hpp); the largest of the structures.
struct Resolution {
  double contact = 0.0, stick = 0.0, structure = 0.0, damper = 0.0, highest_mode = 0.0;
};

struct TransientTotals {
  std::string scheme; ///< names joined by ", " where structures differ
  std::int64_t steps = 0, rejected = 0, evaluations = 0, unconverged = 0;
  double step_min = 0.0, step_max = 0.0; ///< s
  std::string step_reason;               ///< of the smallest step
  std::string scheme_reason;             ///< of that run's scheme; empty where it was given
  double contact_frequency = 0.0;        ///< rad/s, the highest
  Resolution resolution;
  std::int64_t scaled_modes = 0; ///< made heavier (transient/modes/mass_scaling.hpp)
  double fastest_hz = 0.0;       ///< Hz, the lowest frequency that they were given; 0: none
  bool diverged = false;         ///< any of them
  double end_time = 0.0;         ///< s, the earliest
  EnergyTotals energy;
};

/// @param transients at least one
[[nodiscard]] TransientTotals add_up(const std::vector<TransientFacts>& transients);

/// Warnings of the run and of the choice of steps; its notes. Those that say the same are one (grouped_messages.hpp).
[[nodiscard]] std::vector<std::string> all_warnings(const RunResults& results);
[[nodiscard]] std::vector<std::string> all_notes(const RunResults& results);

} // namespace fretwork::results
