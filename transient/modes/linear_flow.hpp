// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The exact motion of all modes of a scene over a step, in coordinates in which it is cheap: modes that no forces of motion couple as they are
/// (modal_flow.hpp), then the coordinates y of the blocks that such forces couple (diagonal_flow.hpp). Contacts know coordinates alone: their
/// displacements by rows over them (`outputs`), their forces by rows over the numbers that a force has (`inputs`). Without forces of motion both are the
/// modes themselves. Displacements and velocities of all modes, and the energies of blocks, take dense products: they are found where they are asked for.
#pragma once
#include "transient/scene/scheme.hpp"
#include "vibration/diagonal_flow.hpp"
#include "vibration/modal_flow.hpp"
#include <cmath>
#include <cstdint>
#include <optional>

namespace fretwork::transient {

class LinearFlow {
public:
  /// Arrays of coordinates: q and their rates v.
  using State = vibration::ModalFlow::State;
  /// J, since the start: what the energies of the blocks follow from.
  struct BlockWorks {
    double forces = 0.0; ///< of loads and contact forces on them
    double fluid = 0.0;  ///< the integral of diagonal_flow.hpp
    void visit(core::StateArchive& state) { state(forces, fluid); }
  };
  /// J, at an instant; of the start where nothing has moved.
  struct BlockEnergies {
    double stored = 0.0, fluid_work = 0.0;
  };

  /// As ModalFlow.
  LinearFlow(const Scene& scene, double step, const std::vector<int>& lengths);

  /// Sizes of arrays, multiples of kernels::lanes: of a state, and of a force.
  [[nodiscard]] int coordinates() const { return uncoupled_.padded() + static_cast<int>(blocks_.size()); }
  [[nodiscard]] int force_numbers() const {
    return uncoupled_.padded() + kernels::numbers_of_input * static_cast<int>(blocks_.size());
  }
  /// Whether coordinates are more than the modes.
  [[nodiscard]] bool has_blocks() const { return !blocks_.empty(); }
  /// Contacts with their rows over coordinates, and over the numbers of a force.
  [[nodiscard]] std::vector<ContactPoint> outputs(const std::vector<ContactPoint>& contacts) const;
  [[nodiscard]] std::vector<ContactPoint> inputs(const std::vector<ContactPoint>& contacts) const;

  /// @param q, v  n
  [[nodiscard]] State start(const Eigen::VectorXd& q, const Eigen::VectorXd& v);
  /// The loads between two times as numbers of a force: the line from load0 to load1 with their mean and first moment and, of one step, with the linear force that
  /// stands for their bend (add_bends). They stay where there are none. No allocation.
  /// @param start, end  s   @param bend  of one step: their coefficient of degree 2, N; else untouched
  void load_in_step(double start, double end, bool one_step, kernels::Array& load0, kernels::Array& load1,
                    kernels::Array& bend);
  [[nodiscard]] bool loads_bend() const { return uncoupled_.loads_bend() || (driven_ && driven_->bends()); }
  /// As ModalFlow; sums without the blocks. No allocation.
  vibration::ModalFlow::Sums move(int length, const State& from, const kernels::Array& load0,
                                  const kernels::Array& load1, State& to);
  vibration::ModalFlow::Sums push(const State& from, const kernels::Array& load0, const kernels::Array& load1,
                                  const kernels::Array& mean, const kernels::Array& slope, State& to);
  /// Under a constant force.
  vibration::ModalFlow::Sums push(const State& from, const kernels::Array& load0, const kernels::Array& load1,
                                  const kernels::Array& constant, State& to) {
    return push(from, load0, load1, constant, none_, to);
  }
  /// Energy of the blocks as it would be without damping and fluid since the start, J.
  [[nodiscard]] double undamped_energy(const BlockWorks& works) const { return start_.stored + works.forces; }
  /// Adds those of the blocks over a step (force null: none), and the undamped energy. No allocation.
  void add_works(int length, const State& from, const kernels::Array& load0, const kernels::Array& load1,
                 const vibration::ModalForce* force, vibration::ModalFlow::Sums& sums, BlockWorks& works);
  /// After these works. No allocation.
  [[nodiscard]] BlockEnergies energies(const State& state, const BlockWorks& works);
  [[nodiscard]] double energy_at_start(const State& state) {
    return uncoupled_.energy(state) + start_.stored;
  }

