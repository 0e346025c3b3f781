// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Modes and motions as displacement fields over the whole mesh, for programs that show them.
#pragma once
#include "results/run_results.hpp"

namespace fretwork::results {

/// Displacement of every mesh node, 3 x nodes.
using Field = Eigen::Matrix3Xd;

/// The k-th mode of every structure that has one, static modes after the modes of all, each scaled to a largest translation of 1 (a
/// mode that only turns: as it is).
struct ModeField {
  std::string
      name; ///< "mode 3, 12.34 Hz", "static mode 1, 345.6 Hz"; with several structures "mode 3 of each structure",
            ///< "static mode 1 of each structure"
  Field displacement;
};
[[nodiscard]] Eigen::Index mode_count(const RunResults& results);
[[nodiscard]] ModeField mode_field(const RunResults& results, Eigen::Index k);

/// Displacement (m) and rotation (rad) of every mesh node, 6 x nodes.
using Motion = Eigen::Matrix<double, 6, Eigen::Dynamic>;

/// Of all modes at output `index` of the series.
[[nodiscard]] Motion motion(const RunResults& results, Eigen::Index index);

/// Nodes that no line uses: lumped masses.
[[nodiscard]] std::vector<core::Index> lone_nodes(const RunResults& results);

/// @throws core::Error where there is no mesh to show anything on
void require_mesh(const RunResults& results);

} // namespace fretwork::results
