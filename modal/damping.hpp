// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Modal damping.
#pragma once
#include "modal/basis.hpp"
#include <variant>
#include <vector>

namespace fretwork::modal {

/// C = stiffness K + mass M: ratio (stiffness omega + mass / omega) / 2.
struct Rayleigh {
  double stiffness = 0.0; ///< s, >= 0
  double mass = 0.0;      ///< 1/s, >= 0
};

/// Ratios by frequency: linear between the rows, that of the nearest row outside.
struct DampingTable {
  struct Row {
    double frequency; ///< Hz, >= 0, larger from row to row
    double ratio;     ///< >= 0
  };
  std::vector<Row> rows; ///< at least one
};

/// One ratio for all modes, a ratio a mode (at least as many as there are true modes; static modes have that of the highest true one),
/// Rayleigh, or by frequency.
using Damping = std::variant<double, std::vector<double>, Rayleigh, DampingTable>;

/// Sets basis.damping (the modal damping alone, without dampers) and adds the modal damping to
/// basis.damping_matrix where dampers made one. Rayleigh's mass term damps rigid modes too: where there are
/// rigid modes and a mass term, damping_matrix is made.
/// @throws core::Error for a negative value, for frequencies that do not rise and for a list shorter than the number of modes
void apply_damping(Basis& basis, const Damping& damping);

} // namespace fretwork::modal
