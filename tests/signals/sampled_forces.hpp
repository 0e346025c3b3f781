// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Sampled loads of the tests: mode i has the force a_i sin(40 t + 1).
#pragma once
#include "signals/sampled_load.hpp"
#include <cmath>

namespace fretwork::tests {

class SineSamples final : public signals::ForceSamples {
public:
  SineSamples(Eigen::VectorXd amplitudes, double step) : amplitudes_(std::move(amplitudes)), step_(step) {}
  [[nodiscard]] static double value(double amplitude, double time) {
    return amplitude * std::sin(40.0 * time + 1.0);
  }
  [[nodiscard]] Eigen::Index rows() const override { return amplitudes_.size(); }
  [[nodiscard]] double step() const override { return step_; }
  void fill(std::int64_t first, Eigen::Ref<Eigen::MatrixXd> forces) override {
    for (Eigen::Index j = 0; j < forces.cols(); ++j)
      for (Eigen::Index i = 0; i < forces.rows(); ++i)
        forces(i, j) = value(amplitudes_(i), static_cast<double>(first + j) * step_);
  }

private:
  Eigen::VectorXd amplitudes_;
  double step_;
};

class SineSource final : public signals::ForceSource {
public:
  SineSource(Eigen::VectorXd amplitudes, double step)
      : samples_(std::make_shared<SineSamples>(std::move(amplitudes), step)) {}
  [[nodiscard]] std::shared_ptr<signals::ForceSamples> open() const override { return samples_; }

private:
  std::shared_ptr<SineSamples> samples_;
};

/// Amplitudes are kept as `rms`; a mode of amplitude 0 is not moved.
inline signals::SampledLoad sampled_sines(const std::vector<double>& amplitudes, double step) {
  signals::SampledLoad load;
  load.rms =
      Eigen::Map<const Eigen::VectorXd>(amplitudes.data(), static_cast<Eigen::Index>(amplitudes.size()));
  load.scale = (load.rms.array() != 0.0).cast<double>();
  for (Eigen::Index i = 0; i < load.rms.size(); ++i)
    load.rows.push_back(i);
  load.highest = 40.0 / 6.283;
  load.source = std::make_shared<SineSource>(load.rms, step);
  return load;
}

} // namespace fretwork::tests
