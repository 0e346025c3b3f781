// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Displacement and velocity of an imposed motion whose acceleration is given: the exact double integral of the function of time,
///     s'(t) = s'(0) + int_0^t a,    s(t) = s(0) + s'(0) t + int_0^t (t - x) a(x) dx.
/// Constants and harmonics in closed form; tables (linear pieces) and random signals (the cubic pieces that the loads follow) piece by
/// piece, from sums made before the run.
#pragma once
#include "signals/time_function.hpp"
#include <vector>

namespace fretwork::signals {

/// A motion that is imposed: displacement s(t) with s'' = acceleration, s'(0) and s(0).
struct PrescribedMotion {
  TimeFunction acceleration;  ///< m/s2
  double velocity0 = 0.0;     ///< m/s
  double displacement0 = 0.0; ///< m
};

/// The motion whose displacement follows a function of time. A table is taken by a shape-preserving curve through its rows that is at rest
/// at both ends (table_curve.hpp): its second derivative is linear between them and may jump at them.
/// @param displacement  m; not random, a table without jumps
[[nodiscard]] PrescribedMotion motion_of_displacement(const TimeFunction& displacement);

/// s' as a function of time that loads may follow. The acceleration is one that a study gives, no integral.
[[nodiscard]] TimeFunction velocity_of(const PrescribedMotion& motion);

/// s and s' at an instant.
struct MotionState {
  double displacement = 0.0, velocity = 0.0;
};

class MotionSignal {
public:
  /// @param duration  s, of the run
  MotionSignal(const PrescribedMotion& motion, double duration);
  /// At a time within the run. No allocation.
  [[nodiscard]] MotionState operator()(double time) const;
  /// s'' at a time within the run, from the right at a jump. No allocation.
  [[nodiscard]] double acceleration(double time) const { return signal_(time); }
  /// Of a random signal: the length of its pieces, s. Else 0.
  [[nodiscard]] double grid_step() const { return signal_.grid_step(); }

private:
  /// a = c0 + c1 x + c2 x^2 + c3 x^3 from the start of a piece, x = (t - start)/length.
  struct Piece {
    double start, length;
    double c0, c1, c2, c3;
    MotionState before; ///< at its start
    [[nodiscard]] MotionState at(double time) const;
  };
  void cut(const Table& table);
  void append(double start, double length, double first, double last);
  [[nodiscard]] Piece grid_piece(std::size_t number) const;

  PrescribedMotion motion_;
  Signal signal_;
  std::vector<Piece> pieces_;        ///< of a table, one after the other from t = 0
  std::vector<MotionState> at_grid_; ///< of a random signal, at the starts of its pieces
};

} // namespace fretwork::signals
