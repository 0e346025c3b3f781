// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// A modal system under loads: q_i'' + c_i q_i' + k_i q_i = sum of loads; and which of its modes a damping matrix or forces of motion couple.
#pragma once
#include "core/motion_forces.hpp"
#include "signals/sampled_load.hpp"
#include "signals/time_function.hpp"
#include <Eigen/Core>
#include <vector>

namespace fretwork::vibration {

/// Modes of unit modal mass.
struct System {
  Eigen::VectorXd stiffness;      ///< n, omega^2, 1/s2, >= 0
  Eigen::VectorXd damping;        ///< n, 2 zeta omega, 1/s, >= 0
  Eigen::MatrixXd damping_matrix; ///< n x n, 1/s, replaces `damping` where it is not empty
  core::MotionForces motion = {}; ///< of the fluid; empty: none
  [[nodiscard]] Eigen::Index size() const { return stiffness.size(); }
  /// That of the modes one by one: none where the matrix has it.
  [[nodiscard]] Eigen::VectorXd lone_damping() const {
    return damping_matrix.size() == 0 ? damping : Eigen::VectorXd::Zero(size());
  }
};

struct Load {
  signals::TimeFunction function;
  Eigen::VectorXd modal_force; ///< n: the load is modal_force * function(t)
  /// -M a of a base or support that accelerates, or the force of dampers that a support's velocity stretches: no part of a static equilibrium
  bool inertial = false;
};

/// Of each load the number of the first that follows the same function of time: itself, or one before it.
[[nodiscard]] std::vector<std::size_t> first_with_function(const std::vector<Load>& loads);

/// Modes that follow each other, such as those of a structure.
struct ModeRange {
  Eigen::Index first = 0, size = 0;
};

/// A modal system, its loads and its initial state: what moves it where nothing touches it.
struct ForcedSystem {
  System system;
  std::vector<Load> loads;
  std::vector<signals::SampledLoad> sampled_loads; ///< random, of zero mean
  Eigen::VectorXd q0, v0;                          ///< initial state, n
  double duration = 0.0;                           ///< s, > 0
};

/// Modes, and states of the forces of motion, that depend on each other, directly or through others.
struct CoupledBlock {
  std::vector<Eigen::Index> modes, states; ///< ascending
};

/// All blocks, by their first modes. A mode by itself is one only where forces of motion act on it.
[[nodiscard]] std::vector<CoupledBlock> coupled_blocks(const System& system);

/// Whether forces of motion act on a mode by itself and without states: it is then one of another stiffness and damping.
[[nodiscard]] bool acts_alone(const System& system, const CoupledBlock& block);

/// The system for its modes that nothing couples: `damping` is the damping matrix's diagonal, where there is one.
[[nodiscard]] System with_diagonal(System system);

} // namespace fretwork::vibration
