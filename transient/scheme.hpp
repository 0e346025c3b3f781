// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// What all time schemes share: the record of a step that observers see, the energy ledger, the interface.
#pragma once
#include "contact/vec2.hpp"
#include "core/state_archive.hpp"
#include "transient/scene.hpp"
#include <cstdint>
#include <memory>
#include <span>
#include <string>

namespace fretwork::transient {

/// One contact at a step.
struct ContactState {
  double normal_force = 0.0;  ///< N, >= 0
  double ny = 0.0, nz = 0.0;  ///< normal, local axes
  contact::Vec2 friction;     ///< N, along x_loc and t = n x x_loc, on the node
  contact::Vec2 displacement; ///< m, tangential over the step
  double slid = 0.0;          ///< m, path with friction at its bound
  double friction_work = 0.0; ///< J over the step, by the slider
  double damper_work = 0.0;   ///< J over the step, by the normal and tangential dampers
  double approach = 0.0;      ///< m/s, speed towards the obstacle before the step's force acts; of a contact
                              ///< that has just opened: minus the speed at which it left
  bool slides = false;
  // Shares of normal_force, 1 but where a contact closes or opens between instants of splitting:
  double pressing_share = 1.0; ///< what presses the path `slid` in the mean
  double instant_share = 1.0;  ///< the force at the instant: integrals of squares of forces take it once
};

/// Normal and tangential force of a contact at an instant, N.
struct ContactForce {
  double normal;
  contact::Vec2 friction;
  double ny, nz; ///< normal, local axes
  bool slides;   ///< the friction bound is reached
};

/// Energy, J, at the instant of a record: load_work = stored - initial + modal_damping + contact_damping +
/// friction + residual.
struct Energy {
  double initial = 0.0;   ///< kinetic, strain and contact energy at t = 0
  double load_work = 0.0; ///< by loads and base motion
  double stored = 0.0;    ///< kinetic + strain + contact springs
  double modal_damping = 0.0;
  double contact_damping = 0.0; ///< normal and tangential dampers, what the positive part cuts, what a spring
                                ///< gives up after opening
  double friction = 0.0;        ///< Coulomb sliders
  double throughput = 0.0;      ///< initial + integral of |load power|: what the residual is measured against
  [[nodiscard]] double residual() const {
    return initial + load_work - stored - modal_damping - contact_damping - friction;
  }
};

/// What observers see of a step. Positions, forces and energies belong to `time`; with forces at instants (splitting) positions are those of
/// the mean over the step, and between flights and steps of other lengths they lean (splitting.cpp): they are for sums over time.
struct Record {
  double time = 0.0;
  double step =
      0.0; ///< s, the length of time this record stands for; 0: an instant between two laws, for no time
  const double* q =
      nullptr; ///< modal displacements, padded with zeros; null after Scheme::leave_out_positions, like uy and uz
  int contacts = 0;
  const double* uy =
      nullptr; ///< displacement of contact i along y_loc, m; padded with zeros to a multiple of 8
  const double* uz = nullptr;
  std::span<const ContactState> states;
  std::span<const int> active; ///< numbers of the contacts whose normal force is not zero
  std::span<const int> opened; ///< of those that had a force at the record before and have none now
  Energy energy;
};

/// What a scheme has done so far.
struct StepCounts {
  std::int64_t steps = 0;       ///< accepted
  std::int64_t rejected = 0;    ///< tried and made again with a smaller step
  std::int64_t evaluations = 0; ///< of the contact forces
  std::int64_t unconverged = 0; ///< accepted though the coupled contact forces missed their tolerance
  double step_min = 0.0, step_max = 0.0; ///< s, of the accepted ones
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
  /// Nobody looks at the positions of records: where it takes time to make them they may be null. Before the first `advance`.
  virtual void leave_out_positions() {}
  /// Advances to the next record: the first call gives the first one.
  virtual const Record& advance() = 0;
  /// Time of the record that `advance` will give, s; infinite after a failure.
  [[nodiscard]] virtual double next_time() const = 0;
  /// State at `time` between the last record and the next (before the first call: between 0 and the first).
  /// Arrays of n values.
  virtual void state_at(double time, double* q, double* v) = 0;
  /// Contact forces of the laws at such a time, where the scheme knows its motion there as well as at its records. Returns whether it does;
  /// else they are linear between the records. No allocation.
  virtual bool forces_at(double /*time*/, std::span<ContactForce> /*forces*/) { return false; }
  /// Modal force of the loads at a time, n values.
  virtual void load_at(double time, double* force) = 0;
  [[nodiscard]] virtual StepCounts counts() const = 0;
  /// Why the scheme cannot go on from its last record.
  [[nodiscard]] virtual StepFailure failure() const { return StepFailure::none; }
  /// What lasts from record to record: a scheme made anew for the same scene and step that restores it gives the same records, states
  /// and counts, bit for bit, as the one that saved it.
  virtual void visit(core::StateArchive& state) = 0;
};

enum class SchemeKind { splitting, collocation, euler, energy_conserving, devogelaere, runge_kutta_54 };
[[nodiscard]] std::string name_of(SchemeKind kind);

/// @param fastest  rad/s: faster modes that contacts move are made heavier (mass_scaling.hpp); 0: none
/// @param flight  the most steps that are made at once while no contact can meet its obstacle
[[nodiscard]] std::unique_ptr<Scheme> make_splitting(const Scene& scene, double step, double fastest = 0.0,
                                                     int flight = 1);
[[nodiscard]] std::unique_ptr<Scheme> make_collocation(const Scene& scene, double step);
[[nodiscard]] std::unique_ptr<Scheme> make_euler(const Scene& scene, double step);
[[nodiscard]] std::unique_ptr<Scheme> make_energy_conserving(const Scene& scene, double step);
[[nodiscard]] std::unique_ptr<Scheme> make_devogelaere(const Scene& scene, double step);
/// @param tolerance  of a step's error, in the energy norm   @param longest  s, step
[[nodiscard]] std::unique_ptr<Scheme> make_runge_kutta_54(const Scene& scene, double tolerance,
                                                          double longest);

} // namespace fretwork::transient

template <> inline constexpr bool fretwork::core::points_elsewhere<fretwork::transient::Record> = true;
