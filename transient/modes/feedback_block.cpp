// SPDX-License-Identifier: GPL-3.0-or-later
#include "transient/modes/feedback_block.hpp"
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace fretwork::transient {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int series_terms = 20; ///< 1/20! = 4e-19

/// Abscissae and weights of Gauss-Legendre quadrature with 8 points, on (-1, 1), the positive ones.
constexpr std::array<std::pair<double, double>, 4> gauss = {{{0.1834346424956498, 0.3626837833783620},
                                                             {0.5255324099163290, 0.3137066458778873},
                                                             {0.7966664774136267, 0.2223810344533745},
                                                             {0.9602898564975363, 0.1012285362903763}}};

double row_sum(const MatrixXd& a) { return a.size() == 0 ? 0.0 : a.cwiseAbs().rowwise().sum().maxCoeff(); }

MatrixXd exponential(const MatrixXd& a, double t) {
  MatrixXd term = MatrixXd::Identity(a.rows(), a.cols()), sum = term;
  for (int j = 1; j < series_terms; ++j) {
    term = (t / j) * (a * term).eval();
    sum += term;
  }
  return sum;
}

} // namespace

FeedbackBlock::FeedbackBlock(const System& system, double step, std::vector<Index> modes,
                             std::vector<Index> states)
    : step_(step), modes_(std::move(modes)), states_(std::move(states)),
      r_(static_cast<Index>(states_.size())) {
  const core::MotionForces& f = system.motion;
  const Index m = size();
  k_ = system.stiffness(modes_);
  c_ = system.damping_matrix.size() > 0 ? MatrixXd(system.damping_matrix(modes_, modes_))
                                        : MatrixXd(VectorXd(system.damping(modes_)).asDiagonal());
  const MatrixXd stiffness = f.stiffness(modes_, modes_) - MatrixXd(k_.asDiagonal());
  const MatrixXd damping = f.damping(modes_, modes_) - c_;
  const MatrixXd input = f.input(modes_, states_), output = f.output(states_, modes_),
                 rates = f.rates(states_, states_);
  forces_.resize(m, 2 * m + r_);
  forces_ << f.stiffness(modes_, modes_), f.damping(modes_, modes_), input;
  a_ = MatrixXd::Zero(4 * m + r_, 4 * m + r_);
  a_.block(0, m, m, m).setIdentity();
  a_.block(m, 0, m, m) = stiffness;
  a_.block(m, m, m, m) = damping;
  a_.block(m, 2 * m, m, r_) = input;
  a_.block(m, 2 * m + r_, m, m).setIdentity();
  a_.block(2 * m, m, r_, m) = output;
  a_.block(2 * m, 2 * m, r_, r_) = rates;
  a_.block(2 * m + r_, 3 * m + r_, m, m).setIdentity();
  for (VectorXd* x : {&x_, &term_, &next_})
    *x = VectorXd::Zero(a_.rows());
  moved_ = VectorXd::Zero(7 * m + 2 * r_);
  make_flows(std::sqrt(row_sum(stiffness)) + row_sum(damping) + row_sum(rates) +
             std::sqrt(row_sum(input * output)));
}

void FeedbackBlock::make_flows(double rate) {
  const Index m = size(), n = a_.rows();
  const int halvings = std::max(1, 1 + static_cast<int>(std::ceil(std::log2(std::max(1.0, rate * step_)))));
  const double t = std::ldexp(step_, -halvings);
  MatrixXd flow = exponential(a_, t), path = MatrixXd::Zero(m, n), loss = MatrixXd::Zero(n, n);
  for (const auto& [abscissa, weight] : gauss)
    for (const double share : {0.5 * (1.0 - abscissa), 0.5 * (1.0 + abscissa)}) {
      const MatrixXd at = exponential(a_, share * t);
      path += 0.5 * weight * t * at.topRows(m);
      loss.noalias() +=
          0.5 * weight * t * at.middleRows(m, m).transpose() * (c_ * at.middleRows(m, m)).eval();
    }
  halves_.push_back(flow);
  for (int l = 0; l < halvings; ++l) {
    path += (path * flow).eval();
    loss += (flow.transpose() * (loss * flow).eval()).eval();
    flow = (flow * flow).eval();
    halves_.push_back(flow);
  }
  std::reverse(halves_.begin(), halves_.end());
  whole_.resize(moved_.size(), n);
  whole_ << flow.topRows(2 * m + r_), path, loss;
}

