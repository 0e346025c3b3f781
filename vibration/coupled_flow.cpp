// SPDX-License-Identifier: GPL-3.0-or-later
#include "vibration/coupled_flow.hpp"
#include <algorithm>
#include <cmath>

namespace fretwork::vibration {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int series_terms = 20; ///< 1/20! = 4e-19

double row_sum(const MatrixXd& a) { return a.size() == 0 ? 0.0 : a.cwiseAbs().rowwise().sum().maxCoeff(); }

} // namespace

CoupledFlow::CoupledFlow(const System& system, double step, int degree, int halvings)
    : CoupledFlow(system, coupled_blocks(system), step, degree, halvings) {}

CoupledFlow::CoupledFlow(const System& system, const std::vector<CoupledBlock>& blocks, double step,
                         int degree, int halvings)
    : step_(step), degree_(degree) {
  coupled_.assign(static_cast<std::size_t>(system.size()), 0);
  for (const CoupledBlock& block : blocks) {
    for (const Index mode : block.modes)
      coupled_[static_cast<std::size_t>(mode)] = 1;
    blocks_.push_back(make_block(system, block, halvings));
  }
}

CoupledFlow::Block CoupledFlow::make_block(const System& system, const CoupledBlock& of, int halvings) const {
  Block b;
  static_cast<CoupledBlock&>(b) = of;
  const auto m = static_cast<Index>(of.modes.size()), r = static_cast<Index>(of.states.size());
  b.k = VectorXd(system.stiffness(of.modes)).asDiagonal();
  b.c = system.damping_matrix.size() > 0 ? MatrixXd(system.damping_matrix(of.modes, of.modes))
                                         : MatrixXd(VectorXd(system.damping(of.modes)).asDiagonal());
  b.input = MatrixXd::Zero(m, r);
  b.rates = MatrixXd::Zero(r, r);
  b.output = MatrixXd::Zero(r, m);
  b.forces = MatrixXd::Zero(m, 2 * m + r);
  if (const core::MotionForces& f = system.motion; !f.empty()) {
    b.input = f.input(of.modes, of.states);
    b.rates = f.rates(of.states, of.states);
    b.output = f.output(of.states, of.modes);
    b.forces << f.stiffness(of.modes, of.modes), f.damping(of.modes, of.modes), b.input;
    b.k -= b.forces.leftCols(m);
    b.c -= b.forces.middleCols(m, m);
  }
  b.state.resize(b.unknowns() + (1 + degree_) * m);
  b.moved.resize(b.unknowns() + degree_ * m);
  for (VectorXd* x : {&b.t, &b.v, &b.work})
    x->resize(m);
  b.z.resize(r);
  b.z_rate.resize(r);
  const double rate =
      std::sqrt(row_sum(b.k)) + row_sum(b.c) + row_sum(b.rates) + std::sqrt(row_sum(b.input * b.output));
  halvings = std::max(halvings, static_cast<int>(std::ceil(std::log2(std::max(1.0, rate * step_)))));
  MatrixXd flow(b.moved.size(), b.state.size());
  for (Index j = 0; j < b.state.size(); ++j) {
    b.state.setZero();
    b.state(j) = 1.0;
    b.series(std::ldexp(step_, -halvings));
    flow.col(j) = b.moved;
  }
  b.flows.push_back(std::move(flow));
  for (int l = 0; l < halvings; ++l)
    b.flows.push_back(doubled(b, b.flows.back()));
  std::reverse(b.flows.begin(), b.flows.end());
  return b;
}

