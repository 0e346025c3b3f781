// SPDX-License-Identifier: GPL-3.0-or-later
#include "signals/sampled_load.hpp"
#include <cassert>
#include <cmath>
#include <numbers>

namespace fretwork::signals {
namespace {

constexpr std::int64_t window = 64; ///< intervals between samples that are read together

} // namespace

SampledLoad SampledLoad::of_modes(const std::vector<Eigen::Index>& modes) const {
  SampledLoad out = *this;
  out.rows.clear();
  for (const Eigen::Index mode : modes)
    out.rows.push_back(rows[static_cast<std::size_t>(mode)]);
  out.scale = scale(modes);
  out.rms = rms(modes);
  return out;
}

void SampledLoad::multiply(const Eigen::VectorXd& factors) {
  scale.array() *= factors.array();
  rms.array() *= factors.array().abs();
}

SampledForce::SampledForce(const SampledLoad& load)
    : samples_(load.source->open()), rows_(load.rows), scale_(load.scale), ramp_(load.ramp),
      per_step_(1.0 / samples_->step()), window_(samples_->rows(), window + 1),
      forces_(load.scale.size(), window + 1) {}

void SampledForce::add(double time, double* force) {
  assert(time >= 0.0);
  const double place = time * per_step_;
  const auto sample = static_cast<std::int64_t>(place);
  if (const std::int64_t first = sample / window * window; first != first_) {
    samples_->fill(first, window_);
    for (Eigen::Index j = 0; j < forces_.cols(); ++j)
      for (Eigen::Index i = 0; i < forces_.rows(); ++i)
        forces_(i, j) = scale_(i) * window_(rows_[static_cast<std::size_t>(i)], j);
    first_ = first;
  }
  const double share = place - static_cast<double>(sample);
  const double start = time < ramp_ ? 0.5 * (1.0 - std::cos(std::numbers::pi * time / ramp_)) : 1.0;
  const Eigen::Index column = sample - first_;
  Eigen::Map<Eigen::VectorXd>(force, forces_.rows()) +=
      (start * (1.0 - share)) * forces_.col(column) + (start * share) * forces_.col(column + 1);
}

} // namespace fretwork::signals
