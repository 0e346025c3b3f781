// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// What all time schemes share: the record of a step that observers see, the energy balance, the interface.
#pragma once
#include "contact/normal_interval.hpp"
#include "contact/plane.hpp"
#include "core/state_archive.hpp"
#include "transient/scene/scene.hpp"
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace fretwork::transient {

/// One contact over the step of a record.
struct ContactState {
  double normal_force = 0.0;    ///< N, mean over the step, >= 0
  contact::ContactAxes axes;    ///< of `normal_force` and `friction`; none: open
  contact::Vec2 friction;       ///< N, mean over the step, along x_loc and t = n x x_loc, on the node
  contact::Vec2 displacement;   ///< m, tangential, while the contact is closed
  double slid = 0.0;            ///< m, path with friction at its bound
  double friction_work = 0.0;   ///< J over the step, by the slider
  double damper_work = 0.0;     ///< J over the step, by the normal and tangential dampers
  double approach = 0.0;        ///< m/s, towards the obstacle: speed at which the contact closed, if it did
  bool slides = false;          ///< at the end of the step
  double closed = 0.0;          ///< share of the step with a normal force
  double normal_square = 0.0;   ///< N2, mean over the step
  double friction_square = 0.0; ///< N2, likewise
  double peak = 0.0;            ///< N, largest normal force
  double friction_peak = 0.0; ///< N, largest length of the friction, of schemes that know it within the step
  double deepest =
      0.0; ///< m, largest penetration beside a normal damper, of schemes that know it between positions
  double sliding = 0.0;   ///< share of the step in which it slides
  double wear_work = 0.0; ///< J, integral of F_N |v_T| while it slides
  double departure = 0.0; ///< m/s, away from the obstacle: speed at which the contact opened, if it did
  int touches = 0;        ///< how often it closed in the step
  double closed_at = 0.0, opened_at = 0.0; ///< shares of the step before it closed and opened last, if it did

  /// Of schemes that know one force in the step: what follows from its mean, where it acts for a share of the step.
  /// @param touched  the contact closed in the step
  void act_for(double share, bool touched) {
    closed = share;
    normal_square = normal_force * normal_force / share;
    friction_square = dot(friction, friction) / share;
    peak = normal_force;
    sliding = slides ? share : 0.0;
    wear_work = normal_force * slid / share;
    touches = touched ? 1 : 0;
  }
  /// Force on the node along the local axes, N.
  [[nodiscard]] double force_y() const { return axes.y(normal_force, friction.t); }
  [[nodiscard]] double force_z() const { return axes.z(normal_force, friction.t); }
  void act_throughout(bool touched) { act_for(1.0, touched); }
};

/// The force of a contact over a part of a step, of schemes that move contacts within steps.
struct ForcePiece {
  int contact = 0;
  double from = 0.0, to = 0.0;      ///< shares of the step between which it acts
  contact::ParabolicForce normal;   ///< N
  contact::ParabolicForce friction; ///< N, length of the vector: of that at both ends and of its mean
  double friction_peak = 0.0;       ///< N: a piece of stick and slip is below its parabola
  /// N, at a share of the piece.
  [[nodiscard]] double friction_at(double share) const {
    return std::clamp(friction.at(share), 0.0, friction_peak);
  }
};

/// Normal and tangential force of a contact at an instant, N.
struct ContactForce {
  double normal;
  contact::Vec2 friction;
  contact::ContactAxes axes;
  bool slides; ///< the friction bound is reached
  /// On the node along the local axes, N.
  [[nodiscard]] double y() const { return axes.y(normal, friction.t); }
  [[nodiscard]] double z() const { return axes.z(normal, friction.t); }
};

/// Energy, J, at a record: load_work + fluid_work = stored - initial + modal_damping + contact_damping +
/// friction + residual.
struct Energy {
  double initial = 0.0;    ///< kinetic, strain and contact energy at t = 0
  double load_work = 0.0;  ///< by loads and base motion
  double fluid_work = 0.0; ///< by forces that depend on the motion, of either sign
  double stored = 0.0;     ///< kinetic + strain + contact springs
  double modal_damping = 0.0;
  double contact_damping = 0.0; ///< normal and tangential dampers, what the positive part cuts, what a spring
                                ///< gives up after opening
  double friction = 0.0;        ///< Coulomb sliders
  double scale = 0.0;           ///< initial + integral of |load power|: what the residual is measured against
  void start(double energy) { initial = scale = stored = energy; }
  /// By modes, contacts and a fluid that damps.
  [[nodiscard]] double dissipated() const {
    return modal_damping + contact_damping + friction + std::max(0.0, -fluid_work);
  }
  [[nodiscard]] double residual() const {
    return initial + load_work + fluid_work - stored - modal_damping - contact_damping - friction;
  }
};

/// What observers see of a step. Positions belong to `time`; of schemes whose forces act over steps `time` is the middle of a step, and energies of
/// splitting are those at its end.
struct Record {
  double time = 0.0;
  double step =
      0.0; ///< s, the length of time this record stands for; 0: an instant between two laws, for no time
  const double* q =
      nullptr; ///< modal displacements, padded with zeros; null where left out (Scheme::complete)
  int contacts = 0;
  const double* uy =
      nullptr; ///< displacement of contact i along y_loc, m; padded with zeros to a multiple of 8
  const double* uz = nullptr;
  std::span<const ContactState> states;
  std::span<const int> active; ///< numbers of the contacts with a normal force in the step
  std::span<const int> opened; ///< of those that opened in it, or since the record before
  std::span<const ForcePiece>
      pieces; ///< of the contacts in `active`, those of each in time; none: forces are known as means over steps
  Energy energy;
};

/// What of a record takes work to find.
struct RecordParts {
  bool modes = true;    ///< q
  bool energies = true; ///< in the terms of `energy`; the residual is right without
};

/// What a scheme has done so far.
struct StepCounts {
  std::int64_t steps = 0;       ///< accepted
  std::int64_t rejected = 0;    ///< tried and made again with a smaller step
  std::int64_t evaluations = 0; ///< of the contact forces
  std::int64_t unconverged = 0; ///< in which forces of contacts that move each other kept on changing
  double step_min = 0.0, step_max = 0.0; ///< s, of the accepted ones
  void add(double length) {
    step_min = steps == 0 ? length : std::min(step_min, length);
    step_max = std::max(step_max, length);
    ++steps;
  }
};

/// Statistics whose errors by the step replays measure (splitting/replays.hpp), summed over time.
enum ReplayedFigure : std::size_t {
  replayed_work,        ///< J, integral of F_N |v_T| while the contact slides
  replayed_friction,    ///< J, by the slider
  replayed_square,      ///< N2 s, integral of F_N^2
  replayed_impulse,     ///< N s, integral of F_N
  replayed_closed_time, ///< s
  replayed_impacts,
  replayed_figures
};
/// Relative error of the statistic over that of what it sums: the rms force is a root.
constexpr double statistic_share(std::size_t figure) { return figure == replayed_square ? 0.5 : 1.0; }

/// Of one contact.
struct StepError {
  using Figures = std::array<double, replayed_figures>;
  Figures sums{};    ///< over the run, by the times that were replayed, over their length
  Figures errors{};  ///< of these sums, by the step
  Figures spreads{}; ///< standard errors of `errors`
  int parts = 0;     ///< intervals of a step at the end of the run
};

/// Why no further step can be made.
enum class StepFailure {
  none,
  tolerance, ///< no step that the time can resolve meets the tolerance
  contacts,  ///< the equations of the contacts were not solved, however small the step
};
[[nodiscard]] std::string name_of(StepFailure failure);

/// A time scheme set up for one scene. It advances from record to record; no allocation after construction. After `advance` has given
/// the record at t_k, the state is known at every instant up to `next_time`: a scheme whose records stand at the ends of its steps has
/// then made the step that follows the record.
class Scheme {
public:
  virtual ~Scheme() = default;
  /// Advances to the next record: the first call gives the first one.
  virtual const Record& advance() = 0;
  /// Finds these parts of the record that `advance` has given last, where it left them out: q null, energies of modes that forces of motion couple
  /// without damping and fluid. No allocation.
  virtual void complete(const RecordParts& /*parts*/) {}
  /// Time of the record that `advance` will give, s; infinite after a failure.
  [[nodiscard]] virtual double next_time() const = 0;
  /// State at `time` between the last record and the next (before the first call: between 0 and the first).
  /// Arrays of n values.
  virtual void state_at(double time, double* q, double* v) = 0;
  /// Contact forces of the laws at such a time, where the scheme knows its motion there as well as at its records. Returns whether it does;
  /// else they are linear between the records. No allocation.
  virtual bool forces_at(double /*time*/, std::span<ContactForce> /*forces*/) { return false; }
  /// Modal force of the loads at a time, n values, and of forces that depend on the motion: those of the `state_at` before it.
  virtual void load_at(double time, double* force) = 0;
  [[nodiscard]] virtual StepCounts counts() const = 0;
  /// Errors by the step so far, measured by replays, contact by contact; empty: not measured.
  [[nodiscard]] virtual std::vector<StepError> step_errors() const { return {}; }
  /// Why the scheme cannot go on from its last record.
  [[nodiscard]] virtual StepFailure failure() const { return StepFailure::none; }
  /// What lasts from record to record: a scheme made anew for the same scene and step that restores it gives the same records, states
  /// and counts, bit for bit, as the one that saved it.
  virtual void visit(core::StateArchive& state) = 0;
};

enum class SchemeKind { splitting, collocation, euler, energy_conserving, devogelaere, runge_kutta_54 };
constexpr std::size_t scheme_count = static_cast<std::size_t>(SchemeKind::runge_kutta_54) + 1; ///< the last
[[nodiscard]] std::string name_of(SchemeKind kind);

} // namespace fretwork::transient

template <> inline constexpr bool fretwork::core::points_elsewhere<fretwork::transient::Record> = true;
