// SPDX-License-Identifier: GPL-3.0-or-later
#include "transient/modes/matrix_flow.hpp"
#include <algorithm>
#include <cmath>

namespace fretwork::transient {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int series_terms = 20; ///< 1/20! = 4e-19

/// The modes that the matrix couples with each other, block by block; those alone are left out.
std::vector<std::vector<Index>> coupled_modes(const MatrixXd& c) {
  std::vector<std::vector<Index>> out;
  std::vector<char> seen(static_cast<std::size_t>(c.rows()), 0);
  for (Index first = 0; first < c.rows(); ++first) {
    if (seen[static_cast<std::size_t>(first)])
      continue;
    std::vector<Index> block = {first};
    seen[static_cast<std::size_t>(first)] = 1;
    for (std::size_t k = 0; k < block.size(); ++k)
      for (Index j = 0; j < c.cols(); ++j)
        if (!seen[static_cast<std::size_t>(j)] && (c(block[k], j) != 0.0 || c(j, block[k]) != 0.0)) {
          seen[static_cast<std::size_t>(j)] = 1;
          block.push_back(j);
        }
    if (block.size() > 1) {
      std::sort(block.begin(), block.end());
      out.push_back(std::move(block));
    }
  }
  return out;
}

} // namespace

System with_diagonal(System system) {
  if (system.damping_matrix.size() > 0)
    system.damping = system.damping_matrix.diagonal();
  return system;
}

MatrixFlow::MatrixFlow(const System& system, double step, int degree, int halvings)
    : step_(step), degree_(degree) {
  coupled_.assign(static_cast<std::size_t>(system.size()), 0);
  for (auto& modes : coupled_modes(system.damping_matrix)) {
    for (const Index mode : modes)
      coupled_[static_cast<std::size_t>(mode)] = 1;
    blocks_.push_back(make_block(system, std::move(modes), halvings));
  }
}

MatrixFlow::Block MatrixFlow::make_block(const System& system, std::vector<Index> modes, int halvings) const {
  Block b;
  const auto m = static_cast<Index>(modes.size());
  b.k = system.stiffness(modes);
  b.c = system.damping_matrix(modes, modes);
  b.modes = std::move(modes);
  b.state.resize((3 + degree_) * m);
  b.moved.resize((2 + degree_) * m);
  for (VectorXd* x : {&b.t, &b.v, &b.work})
    x->resize(m);
  const double rate = std::sqrt(b.k.maxCoeff()) + b.c.cwiseAbs().rowwise().sum().maxCoeff();
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
    b.flows.push_back(doubled(b.flows.back()));
  std::reverse(b.flows.begin(), b.flows.end());
  return b;
}

/// `moved` from `state` a short time later.
void MatrixFlow::Block::series(double time) {
  const Index m = size(), degree = moved.size() / m - 2;
  t = state.head(m);
  v = state.segment(m, m);
  moved << t, v, t.replicate(degree, 1);
  for (Index i = 1; i < degree; ++i)
    moved.segment((2 + i) * m, m) /= static_cast<double>(i + 1);
  for (int j = 0; j < series_terms; ++j) {
    const double factor = time / (j + 1);
    work.noalias() = c * v;
    work.array() = -work.array() - k.array() * t.array();
    if (j <= degree)
      work += state.segment((2 + j) * m, m);
    t = factor * v;
    v = factor * work;
    moved.head(m) += t;
    moved.segment(m, m) += v;
    for (Index i = 0; i < degree; ++i)
      moved.segment((2 + i) * m, m) += t / static_cast<double>(j + i + 2);
  }
}

/// The flow over twice the time. With S the share of the double step, the force of the first half is f_j (s/2)^j, that of the second
/// f_j ((1 + s)/2)^j; the moments likewise: 2 M_0 = M_0' + M_0'', 4 M_1 = M_1' + M_0'' + M_1''.
MatrixXd MatrixFlow::doubled(const MatrixXd& flow) const {
  const Index m = flow.rows() / (2 + degree_);
  const auto loads = [m](MatrixXd& x, int j) { return x.middleCols((2 + j) * m, m); };
  MatrixXd first = flow,
           second = flow; // what the halves make of the start and of the force of the double step
  second.leftCols(2 * m).setZero();
  for (int j = 1; j <= degree_; ++j) {
    loads(first, j) *= std::ldexp(1.0, -j);
    loads(second, j) *= std::ldexp(1.0, -j);
  }
  if (degree_ == 2) // (1 + s)^2 = 1 + 2 s + s^2, and the factor 1/4 there is
    loads(second, 2) += 0.25 * (2.0 * flow.middleCols(3 * m, m) + flow.middleCols(2 * m, m));
  loads(second, 1) += 0.5 * flow.middleCols(2 * m, m);
  second += flow.leftCols(2 * m) * first.topRows(2 * m);
  const auto moment = [m](MatrixXd& x, int i) { return x.middleRows((2 + i) * m, m); };
  if (degree_ == 2)
    moment(second, 1) = 0.25 * (moment(first, 1) + moment(second, 0) + moment(second, 1));
  moment(second, 0) = 0.5 * (moment(first, 0) + moment(second, 0));
  return second;
}

void MatrixFlow::Block::apply(std::size_t level) { moved.noalias() = flows[level] * state; }

void MatrixFlow::start(Block& b, const double* q, const double* v) {
  for (Index i = 0; i < b.size(); ++i) {
    b.state(i) = q[b.modes[static_cast<std::size_t>(i)]];
    b.state(b.size() + i) = v[b.modes[static_cast<std::size_t>(i)]];
  }
}

double MatrixFlow::advance(int halvings, double* q, double* v, const double* f0, const double* f1) {
  double work = 0.0;
  if (f0) {
    move(
        halvings, q, v, [&](Index mode, int j) { return j == 0 ? f0[mode] : f1[mode] - f0[mode]; },
        [&](Index mode, double to, double speed, const auto& moments) {
          // int f q' dt by parts
          work += f0[mode] * (to - q[mode]) + (f1[mode] - f0[mode]) * (to - moments[0]);
          q[mode] = to;
          v[mode] = speed;
        });
    return work;
  }
  for (Block& b : blocks_) {
    const Index m = b.size();
    start(b, q, v);
    b.moved.head(2 * m).noalias() =
        b.flows[static_cast<std::size_t>(halvings)].topLeftCorner(2 * m, 2 * m) * b.state.head(2 * m);
    for (Index i = 0; i < m; ++i) {
      q[b.modes[static_cast<std::size_t>(i)]] = b.moved(i);
      v[b.modes[static_cast<std::size_t>(i)]] = b.moved(m + i);
    }
  }
  return work;
}

void MatrixFlow::inside(double time, const double* q0, const double* v0, const double* f0,
                        const double* slope, double* q, double* v) {
  inside(
      time, q0, v0,
      [&](Index mode, int j, double from, double length) {
        return !f0 ? 0.0 : j == 0 ? f0[mode] + from * slope[mode] : length * slope[mode];
      },
      q, v);
}

} // namespace fretwork::transient
