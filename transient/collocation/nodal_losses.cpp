// SPDX-License-Identifier: GPL-3.0-or-later
#include "transient/collocation/nodal_losses.hpp"
#include <algorithm>

namespace fretwork::transient {
namespace {

/// Derivative at the nodes of the quadratic through values at the nodes, times h.
constexpr double derivative[3][3] = {{-3.0, 4.0, -1.0}, {-1.0, 0.0, 1.0}, {1.0, -4.0, 3.0}};

/// Of one kind of loss, J in each half of the step.
void spread(const double (&loss)[2], const bool (&closed)[3], double h, double (&power)[3]) {
  const double all = 6.0 * (loss[0] + loss[1]) / h;
  for (int j = 0; j < 3; ++j)
    power[j] = closed[j] ? power[j] : 0.0;
  const double ends = power[0] + power[2];
  if (closed[1] && (all >= ends || !(ends > 0.0))) {
    power[1] = 0.25 * (all - ends);
    return;
  }
  power[1] = 0.0;
  if (closed[1]) {
    power[0] *= all / ends;
    power[2] *= all / ends;
  } else if (closed[0] && closed[2]) {
    power[0] = 6.0 * loss[0] / h;
    power[2] = 6.0 * loss[1] / h;
  } else {
    power[closed[0] ? 0 : 2] = all;
  }
}

} // namespace

Power power_of(const contact::Support& support, const ContactNode* nodes, int j, double h) {
  const ContactNode& n = nodes[j];
  Power out;
  out.damper = (n.normal - support.normal.stiffness * std::max(0.0, n.penetration)) * n.rate;
  if (!support.friction.active())
    return out;
  const double *d = derivative[j], scale = -1.0 / (support.friction.stiffness * h);
  const contact::Vec2 stretch =
      scale * (d[0] * nodes[0].spring + d[1] * nodes[1].spring + d[2] * nodes[2].spring);
  const double on_node = contact::dot(n.friction, n.slip), on_spring = contact::dot(n.spring, stretch);
  if (n.slides) { // a slider does not move with the force: there the bound clips a spring that lets go by itself
    const bool all = support.friction.kind == contact::FrictionMemoryKind::reference; // all motion is sliding
    out.slider = std::max(0.0, (all ? 0.0 : contact::dot(n.friction, stretch)) - on_node);
  }
  out.damper += on_spring - on_node - out.slider;
  return out;
}

void spread(const PathLoss* loss, const ContactNode* nodes, double h, Power* powers) {
  const bool closed[3] = {nodes[0].normal > 0.0, nodes[1].normal > 0.0, nodes[2].normal > 0.0};
  double slider[3] = {powers[0].slider, powers[1].slider, powers[2].slider},
         damper[3] = {powers[0].damper, powers[1].damper, powers[2].damper};
  spread({loss[0].slider, loss[1].slider - loss[0].slider}, closed, h, slider);
  const double damped[2] = {loss[0].damper - loss[0].forgotten, loss[1].damper - loss[1].forgotten};
  spread({damped[0], damped[1] - damped[0]}, closed, h, damper);
  for (int j = 0; j < 3; ++j)
    powers[j] = {slider[j], damper[j]};
}

} // namespace fretwork::transient
