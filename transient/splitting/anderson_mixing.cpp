// SPDX-License-Identifier: GPL-3.0-or-later
#include "transient/splitting/anderson_mixing.hpp"
#include <Eigen/Cholesky>

namespace fretwork::transient {
namespace {

/// Of a residual from one iteration to the next: growth above it is a kink.
constexpr double kink = 2.0;
/// Of the largest diagonal term of the normal equations: below it directions are the same to round-off.
constexpr double same_direction = 1e-14;

} // namespace

AndersonMixing::AndersonMixing(Eigen::Index most)
    : last_g_(most), last_r_(most), r_(most), dg_(most, depth), dr_(most, depth) {}

void AndersonMixing::restart(Eigen::Index n) {
  n_ = n;
  known_ = at_ = 0;
  first_ = true;
}

void AndersonMixing::next(Eigen::VectorXd& x, const Eigen::VectorXd& g) {
  auto r = r_.head(n_);
  r = g.head(n_) - x.head(n_);
  const double size = r.norm();
  if (!first_ && size > kink * size_)
    known_ = at_ = 0;
  else if (!first_) {
    dg_.col(at_).head(n_) = g.head(n_) - last_g_.head(n_);
    dr_.col(at_).head(n_) = r - last_r_.head(n_);
    at_ = (at_ + 1) % static_cast<int>(depth);
    known_ = std::min(known_ + 1, static_cast<int>(depth));
  }
  first_ = false;
  size_ = size;
  last_g_.head(n_) = g.head(n_);
  last_r_.head(n_) = r;
  x.head(n_) = g.head(n_);
  if (known_ == 0)
    return;
  using Normal = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, depth, depth>;
  using Share = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, depth, 1>;
  Normal m(known_, known_);
  Share b(known_);
  for (int i = 0; i < known_; ++i) {
    b(i) = dr_.col(i).head(n_).dot(r);
    for (int j = 0; j <= i; ++j)
      m(i, j) = m(j, i) = dr_.col(i).head(n_).dot(dr_.col(j).head(n_));
  }
  m.diagonal().array() += same_direction * m.diagonal().maxCoeff();
  const Share share = m.ldlt().solve(b);
  if (!share.allFinite())
    return;
  for (int i = 0; i < known_; ++i)
    x.head(n_) -= share(i) * dg_.col(i).head(n_);
}

} // namespace fretwork::transient
