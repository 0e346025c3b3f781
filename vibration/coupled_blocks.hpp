// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Which modes a damping matrix or forces of motion couple with each other.
#pragma once
#include "vibration/system.hpp"
#include <vector>

namespace fretwork::vibration {

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
