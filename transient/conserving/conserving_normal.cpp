// SPDX-License-Identifier: GPL-3.0-or-later
#include "transient/conserving/conserving_normal.hpp"
#include <algorithm>
#include <cmath>

namespace fretwork::transient {

double end_rate_share(double damping, double mobility) {
  const double z = damping * mobility;
  if (!(z > 0.0))
    return 0.0;
  constexpr double small = 0.02; // its series then has 1e-9 of itself, the difference 1e-12
  return z < small ? z / 6.0 * (1.0 - z * z / 60.0) : 1.0 / std::tanh(0.5 * z) - 2.0 / z;
}

StepNormal step_normal_force(const contact::NormalLaw& law, double share, double p0, double p1, double rate,
                             double h) {
  StepNormal out;
  const double mean = contact::mean_penetration(p0, p1), sunk = std::max(0.0, p1);
  const double mean_rate = (p1 - p0) / h, by_mean = contact::mean_slopes(p0, p1).by_p2;
  out.spring = law.stiffness * mean;
  out.force = out.spring * (1.0 + law.dissipation * mean_rate);
  out.by_end = law.stiffness * (by_mean + law.dissipation * sunk / h);
  if (!(law.damping > 0.0))
    return out;
  out.force += law.damping * (1.0 - share) * (sunk - std::max(0.0, p0)) / h;
  out.by_end += p1 > 0.0 ? law.damping * (1.0 - share) / h : 0.0;
  if (!(rate * mean_rate > 0.0))
    return out;
  const double closed = contact::closed_share(p0, p1);
  out.force += law.damping * share * closed * rate;
  out.by_rate = law.damping * share * closed;
  if (closed < 1.0) // of the share by p1
    out.by_end += law.damping * share * rate * std::abs(p0) / ((p1 - p0) * (p1 - p0));
  return out;
}

} // namespace fretwork::transient
