// SPDX-License-Identifier: GPL-3.0-or-later
#include "transient/matrix_flow.hpp"
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

MatrixFlow::MatrixFlow(const System& system, double step) : step_(step) {
  coupled_.assign(static_cast<std::size_t>(system.size()), 0);
  for (auto& modes : coupled_modes(system.damping_matrix)) {
    for (const Index mode : modes)
      coupled_[static_cast<std::size_t>(mode)] = 1;
    blocks_.push_back(make_block(system, std::move(modes), step));
  }
}

MatrixFlow::Block MatrixFlow::make_block(const System& system, std::vector<Index> modes, double step) {
  Block b;
  const auto m = static_cast<Index>(modes.size());
  b.k = system.stiffness(modes);
  b.c = system.damping_matrix(modes, modes);
  b.modes = std::move(modes);
  b.state.resize(4 * m);
  b.moved.resize(3 * m);
  for (VectorXd* x : {&b.t, &b.v, &b.work})
    x->resize(m);
  const double rate = std::sqrt(b.k.maxCoeff()) + b.c.cwiseAbs().rowwise().sum().maxCoeff();
  const int halvings = std::max(1, static_cast<int>(std::ceil(std::log2(std::max(1.0, rate * step)))));
  MatrixXd flow(3 * m, 4 * m);
  for (Index j = 0; j < 4 * m; ++j) {
    b.state.setZero();
    b.state(j) = 1.0;
    b.series(std::ldexp(step, -halvings));
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
  const Index m = size();
  t = state.head(m);
  v = state.segment(m, m);
  moved << t, v, t;
  for (int j = 0; j < series_terms; ++j) {
    const double factor = time / (j + 1);
    work.noalias() = c * v;
    work.array() = -work.array() - k.array() * t.array();
    if (j == 0)
      work += state.segment(2 * m, m);
    else if (j == 1)
      work += state.tail(m) - state.segment(2 * m, m);
    t = factor * v;
    v = factor * work;
    moved.head(m) += t;
    moved.segment(m, m) += v;
    moved.tail(m) += t / (j + 2);
  }
}

/// The flow over twice the time: the load in the middle is (f0 + f1)/2.
MatrixXd MatrixFlow::doubled(const MatrixXd& flow) {
  const Index m = flow.rows() / 3;
  MatrixXd first = flow, second = flow; // what the halves make of f0 and f1
  first.middleCols(2 * m, m) += 0.5 * first.rightCols(m);
  first.rightCols(m) *= 0.5;
  second.leftCols(2 * m).setZero();
  second.rightCols(m) += 0.5 * second.middleCols(2 * m, m);
  second.middleCols(2 * m, m) *= 0.5;
  second += flow.leftCols(2 * m) * first.topRows(2 * m);
  second.bottomRows(m) = 0.5 * (first.bottomRows(m) + second.bottomRows(m));
  return second;
}

void MatrixFlow::Block::apply(std::size_t level) { moved.noalias() = flows[level] * state; }

double MatrixFlow::advance(int halvings, double* q, double* v, const double* f0, const double* f1) {
  const auto level = static_cast<std::size_t>(halvings);
  double work = 0.0;
  for (Block& b : blocks_) {
    const Index m = b.size();
    for (Index i = 0; i < m; ++i) {
      const Index mode = b.modes[static_cast<std::size_t>(i)];
      b.state(i) = q[mode];
      b.state(m + i) = v[mode];
      if (f0) {
        b.state(2 * m + i) = f0[mode];
        b.state(3 * m + i) = f1[mode];
      }
    }
    if (f0)
      b.apply(level);
    else
      b.moved.head(2 * m).noalias() = b.flows[level].topLeftCorner(2 * m, 2 * m) * b.state.head(2 * m);
    for (Index i = 0; i < m; ++i) {
      const Index mode = b.modes[static_cast<std::size_t>(i)];
      if (f0) // int f q' dt by parts, f linear
        work += f0[mode] * (b.moved(i) - q[mode]) + (f1[mode] - f0[mode]) * (b.moved(i) - b.moved(2 * m + i));
      q[mode] = b.moved(i);
      v[mode] = b.moved(m + i);
    }
  }
  return work;
}

void MatrixFlow::inside(double time, const double* q0, const double* v0, const double* f0,
                        const double* slope, double* q, double* v) {
  for (Block& b : blocks_) {
    const Index m = b.size();
    const auto load = [&](double from, double to) {
      for (Index i = 0; i < m; ++i) {
        const Index mode = b.modes[static_cast<std::size_t>(i)];
        b.state(2 * m + i) = f0 ? f0[mode] + from * slope[mode] : 0.0;
        b.state(3 * m + i) = f0 ? f0[mode] + to * slope[mode] : 0.0;
      }
    };
    for (Index i = 0; i < m; ++i) {
      b.state(i) = q0[b.modes[static_cast<std::size_t>(i)]];
      b.state(m + i) = v0[b.modes[static_cast<std::size_t>(i)]];
    }
    double at = 0.0, length = step_;
    for (std::size_t level = 0; level < b.flows.size(); ++level, length *= 0.5)
      if (time - at >= length) {
        load(at, at + length);
        b.apply(level);
        b.state.head(2 * m) = b.moved.head(2 * m);
        at += length;
      }
    load(at, time);
    b.series(time - at);
    for (Index i = 0; i < m; ++i) {
      q[b.modes[static_cast<std::size_t>(i)]] = b.moved(i);
      v[b.modes[static_cast<std::size_t>(i)]] = b.moved(m + i);
    }
  }
}

} // namespace fretwork::transient
