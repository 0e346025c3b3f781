// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Random inputs of the tests, the same on every machine.
#pragma once
#include "contact/plane.hpp"
#include <cmath>
#include <numbers>
#include <random>

namespace fretwork::tests {

class Uniform {
public:
  explicit Uniform(std::uint64_t seed) : generator_(seed) {}
  double operator()(double low, double high) {
    return low + (high - low) * static_cast<double>(generator_() >> 11) * 0x1p-53;
  }
  /// Any order of magnitude from low to high.
  double scale(double low, double high) { return std::exp((*this)(std::log(low), std::log(high))); }
  /// A vector of any direction, of length up to `size`.
  contact::Vec2 vector(double size) {
    const double angle = (*this)(0.0, 2.0 * std::numbers::pi), length = (*this)(0.0, size);
    return {length * std::cos(angle), length * std::sin(angle)};
  }

private:
  std::mt19937_64 generator_;
};

} // namespace fretwork::tests
