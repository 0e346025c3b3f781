// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cmath>
#include <complex>

namespace fretwork::tests {

struct InTime {
  double end, rate; ///< m, m/s
};

/// p'' = a - K p - C p' of a mass of 1 kg from p, v, after a time. Not where its damping is critical.
inline InTime oscillator_in_time(double stiffness, double damping, double acceleration, double p, double v,
                                 double time) {
  using Complex = std::complex<double>;
  const double rest = acceleration / stiffness;
  const Complex root = std::sqrt(Complex(0.25 * damping * damping - stiffness)), r1 = -0.5 * damping + root,
                r2 = -0.5 * damping - root;
  const Complex c1 = (v - r2 * (p - rest)) / (r1 - r2), c2 = p - rest - c1;
  const Complex e1 = c1 * std::exp(r1 * time), e2 = c2 * std::exp(r2 * time);
  return {rest + (e1 + e2).real(), (r1 * e1 + r2 * e2).real()};
}

} // namespace fretwork::tests
