// SPDX-License-Identifier: GPL-3.0-or-later
#include "bench/scenes.hpp"
#include "bench/tube_scene.hpp"
#include <cmath>
#include <numbers>

namespace fretwork::bench {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double outer = 0.01905, inner = outer - 2 * 0.00109, young = 2e11, mass_per_length = 1.0,
                 ratio = 0.005, friction = 0.3, duration = 10.0;

struct Tube {
  std::string name;
  double length; ///< m
  int modes, supports;
  double normal_stiffness, highest_force; ///< N/m, Hz
  double force;                           ///< N/m, rms
};

/// Value at x of mode i (planes alternate), of unit modal mass.
double shape(const Tube& tube, int mode, double x) {
  return std::sqrt(2.0 / (mass_per_length * tube.length)) * std::sin((mode / 2 + 1) * pi * x / tube.length);
}

/// Places that no mode has as its nodes, gaps from 0.14 to 0.26 mm.
transient::ContactPoint support(const Tube& tube, const vibration::System& system, int c) {
  const double uneven = 0.13 * std::sin(2.4 * c + 1.0),
               x = tube.length * (c + 1 + uneven) / (tube.supports + 1);
  const double k_t = 0.5 * tube.normal_stiffness, mass = 0.5 * mass_per_length * tube.length;
  transient::ContactPoint point;
  point.name = "support";
  point.support.obstacle = contact::Circle{1e-4 * (2.0 + 0.6 * std::sin(1.7 * c + 0.5))};
  point.support.normal = {tube.normal_stiffness};
  point.support.friction = {
      k_t, contact::automatic_tangential_damping(k_t, system.stiffness(0) * mass, mass, ratio), friction,
      friction};
  point.b = Eigen::MatrixXd::Zero(3, tube.modes);
  for (int i = 0; i < tube.modes; ++i)
    point.b(1 + i % 2, i) = shape(tube, i, x);
  return point;
}

/// Modal forces of `waves` half-waves along the tube, 0 of a uniform force, in one plane.
Eigen::VectorXd along(const Tube& tube, int plane, int waves) {
  Eigen::VectorXd force = Eigen::VectorXd::Zero(tube.modes);
  const double unit = std::sqrt(tube.length / (2.0 * mass_per_length)); // of a mode's own half-waves
  for (int i = plane; i < tube.modes; i += 2) {
    const int n = i / 2 + 1;
    if (waves > 0)
      force(i) = n == waves ? unit : 0.0;
    else
      force(i) = n % 2 == 1 ? unit * 4.0 / (n * pi) : 0.0;
  }
  return force;
}

transient::Scene scene_of(const Tube& tube) {
  const double inertia = pi / 64 * (std::pow(outer, 4) - std::pow(inner, 4));
  transient::Scene scene;
  scene.duration = duration;
  scene.system.stiffness.resize(tube.modes);
  for (int i = 0; i < tube.modes; ++i)
    scene.system.stiffness(i) =
        std::pow((i / 2 + 1) * pi / tube.length, 4) * young * inertia / mass_per_length;
  scene.system.damping = 2.0 * ratio * scene.system.stiffness.cwiseSqrt();
  for (int c = 0; c < tube.supports; ++c)
    scene.contacts.push_back(support(tube, scene.system, c));
  const auto noise = [&](std::uint64_t seed) {
    return signals::Random{tube.force, 2.0, tube.highest_force, seed};
  };
  scene.loads = {{noise(1), along(tube, 0, 0)},
                 {noise(2), along(tube, 1, 1)},
                 {noise(3), along(tube, 1, 2)},
                 {noise(4), along(tube, 0, tube.supports + 1)}};
  scene.q0 = scene.v0 = Eigen::VectorXd::Zero(tube.modes);
  return scene;
}

} // namespace

std::vector<NamedScene> rattling_tubes() {
  std::vector<NamedScene> out;
  for (const Tube& tube :
       {Tube{"3 supports", 3.0, 40, 3, 1e6, 100.0, 20.0}, Tube{"10 supports", 9.0, 60, 10, 1e6, 100.0, 10.0},
        Tube{"10 stiff supports", 9.0, 60, 10, 1e8, 100.0, 10.0},
        Tube{"10 soft supports", 9.0, 60, 10, 1e5, 100.0, 10.0},
        Tube{"high modes", 1.2, 40, 3, 1e6, 200.0, 60.0}})
    out.push_back({tube.name, scene_of(tube)});
  out.push_back({"straight_tube", tube_scene({})});
  for (const Tube& tube :
       {Tube{"1 support, 1e7", 1.0, 16, 1, 1e7, 200.0, 60.0},
        Tube{"3 supports, 1e7", 3.0, 40, 3, 1e7, 100.0, 20.0},
        Tube{"3 supports, 1e8", 3.0, 20, 3, 1e8, 100.0, 20.0},
        Tube{"5 supports, 1e9", 9.0, 40, 5, 1e9, 60.0, 10.0},
        Tube{"1 support, 1e9", 3.0, 24, 1, 1e9, 100.0, 20.0}, // these two bounce to and fro
        Tube{"2 supports, 1e8, hard", 4.0, 20, 2, 1e8, 100.0, 40.0},
        Tube{"6 supports, 3e7, hard", 5.0, 60, 6, 3e7, 100.0, 40.0},
        Tube{"10 supports, 1e7", 9.0, 60, 10, 1e7, 100.0, 10.0},
        Tube{"10 supports, 1e8, hard", 9.0, 60, 10, 1e8, 100.0, 40.0},
        Tube{"20 supports, 1e7", 18.0, 100, 20, 1e7, 50.0, 8.0}})
    out.push_back({tube.name, scene_of(tube)});
  return out;
}

} // namespace fretwork::bench