/// `moved` from `state` a short time later.
void CoupledFlow::Block::series(double time) {
  const Index m = size(), r = z.size(), n = unknowns(), degree = (moved.size() - n) / m;
  t = state.head(m);
  v = state.segment(m, m);
  z = state.segment(2 * m, r);
  moved << t, v, z, t.replicate(degree, 1);
  for (Index i = 1; i < degree; ++i)
    moved.segment(n + i * m, m) /= static_cast<double>(i + 1);
  for (int j = 0; j < series_terms; ++j) {
    const double factor = time / (j + 1);
    work.noalias() = -c * v;
    work.noalias() -= k * t;
    if (r > 0) {
      work.noalias() += input * z;
      z_rate.noalias() = rates * z;
      z_rate.noalias() += output * v;
      z = factor * z_rate;
      moved.segment(2 * m, r) += z;
    }
    if (j <= degree)
      work += state.segment(n + j * m, m);
    t = factor * v;
    v = factor * work;
    moved.head(m) += t;
    moved.segment(m, m) += v;
    for (Index i = 0; i < degree; ++i)
      moved.segment(n + i * m, m) += t / static_cast<double>(j + i + 2);
  }
}
/// The flow over twice the time. With S the share of the double step, the force of the first half is f_j (s/2)^j, that of the second
/// f_j ((1 + s)/2)^j; the moments likewise: 2 M_0 = M_0' + M_0'', 4 M_1 = M_1' + M_0'' + M_1''.
MatrixXd CoupledFlow::doubled(const Block& b, const MatrixXd& flow) const {
  const Index m = b.size(), n = b.unknowns();
  const auto loads = [m, n](MatrixXd& x, int j) { return x.middleCols(n + j * m, m); };
  MatrixXd first = flow,
           second = flow; // what the halves make of the start and of the force of the double step
  second.leftCols(n).setZero();
  for (int j = 1; j <= degree_; ++j) {
    loads(first, j) *= std::ldexp(1.0, -j);
    loads(second, j) *= std::ldexp(1.0, -j);
  }
  if (degree_ == 2) // (1 + s)^2 = 1 + 2 s + s^2, and the factor 1/4 there is
    loads(second, 2) += 0.25 * (2.0 * flow.middleCols(n + m, m) + flow.middleCols(n, m));
  loads(second, 1) += 0.5 * flow.middleCols(n, m);
  second += flow.leftCols(n) * first.topRows(n);
  const auto moment = [m, n](MatrixXd& x, int i) { return x.middleRows(n + i * m, m); };
  if (degree_ == 2)
    moment(second, 1) = 0.25 * (moment(first, 1) + moment(second, 0) + moment(second, 1));
  moment(second, 0) = 0.5 * (moment(first, 0) + moment(second, 0));
  return second;
}

void CoupledFlow::start(Block& b, const double* q, const double* v, const double* z) {
  for (Index i = 0; i < b.size(); ++i) {
    b.state(i) = q[b.modes[static_cast<std::size_t>(i)]];
    b.state(b.size() + i) = v[b.modes[static_cast<std::size_t>(i)]];
  }
  for (std::size_t i = 0; i < b.states.size(); ++i)
    b.state(2 * b.size() + static_cast<Index>(i)) = z ? z[b.states[i]] : 0.0;
}

double CoupledFlow::advance(int halvings, double* q, double* v, const double* f0, const double* f1,
                            double* z) {
  double work = 0.0;
  for (Block& b : blocks_) {
    start(b, q, v, z);
    load(b, [&](Index mode, int j) { return !f0 ? 0.0 : j == 0 ? f0[mode] : f1[mode] - f0[mode]; });
    b.apply(static_cast<std::size_t>(halvings));
    give(b, [&](Index mode, double to, double speed, const auto& moments) {
      if (f0) // int f q' dt by parts
        work += f0[mode] * (to - q[mode]) + (f1[mode] - f0[mode]) * (to - moments[0]);
      q[mode] = to;
      v[mode] = speed;
    });
    for (std::size_t i = 0; z && i < b.states.size(); ++i)
      z[b.states[i]] = b.moved(2 * b.size() + static_cast<Index>(i));
  }
  return work;
}

void CoupledFlow::inside(double time, const double* q0, const double* v0, const double* f0,
                         const double* slope, double* q, double* v, const double* z0) {
  inside(
      time, q0, v0,
      [&](Index mode, int j, double from, double length) {
        return !f0 ? 0.0 : j == 0 ? f0[mode] + from * slope[mode] : length * slope[mode];
      },
      q, v, z0);
}

void CoupledFlow::add_forces(double* force) const {
  for (const Block& b : blocks_)
    for (Index i = 0; i < b.size(); ++i)
      force[b.modes[static_cast<std::size_t>(i)]] += b.forces.row(i).dot(b.moved.head(b.unknowns()));
}

} // namespace fretwork::vibration