  /// As ModalFlow, of coordinates. No allocation.
  void bow(const State& from, const kernels::Array& load0, const kernels::Array& load1,
           const kernels::Array& force, kernels::Array& bow);
  [[nodiscard]] bool has_bow() const { return uncoupled_.has_bow() || has_blocks(); }
  /// Adds to a linear force those that leave the modes where its bends do (vibration::BentForce). No allocation.
  void add_bends(const std::array<kernels::Array, 2>& bends, vibration::ModalForce& force) const {
    for (std::size_t k = 0; k < bends.size(); ++k)
      for (std::size_t i = 0; i < bends[k].size(); ++i) {
        force.mean[i] += for_bends_[k].mean[i] * bends[k][i];
        force.slope[i] += for_bends_[k].slope[i] * bends[k][i];
      }
  }
  /// Adds to displacements of `middle` what a bend of degree 2 moves modes by there: h^2/32 of it, of slow modes; of w h = 2 to a fifth. Not of blocks, nor of modes
  /// that no step follows. No allocation.
  void add_bend_in_middle(const kernels::Array& bend, kernels::Array& q) const {
    for (std::size_t i = 0; i < squares_.size(); ++i)
      q[i] += squares_[i] / 32.0 * bend[i];
  }
  /// Adds to `bow` what such a bend adds to it: h^2/60 of it, likewise. No allocation.
  void add_bow_of_bend(const kernels::Array& bend, kernels::Array& bow) const {
    for (std::size_t i = 0; i < squares_.size(); ++i)
      bow[i] += squares_[i] / 60.0 * bend[i];
  }
  /// Coordinates in the middle of the step moved last (force null: none), but for those of blocks. No allocation.
  void middle(int length, const State& from, const kernels::Array& load0, const kernels::Array& load1,
              const vibration::ModalForce* force, kernels::Array& q) {
    uncoupled_.middle(length, from, load0, load1, force, q);
  }
  /// The modes' displacements there, n values, by coordinates that `middle` gave. No allocation.
  void modes_in_middle(int length, const State& from, const kernels::Array& load0,
                       const kernels::Array& load1, const vibration::ModalForce* force,
                       const kernels::Array& middle, double* q);
  /// Modes a time after the start of a step of `duration`, as ModalFlow; n values each. No allocation.
  void inside(double time, double duration, const State& from, const kernels::Array& load0,
              const kernels::Array& load1, const vibration::ModalForce* force, double* q, double* v);
  /// Modal force of the loads at an instant, n values.
  void load_at(double time, double* force) {
    loads_ ? loads_->observe(time, force) : uncoupled_.load_at(time, force);
  }
  /// Adds the forces of motion where `inside` was last, n values. No allocation.
  void add_motion_forces(double* force);
  /// As ModalFlow, of modes.
  void response(const double* force, double* moved, double* velocity);

private:
  [[nodiscard]] std::size_t place(int length) const;
  /// The part of the blocks in an array.
  template <class Array> [[nodiscard]] auto* part(Array& of) const { return of.data() + uncoupled_.padded(); }
  [[nodiscard]] kernels::StateInputs inputs_of(const kernels::Array& load0, const kernels::Array& load1,
                                               const kernels::Array& mean,
                                               const kernels::Array& slope) const {
    return {part(load0), part(load1), part(mean), part(slope)};
  }
  void load_blocks(double start, double end, kernels::Array& load0, kernels::Array& load1,
                   kernels::Array* bend);
  void move_blocks(int length, const State& from, const kernels::Array& load0, const kernels::Array& load1,
                   const kernels::Array& mean, const kernels::Array& slope, State& to) const;
  [[nodiscard]] std::vector<vibration::Load> loads_on_blocks(const std::vector<vibration::Load>& loads) const;
  template <class Rows>
  [[nodiscard]] std::vector<ContactPoint> over_coordinates(const std::vector<ContactPoint>& contacts,
                                                           int numbers, const Rows& rows) const;
  void to_uncoupled(const double* modes, double* uncoupled) const;
  void to_modes(const double* uncoupled, double* modes) const;

  vibration::DiagonalFlow blocks_;
  std::vector<Eigen::Index> uncoupled_modes_; ///< those of no block; with blocks
  vibration::ModalFlow uncoupled_;
  Eigen::Index modes_;
  std::vector<int> lengths_;
  std::optional<vibration::LoadSum> loads_;  ///< on all modes; with blocks
  std::optional<vibration::LoadSum> driven_; ///< on the blocks, but for sampled loads
  std::optional<vibration::LoadSum> random_; ///< sampled loads on all modes
  BlockEnergies start_;                      ///< fluid_work: y^T P y
  vibration::BentForce for_bends_;           ///< by numbers of a force
  kernels::Array squares_; ///< s2, of modes that are not coupled (ModalFlow::squares_of_followed)
  kernels::Array none_, a_, b_, y_, q_, v_;
};

/// The terms of the energy balance that belong to modes in blocks. Each step adds works of loads and contact forces. Energy of the modes and work of
/// the fluid are found where a record is asked for them; until then the balance counts the blocks without damping and fluid, whose residual is the same.
struct BlockBalance {
  LinearFlow::BlockWorks works; ///< since the start
  double fluid_work = 0.0;      ///< J, when it was found last for the scale
  std::int64_t records = 0;     ///< since then
  void visit(core::StateArchive& state) { state(works, fluid_work, records); }

  /// After each step: what the fluid's work adds to the scale of the balance, J, that of many records being taken as one. No allocation.
  double add_to_scale(LinearFlow& modes, const LinearFlow::State& end) {
    constexpr std::int64_t records_of_scale = 256;
    if (++records < records_of_scale)
      return 0.0;
    records = 0;
    const double before = fluid_work;
    fluid_work = modes.energies(end, works).fluid_work;
    return std::abs(fluid_work - before);
  }

  /// The balance with damping and fluid of the blocks.   @param end  state to which it belongs
  [[nodiscard]] Energy whole(Energy e, LinearFlow& modes, const LinearFlow::State& end) const {
    const LinearFlow::BlockEnergies found = modes.energies(end, works);
    const double growth = found.stored - modes.undamped_energy(works);
    e.fluid_work += found.fluid_work;
    e.modal_damping += found.fluid_work - growth;
    e.stored += growth;
    e.scale += std::abs(found.fluid_work - fluid_work);
    return e;
  }
};

} // namespace fretwork::transient