void FeedbackBlock::start(const double* q, const double* v, const double* z) {
  const Index m = size();
  for (Index i = 0; i < m; ++i) {
    x_(i) = q[modes_[static_cast<std::size_t>(i)]];
    x_(m + i) = v[modes_[static_cast<std::size_t>(i)]];
  }
  for (Index i = 0; i < r_; ++i)
    x_(2 * m + i) = z[states_[static_cast<std::size_t>(i)]];
}

double FeedbackBlock::energy() const {
  const Index m = size();
  return 0.5 * (moved_.segment(m, m).squaredNorm() + k_.dot(moved_.head(m).cwiseAbs2()));
}

FeedbackBlock::Works FeedbackBlock::advance(double* q, double* v, double* z, const double* load0,
                                            const double* load1, const double* mean, const double* slope) {
  const Index m = size();
  start(q, v, z);
  const double before = 0.5 * (x_.segment(m, m).squaredNorm() + k_.dot(x_.head(m).cwiseAbs2()));
  for (Index i = 0; i < m; ++i) {
    const Index j = modes_[static_cast<std::size_t>(i)];
    x_(2 * m + r_ + i) = load0[j] + mean[j] - slope[j];
    x_(3 * m + r_ + i) = (load1[j] - load0[j] + 2.0 * slope[j]) / step_;
  }
  moved_.noalias() = whole_ * x_;
  Works works;
  for (Index i = 0; i < m; ++i) { // int f q' dt by parts
    const Index j = modes_[static_cast<std::size_t>(i)];
    const double way = moved_(i) - q[j], late = moved_(i) - moved_(2 * m + r_ + i) / step_;
    works.load += load0[j] * way + (load1[j] - load0[j]) * late;
    works.contact += (mean[j] - slope[j]) * way + 2.0 * slope[j] * late;
    q[j] = moved_(i);
    v[j] = moved_(m + i);
  }
  for (Index i = 0; i < r_; ++i)
    z[states_[static_cast<std::size_t>(i)]] = moved_(2 * m + i);
  works.motion = energy() - before + x_.dot(moved_.tail(x_.size())) - works.load - works.contact;
  return works;
}

void FeedbackBlock::inside(double t, const double* q, const double* v, const double* z, const double* f0,
                           const double* slope, double* q_at, double* v_at) {
  const Index m = size();
  start(q, v, z);
  for (Index i = 0; i < m; ++i) {
    x_(2 * m + r_ + i) = f0[modes_[static_cast<std::size_t>(i)]];
    x_(3 * m + r_ + i) = slope[modes_[static_cast<std::size_t>(i)]];
  }
  double left = t, length = step_;
  for (std::size_t level = 0; level < halves_.size(); ++level, length *= 0.5)
    if (left >= length) {
      next_.noalias() = halves_[level] * x_;
      x_.swap(next_);
      left -= length;
    }
  term_ = x_;
  for (int j = 1; j < series_terms && left > 0.0; ++j) {
    next_.noalias() = a_ * term_;
    term_ = (left / j) * next_;
    x_ += term_;
  }
  for (Index i = 0; i < m; ++i) {
    q_at[modes_[static_cast<std::size_t>(i)]] = x_(i);
    v_at[modes_[static_cast<std::size_t>(i)]] = x_(m + i);
  }
}

void FeedbackBlock::add_forces(double* force) const {
  for (Index i = 0; i < size(); ++i)
    force[modes_[static_cast<std::size_t>(i)]] += forces_.row(i).dot(x_.head(forces_.cols()));
}

} // namespace fretwork::transient
