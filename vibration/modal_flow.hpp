// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The exact motion of the modes over a step of the splitting scheme, under loads and contact forces that are linear in time within it
/// (oscillator.hpp; coupled_flow.hpp where a damping matrix or forces of motion couple modes; those that diagonal_flow.hpp moves are not among
/// them, but for linear_flow.hpp). Steps may have several lengths, whole multiples of the shortest.
///
/// Forces of motion: where such a force acts on one mode alone, that has another stiffness and damping. Their works, and displacements within a step
/// for records, are those of the linear force in time that moves each mode by itself to where it is at the end: exact in the energy of the modes,
/// to (w h)^4/720 in what of it the fluid has brought and what the damping taken; w the frequency of the mode, for w h < 3 (above it all is damping).
#pragma once
#include "core/state_archive.hpp"
#include "vibration/coupled_flow.hpp"
#include "vibration/load_sum.hpp"
#include <array>

namespace fretwork::vibration {

/// A force on the modes over a step, from mean - slope at its start to mean + slope at its end, padded. It is that of forces on contacts; of what these bend
/// within the step it has the effect at its end (BentForce).
struct ModalForce {
  kernels::Array mean, slope;
  void visit(core::StateArchive& state) { state(mean, slope); }
};

/// What a force that bends within the step, by Legendre's polynomials of degree 2 and 3 (oscillator.hpp), is to each mode: shares of its coefficients.
using BentForce = std::array<ModalForce, 2>;

class ModalFlow {
public:
  /// @param forced  its system, loads and duration   @param lengths  of steps in numbers of `step`, s; only 1 where a damping matrix couples modes
  ModalFlow(const ForcedSystem& forced, double step, const std::vector<int>& lengths);

  /// Padded; of arrays that are longer the modes are the first.
  struct State {
    kernels::Array q, v, z; ///< z: what forces of motion remember
    void visit(core::StateArchive& state) {
      state(q, v);
      if (!z.empty())
        state(z);
    }
  };
  struct Sums {
    double load_work = 0.0, contact_work = 0.0; ///< J, of the loads and of the other force, over the step
    double energy = 0.0;                        ///< J, of the modes at its end
    double fluid_work = 0.0;                    ///< J, of forces that depend on the motion
  };
  /// Sets z for the start of a run.
  void start(State& state) const { state.z.assign(states_.size(), 0.0); }
  /// Modal forces of the loads in a step (LoadSum::in_step); they stay where there are none. No allocation.   @param bend  null: not asked for
  void load_in_step(double start, double end, kernels::Array& load0, kernels::Array& load1, double* bend);
  /// Whether any load bends within a step.
  [[nodiscard]] bool loads_bend() const { return loads_.bends(); }
  /// The modes over `length` steps under the loads load0 to load1, alone. No allocation.
  Sums move(int length, const State& from, const kernels::Array& load0, const kernels::Array& load1,
            State& to);
  /// Over one step, with the force of a mean and a slope (ModalForce). No allocation.
  Sums push(const State& from, const kernels::Array& load0, const kernels::Array& load1,
            const kernels::Array& mean, const kernels::Array& slope, State& to);
  /// Displacements in the middle of the step moved last (force null: none). No allocation.
  void middle(int length, const State& from, const kernels::Array& load0, const kernels::Array& load1,
              const ModalForce* force, kernels::Array& q);
  /// By how much the mean of each displacement over one step under a constant force exceeds that of the cubic through both its ends: 0 of modes that are
  /// coupled, and of those that are slow in the step. No allocation.   @param bow  padded
  void bow(const State& from, const kernels::Array& load0, const kernels::Array& load1,
           const kernels::Array& force, kernels::Array& bow) const;
  /// Whether any mode has one.
  [[nodiscard]] bool has_bow() const { return has_bow_; }
  /// Of each mode over one step the linear forces that leave it where bent ones do (linear_for_bends): 0 of modes below w h = 0.1 and of those
  /// above highest_followed; of modes that a damping matrix couples as if they were alone.   @param by  padded
  void linear_for_bends(BentForce& by) const;
  /// h^2 of modes up to highest_followed, of others 0, s2, padded: what a bend within the step displaces modes by goes with it.
  [[nodiscard]] kernels::Array squares_of_followed() const;
  [[nodiscard]] double energy(const State& state) const;
  /// Numbers of modes, padded.
  [[nodiscard]] int padded() const { return static_cast<int>(k_.size()); }
  /// State at a time after the start of a step of `duration`, as `move` with a force (null: none); n values each. No allocation.
  void inside(double time, double duration, const State& from, const kernels::Array& load0,
              const kernels::Array& load1, const ModalForce* force, double* q, double* v);
  /// Modal force of the loads at an instant, n values.
  void load_at(double time, double* force) { loads_.observe(time, force); }
  /// Adds the forces of motion where `inside` was last, n values. No allocation.
  void add_motion_forces(double* force) const;
  /// Displacement and velocity of the modes after one step from rest under a constant force, padded arrays.
  void response(const double* force, double* moved, double* velocity);

private:
  [[nodiscard]] std::size_t place(int length) const;
  [[nodiscard]] bool fed() const { return !system_.motion.empty(); }
  void make_tables(double h);
  void copy_modes(const State& from, State& to) const;
  /// Over `length` steps under the loads and a force.
  Sums move_all(int length, const State& from, const kernels::Array& load0, const kernels::Array& load1,
                const kernels::Array& mean, const kernels::Array& slope, State& to);
  void move_coupled(const State& from, const kernels::Array& load0, const kernels::Array& load1,
                    const kernels::Array& mean, const kernels::Array& slope, State& to, Sums& sums);
  void move_remembering(int length, const kernels::Array& load0, const kernels::Array& load1,
                        const kernels::Array& mean, const kernels::Array& slope, State& to);
  [[nodiscard]] Sums own_works(std::size_t place, const State& from, const kernels::Array& load0,
                               const kernels::Array& load1, const kernels::Array& mean,
                               const kernels::Array& slope, const State& to);
  [[nodiscard]] double work_between_modes(const State& from, const State& to, double duration) const;

  System system_;
  double h_;
  LoadSum loads_;
  Eigen::VectorXd lone_k_, lone_c_; ///< n: stiffness and damping of modes by themselves
  std::vector<char> apart_;         ///< n: whether the mode moves with these
  CoupledFlow coupled_;
  std::vector<int> lengths_;
  std::vector<kernels::FlowTable> tables_;     ///< of the modes that nothing couples
  std::vector<kernels::FlowTable> own_;        ///< of all modes by themselves; with forces of motion
  std::vector<kernels::MiddleTable> inverses_; ///< likewise: of kernels::own_works
  std::vector<kernels::MiddleTable> middles_;
  kernels::MiddleTable bow_; ///< of one step
  bool has_bow_ = false;
  kernels::Array per_force_,
      rate_per_force_; ///< m/N, m/(N s) of the modes that are not coupled: by `response`
  kernels::Array k_, none_, a_, b_, moved_, rate_, states_;
  kernels::Array own0_, own1_,
      mean_; ///< of the step moved last: force of its own on each mode, mean displacement
};

} // namespace fretwork::vibration
