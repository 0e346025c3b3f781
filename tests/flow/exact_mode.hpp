// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// A damped mode under a force that is linear between samples, without error of time integration:
/// z' = p z + F/M, p = w (-xi + i sqrt(1 - xi^2)), q = Im z/w_d, q' = Im(p z)/w_d.
#pragma once
#include <cmath>
#include <complex>

namespace fretwork::flow {

class ExactMode {
public:
  ExactMode(double mass, double omega, double damping, double step)
      : damped_(omega * std::sqrt(1.0 - damping * damping)), pole_(-damping * omega, damped_),
        decay_(std::exp(pole_ * step)) {
    const std::complex<double> mean = (decay_ - 1.0) / pole_;
    end_ = (mean / step - 1.0) / pole_ / mass;
    start_ = mean / mass - end_;
  }
  void advance(double from, double to) { z_ = decay_ * z_ + from * start_ + to * end_; }
  [[nodiscard]] double displacement() const { return z_.imag() / damped_; }
  [[nodiscard]] double velocity() const { return (pole_ * z_).imag() / damped_; }

private:
  double damped_;
  std::complex<double> pole_, decay_, start_, end_, z_ = 0.0;
};

} // namespace fretwork::flow
