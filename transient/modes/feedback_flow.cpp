// SPDX-License-Identifier: GPL-3.0-or-later
#include "transient/modes/feedback_flow.hpp"
#include <algorithm>
#include <utility>

namespace fretwork::transient {
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
  add(0, 0, f.stiffness);
  add(0, 0, f.damping);
  add(0, n, f.input);
  add(n, 0, f.output);
  add(n, n, f.rates);
  if (system.damping_matrix.size() > 0) {
    Eigen::MatrixXd between = system.damping_matrix;
    between.diagonal().setZero();
    add(0, 0, between);
  }
  return out;
}

} // namespace

FeedbackFlow::FeedbackFlow(const System& system, double step) {
  if (system.motion.empty())
    return;
  const Index n = system.size();
  states_ = system.motion.states();
  coupled_.assign(static_cast<std::size_t>(n), 0);
  const Eigen::MatrixX<char> depend = dependences(system);
  std::vector<char> taken(static_cast<std::size_t>(n + states_), 0);
  for (Index first = 0; first < n; ++first) {
    if (taken[static_cast<std::size_t>(first)] || depend.col(first).isZero())
      continue;
    std::vector<Index> reached{first};
    taken[static_cast<std::size_t>(first)] = 1;
    for (std::size_t k = 0; k < reached.size(); ++k)
      for (Index other = 0; other < n + states_; ++other)
        if (depend(other, reached[k]) && !std::exchange(taken[static_cast<std::size_t>(other)], 1))
          reached.push_back(other);
    std::sort(reached.begin(), reached.end());
    std::vector<Index> modes, states;
    for (const Index i : reached)
      (i < n ? modes : states).push_back(i < n ? i : i - n);
    for (const Index mode : modes)
      coupled_[static_cast<std::size_t>(mode)] = 1;
    blocks_.emplace_back(system, step, std::move(modes), std::move(states));
  }
}

FeedbackFlow::Works FeedbackFlow::advance(double* q, double* v, double* z, const double* load0,
                                          const double* load1, const double* mean, const double* slope) {
  Works sum;
  for (FeedbackBlock& block : blocks_) {
    const Works works = block.advance(q, v, z, load0, load1, mean, slope);
    sum.load += works.load;
    sum.contact += works.contact;
    sum.motion += works.motion;
  }
  return sum;
}

void FeedbackFlow::inside(double t, const double* q, const double* v, const double* z, const double* f0,
                          const double* slope, double* q_at, double* v_at) {
  for (FeedbackBlock& block : blocks_)
    block.inside(t, q, v, z, f0, slope, q_at, v_at);
}

void FeedbackFlow::add_forces(double* force) const {
  for (const FeedbackBlock& block : blocks_)
    block.add_forces(force);
}

} // namespace fretwork::transient
