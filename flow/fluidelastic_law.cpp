// SPDX-License-Identifier: GPL-3.0-or-later
#include "flow/fluidelastic_law.hpp"
#include <cmath>

namespace fretwork::flow {
namespace {

using Complex = std::complex<double>;

FluidelasticLaw steady_part(double drag, double lift, const Eigen::Matrix2d& gradients) {
  FluidelasticLaw law;
  law.stiffness = gradients;
  law.damping << -2.0 * drag, lift, -2.0 * lift, -drag;
  return law;
}

// e^-x ~ D(-x)/D(x), D = 120 + 60 x + 12 x^2 + x^3
Complex pade(Complex x) { return 120.0 + x * (60.0 + x * (12.0 + x)); }
Complex pade_rate(Complex x) { return 60.0 + x * (24.0 + 3.0 * x); }

/// The root of D(-d) near a first value, by Newton's method.
Complex pade_root(Complex d) {
  for (int i = 0; i < 20; ++i)
    d += pade(-d) / pade_rate(-d);
  return d;
}

} // namespace

FluidelasticLaw quasi_steady_law(double drag, double lift, const Eigen::Matrix2d& gradients, double delay) {
  FluidelasticLaw law = steady_part(drag, lift, gradients);
  if (delay == 0.0)
    return law;
  for (const Complex first : {Complex(4.64, 0.0), Complex(3.68, 3.51)}) {
    const Complex d = pade_root(first), share = pade(d) / (pade_rate(-d) * d);
    const double pair = first.imag() == 0.0 ? 1.0 : 2.0;
    law.lags.push_back({d / delay, -pair * share * gradients.cast<Complex>()});
  }
  law.lags.front().rate = law.lags.front().rate.real(); // without round-off beside it
  return law;
}

FluidelasticLaw quasi_unsteady_law(double drag, double lift, const Eigen::Matrix2d& gradients,
                                   const std::vector<Memory>& memory) {
  FluidelasticLaw law = steady_part(drag, lift, gradients);
  for (const Memory& m : memory)
    law.lags.push_back({m.rate, (-m.share * gradients).cast<Complex>()});
  return law;
}

} // namespace fretwork::flow
