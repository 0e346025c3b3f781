// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The exact motion of the modes over a step of the splitting scheme, under loads and contact forces that are linear in time within it
/// (oscillator.hpp; matrix_flow.hpp where a damping matrix couples modes). Steps may have several lengths, whole multiples of the shortest.
#pragma once
#include "core/state_archive.hpp"
#include "transient/modes/feedback_flow.hpp"
#include "transient/modes/load_sum.hpp"
#include "transient/modes/matrix_flow.hpp"

namespace fretwork::transient {

/// The exact flow of the modes over h seconds; modes that a damping matrix couples stay where they are, for theirs follows.
[[nodiscard]] kernels::FlowTable flow_table(const System& system, const MatrixFlow& coupled, double h);

/// A force on the modes over a step, from mean - slope at its start to mean + slope at its end, padded.
struct ModalForce {
  kernels::Array mean, slope;
  void visit(core::StateArchive& state) { state(mean, slope); }
};

class ModalFlow {
public:
  /// @param lengths  of steps in numbers of `step`, s; only 1 where a damping matrix or forces of motion couple modes
  ModalFlow(const Scene& scene, double step, const std::vector<int>& lengths);

  /// Padded.
  struct State {
    kernels::Array q, v, z; ///< z: of forces of motion, not padded
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
  /// Number of the states of forces that depend on the motion.
  [[nodiscard]] std::size_t states() const { return static_cast<std::size_t>(fed_.states()); }
  /// Modal force of the loads of the step about a time; `load` stays where there are none. No allocation.
  void load_about(double time, kernels::Array& load);
  /// The modes over `length` steps under the loads load0 to load1, alone, with a constant force, with a force that changes. No allocation.
  Sums move(int length, const State& from, const kernels::Array& load0, const kernels::Array& load1,
            State& to);
  Sums move(int length, const State& from, const kernels::Array& load0, const kernels::Array& load1,
            const kernels::Array& constant, State& to);
  Sums move(int length, const State& from, const kernels::Array& load0, const kernels::Array& load1,
            const ModalForce& force, State& to);
  /// Displacements in the middle of such a step (force null: none). No allocation.
  void middle(int length, const State& from, const kernels::Array& load0, const kernels::Array& load1,
              const ModalForce* force, kernels::Array& q);
  [[nodiscard]] double energy(const State& state) const;
  /// State at a time after the start of a step of `duration`, as `move` with a force (null: none); n values each. No allocation.
  void inside(double time, double duration, const State& from, const kernels::Array& load0,
              const kernels::Array& load1, const ModalForce* force, double* q, double* v);
  /// Modal force of the loads at an instant, n values.
  void load_at(double time, double* force);
  /// Adds the forces of motion where `inside` was last, n values. No allocation.
  void add_motion_forces(double* force) const { fed_.add_forces(force); }
  /// Displacement of the modes after one step from rest under a constant force, padded arrays.
  void answer(const double* force, double* moved);

private:
  [[nodiscard]] std::size_t place(int length) const;
  [[nodiscard]] int padded() const { return static_cast<int>(k_.size()); }
  Sums move(int length, const State& from, const kernels::Array& load0, const kernels::Array& load1,
            const kernels::Array& mean, const kernels::Array& slope, State& to);
  void move_coupled(const State& from, const kernels::Array& load0, const kernels::Array& load1,
                    const kernels::Array& mean, const kernels::Array& slope, State& to, Sums& sums);
  void move_fed(const kernels::Array& load0, const kernels::Array& load1, const kernels::Array& mean,
                const kernels::Array& slope, State& to, Sums& sums);
  [[nodiscard]] bool apart(Eigen::Index mode) const { return !coupled_.couples(mode) && !fed_.couples(mode); }

  System system_;
  double h_;
  LoadSum loads_;
  FeedbackFlow fed_;
  MatrixFlow coupled_; ///< of what forces of motion leave alone
  std::vector<int> lengths_;
  std::vector<kernels::FlowTable> tables_;
  std::vector<kernels::MiddleTable> middles_;
  kernels::Array per_force_; ///< m/N of the modes that are not coupled: their displacement by `answer`
  kernels::Array k_, none_, a_, b_, moved_, rate_, states_;
};

} // namespace fretwork::transient
