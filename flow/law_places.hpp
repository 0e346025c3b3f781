// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Where a fluidelastic law acts on the modes: the stations of a tube with what the law needs of them.
#pragma once
#include "flow/sampling.hpp"

namespace fretwork::flow {

/// A station of a tube; still where V = 0.
struct LawPlace {
  Eigen::MatrixXd shapes;          ///< along drag and lift, 2 x modes of its structure
  double pressure = 0.0;           ///< q w, Pa m
  double rate = 0.0;               ///< V/D, 1/s
  std::vector<double> shares = {}; ///< of the nodes of lags
};

/// @throws core::Error where a zone with velocity has no direction of drag
[[nodiscard]] std::vector<LawPlace> law_places(const Sampling& sampling);

} // namespace fretwork::flow
