// SPDX-License-Identifier: GPL-3.0-or-later
#include "vibration/system.hpp"
#include <algorithm>
#include <utility>

namespace fretwork::vibration {
namespace {

using Eigen::Index;

/// Which modes and states (these follow the modes) depend on each other, directly.
Eigen::MatrixX<char> dependences(const System& system) {
  const core::MotionForces& f = system.motion;
  const Index n = system.size(), r = f.states();
  Eigen::MatrixX<char> out = Eigen::MatrixX<char>::Zero(n + r, n + r);
  const auto add = [&out](Index row, Index column, const Eigen::MatrixXd& a) {
    for (Index j = 0; j < a.cols(); ++j)
      for (Index i = 0; i < a.rows(); ++i)
        if (a(i, j) != 0.0)
          out(row + i, column + j) = out(column + j, row + i) = 1;
  };
  if (!f.empty()) {
    add(0, 0, f.stiffness);
    add(0, 0, f.damping);
    add(0, n, f.input);
    add(n, 0, f.output);
    add(n, n, f.rates);
  }
  if (system.damping_matrix.size() > 0) {
    Eigen::MatrixXd between = system.damping_matrix;
    between.diagonal().setZero();
    add(0, 0, between);
  }
  return out;
}

} // namespace

std::vector<std::size_t> first_with_function(const std::vector<Load>& loads) {
  std::vector<std::size_t> out;
  for (const Load& load : loads) {
    const auto first = std::find_if(loads.begin(), loads.end(), [&](const Load& other) {
      return &other == &load || other.function == load.function;
    });
    out.push_back(static_cast<std::size_t>(first - loads.begin()));
  }
  return out;
}

std::vector<CoupledBlock> coupled_blocks(const System& system) {
  if (system.motion.empty() && system.damping_matrix.size() == 0)
    return {};
  const Index n = system.size();
  const Eigen::MatrixX<char> depend = dependences(system);
  std::vector<CoupledBlock> out;
  std::vector<char> taken(static_cast<std::size_t>(depend.rows()), 0);
  for (Index first = 0; first < n; ++first) {
    if (taken[static_cast<std::size_t>(first)] || depend.col(first).isZero())
      continue;
    std::vector<Index> reached{first};
    taken[static_cast<std::size_t>(first)] = 1;
    for (std::size_t k = 0; k < reached.size(); ++k)
      for (Index other = 0; other < depend.rows(); ++other)
        if (depend(other, reached[k]) && !std::exchange(taken[static_cast<std::size_t>(other)], 1))
          reached.push_back(other);
    std::sort(reached.begin(), reached.end());
    CoupledBlock& block = out.emplace_back();
    for (const Index i : reached)
      (i < n ? block.modes : block.states).push_back(i < n ? i : i - n);
  }
  return out;
}

bool acts_alone(const System& system, const CoupledBlock& block) {
  if (block.modes.size() > 1 || !block.states.empty() || system.motion.empty())
    return false;
  const Index j = block.modes.front();
  return system.stiffness(j) >= system.motion.stiffness(j, j) &&
         system.damping(j) >= system.motion.damping(j, j);
}

System with_diagonal(System system) {
  if (system.damping_matrix.size() > 0)
    system.damping = system.damping_matrix.diagonal();
  return system;
}

} // namespace fretwork::vibration
