// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// What the flow along tubes gives: damping of the modes and stability, as plain data.
#pragma once
#include "flow/damping.hpp"
#include "flow/stability.hpp"
#include <string>
#include <vector>

namespace fretwork::results {

/// Damping of the modes of one structure by the flow along one tube.
struct TubeDamping {
  std::string tube;
  std::vector<std::string> zones; ///< names
  double length = 0.0;            ///< m
  std::size_t structure = 0;      ///< number in RunResults::bases
  Eigen::VectorXd frequency;      ///< Hz, of the modes
  flow::Damping damping;
  std::vector<std::string> limits; ///< those of `damping`, in words
};

/// Stability of one tube on modes pinned at supports.
struct StabilityAssessment {
  std::string name;
  std::vector<std::string> pinned; ///< names of the contacts at which the modes are held
  bool damping_given = false;      ///< by the study: then not of `damping`
  TubeDamping damping;             ///< on the pinned modes
  flow::Stability stability;
  std::vector<double> sweep; ///< factors of all velocities
};

} // namespace fretwork::results
