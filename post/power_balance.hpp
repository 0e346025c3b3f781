// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Mean powers of the terms of the energy balance over a window, with standard errors from batch means:
///     loads + fluid = stored + modal damping + contact damping + friction + residual
/// A mean power is the change of its energy over the length of the window. Records carry the energies at their ends: the window begins
/// where the last record before `from` ends.
#pragma once
#include "post/batch_means.hpp"
#include "transient/run.hpp"
#include <array>
#include <limits>

namespace fretwork::post {

struct MeanPower {
  double mean = 0.0; ///< W
  double error =
      std::numeric_limits<double>::quiet_NaN(); ///< W, standard error; not a number: a short window
};

/// Of a window; all 0 where there is none.
struct PowerBalance {
  MeanPower loads; ///< by loads, base motion and obstacles that move
  MeanPower fluid; ///< by forces that depend on the motion, of either sign
  MeanPower modal_damping, contact_damping, friction;
  MeanPower stored; ///< growth of kinetic and strain energy and of the springs of contacts
};

class PowerStatistics final : public transient::Observer {
public:
  /// @param from  start of the window, s
  explicit PowerStatistics(double from);
  void step(const transient::Record& record) override;
  /// Energies where the window begins and where a batch ends.
  [[nodiscard]] transient::RecordParts parts_of(const transient::Record& record, double next) const override {
    return {false, record.time < from_ ? next >= from_ : ends_.due(time_ + record.step)};
  }
  void visit(core::StateArchive& state) override { state(seen_, time_, before_, now_, ends_); }
  [[nodiscard]] PowerBalance balance() const;

private:
  static constexpr std::size_t terms = 6;

  void write_sums(double* row) const;

  double from_;
  bool seen_ = false;
  double time_ = 0.0;                          ///< length of the window so far, s
  std::array<double, terms> before_{}, now_{}; ///< J, at the beginning of the window, and now
  BatchEnds ends_;
};

} // namespace fretwork::post
