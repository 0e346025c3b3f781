// SPDX-License-Identifier: GPL-3.0-or-later
#include "bench/tube_scene.hpp"
#include <cmath>
#include <numbers>

namespace fretwork::bench {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double outer = 0.01905, inner = outer - 2 * 0.00109, young = 2e11, poisson = 0.3, density = 12000.0,
                 ratio = 0.01;

} // namespace

transient::Scene tube_scene(const TubeScene& tube) {
  const double area = pi / 4 * (outer * outer - inner * inner);
  const double inertia = pi / 64 * (std::pow(outer, 4) - std::pow(inner, 4));
  const double length = tube.length;
  const auto shape = [&](int mode, double x) {
    return std::sqrt(2 / (density * area * length)) * std::sin((mode / 2 + 1) * pi * x / length);
  };
  const int bending = tube.modes - tube.modes % 2;
  transient::Scene scene;
  scene.duration = tube.duration;
  scene.system.stiffness.resize(tube.modes);
  scene.system.damping.resize(tube.modes);
  for (int i = 0; i < tube.modes; ++i) {
    const double k = (i / 2 + 1) * pi / length;
    const double omega = i < bending ? k * k * std::sqrt(young * inertia / (density * area))
                                     : pi / length * std::sqrt(young / (2 * (1 + poisson) * density));
    scene.system.stiffness(i) = omega * omega;
    scene.system.damping(i) = 2 * ratio * omega;
  }
  for (int c = 0; c < tube.supports; ++c) {
    transient::ContactPoint point;
    point.name = "support";
    point.support.obstacle = contact::Circle{tube.gap};
    point.support.normal = {tube.normal_stiffness, 20.0};
    if (tube.friction > 0.0)
      point.support.friction = {tube.normal_stiffness, tube.tangential_damping, tube.friction, tube.friction};
    point.b = Eigen::MatrixXd::Zero(3, tube.modes);
    const double x = length * (c + 1) / (tube.supports + 1);
    for (int i = 0; i < bending; ++i)
      point.b(1 + i % 2, i) = shape(i, x);
    scene.contacts.push_back(point);
  }
  vibration::Load y{signals::Harmonic{20.0, 37.0}, Eigen::VectorXd::Zero(tube.modes)};
  vibration::Load z{signals::Harmonic{15.0, 53.0}, Eigen::VectorXd::Zero(tube.modes)};
  for (int span = 0; span <= tube.supports; ++span)
    for (int i = 0; i < bending; ++i) {
      const double force = shape(i, length * (span + 0.5) / (tube.supports + 1));
      if (i % 2 == 0)
        y.modal_force(i) += force;
      else if (span % 2 == 0 && span < tube.supports)
        z.modal_force(i) += force;
    }
  scene.loads = {y, z};
  scene.q0 = scene.v0 = Eigen::VectorXd::Zero(tube.modes);
  return scene;
}

} // namespace fretwork::bench
