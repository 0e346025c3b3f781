// SPDX-License-Identifier: GPL-3.0-or-later
#include "bench/random_scenes.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace fretwork::bench {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double outer = 0.01905, inner = outer - 2 * 0.00109, young = 2e11, mass_per_length = 1.0;
const double bending = young * pi / 64 * (std::pow(outer, 4) - std::pow(inner, 4)); // N m2

/// A simply supported tube; its modes, planes alternately, are `modes` columns of the scene from `first` on.
struct Tube {
  double span, length; ///< m
  int modes, supports, first;
  [[nodiscard]] double frequency(int half_waves) const { // rad/s
    return std::sqrt(bending / mass_per_length) * std::pow(half_waves * pi / length, 2);
  }
  [[nodiscard]] double largest_shape() const { return std::sqrt(2.0 / (mass_per_length * length)); }
  [[nodiscard]] double of_spans() const { return frequency(supports + 1); }
  /// Of contact points at x into b with a sign.
  void enter(Eigen::MatrixXd& b, double x, double sign) const {
    for (int i = 0; i < modes; ++i)
      b(1 + i % 2, first + i) = sign * largest_shape() * std::sin((i / 2 + 1) * pi * x / length);
  }
};

Tube draw_tube(Draw& draw, double span, int supports, int fewest, int most, int first) {
  const int least = std::max(fewest, 2 * (supports + 3));
  const int modes = draw.integer(least, std::max(least, std::min(most, 12 * (supports + 1))));
  return {span, span * (supports + 1), modes, supports, first};
}

void add_modes(transient::Scene& scene, const Tube& tube, double ratio) {
  scene.system.stiffness.conservativeResize(tube.first + tube.modes);
  for (int i = 0; i < tube.modes; ++i)
    scene.system.stiffness(tube.first + i) = std::pow(tube.frequency(i / 2 + 1), 2);
  scene.system.damping = 2.0 * ratio * scene.system.stiffness.cwiseSqrt();
}

/// Mean over the tube of what 1 kg^-1 its modes show at a point in one plane.
double mobility(const Tube& tube) { return 0.5 * (tube.modes / 2) * std::pow(tube.largest_shape(), 2); }

struct Laws {
  LawDraw draw;
  double normal_stiffness, ratio, gap;
  bool mixed = false; ///< each contact has laws of its own
};

/// Nothing moves along x_loc.
LawDraw draw_tube_laws(Draw& draw) {
  LawDraw out = draw_laws(draw);
  if (out.along.t == 0.0)
    out.along.t = 1.0;
  return out;
}

/// Laws in wider ranges.
LawDraw draw_mixed_laws(Draw& draw) {
  LawDraw out = draw_tube_laws(draw);
  if (out.normal_ratio > 0.0)
    out.normal_ratio = draw.logarithmic(0.01, 0.8);
  out.mu_dynamic = draw.logarithmic(0.05, 1.5);
  out.mu_static = out.mu_dynamic * (draw.chance(0.25) ? draw.uniform(1.1, 2.0) : 1.0);
  return out;
}

void add_supports(Draw& draw, transient::Scene& scene, const Tube& tube, const Laws& laws,
                  std::string& names) {
  const bool equal = draw.chance(0.7);
  const Draw same(draw.seed(), 0, 0);
  for (int c = 0; c < tube.supports; ++c) {
    Draw one = same; // equal obstacles: the same numbers for each
    const double size = laws.gap * draw.uniform(0.7, 1.3), overlap = laws.gap * draw.logarithmic(0.3, 2.0);
    const Place place = draw_place(equal ? one : draw, size, overlap, true);
    transient::ContactPoint point;
    point.name = "support";
    point.support.obstacle = place.obstacle;
    point.rest = place.rest;
    const double w_1 = tube.frequency(1), mass = 0.5 * mass_per_length * tube.length;
    const double stiffness = laws.normal_stiffness * (laws.mixed ? draw.logarithmic(0.1, 10.0) : 1.0);
    set_laws(point.support, laws.mixed ? draw_mixed_laws(draw) : laws.draw, stiffness, 1.0 / mobility(tube),
             {w_1 * w_1 * mass, mass, laws.ratio}, tube.of_spans() * laws.gap);
    point.b = Eigen::MatrixXd::Zero(3, scene.system.size());
    if (laws.mixed && c > 0 && draw.chance(0.15)) // at the same node
      point.b = scene.contacts.back().b;
    else
      tube.enter(point.b, tube.length * (c + 1 + draw.uniform(-0.25, 0.25)) / (tube.supports + 1), 1.0);
    scene.contacts.push_back(point);
    if (!equal || c == 0)
      names += (names.empty() ? "" : ", ") + place.name;
  }
}

/// Loads on the modes up to two more half-waves than there are spans, in both planes.
void add_loads(Draw& draw, transient::Scene& scene, const Tube& tube, double ratio, double amplitude,
               std::string& names) {
  const double f = tube.of_spans() / (2.0 * pi), unit = std::pow(tube.of_spans(), 2) / tube.largest_shape();
  const int loads = draw.integer(2, 4), loaded = std::min(tube.supports + 2, tube.modes / 2);
  for (int k = 0; k < loads; ++k) {
    const int plane = k % 2;
    vibration::Load load{draw_load(draw, f, ratio, f, amplitude * draw.logarithmic(0.3, 1.0)),
                         Eigen::VectorXd::Zero(scene.system.size())};
    if (k > 1 && draw.chance(0.3))
      load.function = signals::Constant{amplitude * draw.uniform(0.2, 1.0)};
    for (int j = 0; j < loaded; ++j)
      load.modal_force(tube.first + 2 * j + plane) = unit * draw.uniform(-1.0, 1.0) / std::sqrt(loaded / 3.0);
    names += letter_of(load.function);
    scene.loads.push_back(load);
  }
}

/// Motion along x_loc: one mode that all contacts share, of a mass 3 to 1000 times that of bending, with a load.
void add_axis(Draw& draw, transient::Scene& scene, const Tube& tube, double ratio, double gap,
              std::string& names) {
  const double lightness = draw.logarithmic(1e-3, 0.3), shape = std::sqrt(lightness * mobility(tube)),
               f = tube.of_spans() / (2.0 * pi) * draw.logarithmic(0.5, 5.0), omega = 2.0 * pi * f;
  const Eigen::Index axis = scene.system.size();
  scene.system.stiffness.conservativeResize(axis + 1);
  scene.system.damping.conservativeResize(axis + 1);
  scene.system.stiffness(axis) = omega * omega;
  scene.system.damping(axis) = 2.0 * ratio * omega;
  const bool axial = draw.chance(0.3);
  for (transient::ContactPoint& point : scene.contacts) {
    point.b.conservativeResizeLike(Eigen::MatrixXd::Zero(3, axis + 1));
    point.b(0, axis) = shape;
    if (axial) {
      point.support.friction.along = {1.0, 0.0};
      point.support.friction.damping /= std::sqrt(lightness);
    }
  }
  for (vibration::Load& load : scene.loads)
    load.modal_force.conservativeResizeLike(Eigen::VectorXd::Zero(axis + 1));
  vibration::Load along{
      draw_load(draw, f, ratio, tube.of_spans() / (2.0 * pi), gap * draw.logarithmic(0.1, 2.0)),
      Eigen::VectorXd::Zero(axis + 1)};
  along.modal_force(axis) = omega * omega / shape;
  names +=
      fmt::format("{}, m_x/m {:.0f}{}", letter_of(along.function), 1.0 / lightness, axial ? " axial" : "");
  scene.loads.push_back(along);
}

void finish(RandomScene& out, const Tube& tube, double gap) {
  out.scene.q0 = out.scene.v0 = Eigen::VectorXd::Zero(out.scene.system.size());
  out.period = 2.0 * pi / tube.of_spans();
  out.gap = gap;
}

/// Contact between two tubes at x of each.
transient::ContactPoint between(Draw& draw, const Tube& a, const Tube& b, double gap, double overlap,
                                double share, std::string& name) {
  using contact::PlaneAxis;
  transient::ContactPoint point;
  point.name = "between";
  const double situation = draw.uniform(0.0, 1.0), shape = draw.uniform(0.0, 1.0),
               angle = draw.uniform(0.0, 2.0 * pi);
  const double clearance = situation < 0.5 ? gap : situation < 0.65 ? 0.0 : -overlap;
  if (shape < 0.6) {
    point.support.obstacle = contact::RoundPair{outer};
    point.rest = (outer + clearance) * core::Vec3{0.0, std::cos(angle), std::sin(angle)};
    name = "round pair";
  } else if (shape < 0.8) {
    const PlaneAxis axis = draw.chance(0.5) ? PlaneAxis::y : PlaneAxis::z;
    point.support.obstacle = contact::FacingPlanes{outer, axis, 1.0};
    point.rest(axis == PlaneAxis::y ? 1 : 2) = outer + clearance;
    name = "facing planes";
  } else {
    point.support.obstacle = contact::Circle{gap};
    point.rest = (gap - clearance) * core::Vec3{0.0, std::cos(angle), std::sin(angle)};
    name = "ring";
  }
  name += situation < 0.5 ? "" : situation < 0.65 ? " touching" : " pressed";
  point.b = Eigen::MatrixXd::Zero(3, b.first + b.modes);
  a.enter(point.b, share * a.length, 1.0);
  b.enter(point.b, share * b.length, -1.0);
  return point;
}

} // namespace

RandomScene random_tube(Draw& draw, bool mixed) {
  RandomScene out;
  const int supports = std::min(20, static_cast<int>(draw.logarithmic(1.0, 21.0)));
  const Tube tube = draw_tube(draw, draw.logarithmic(0.4, 1.2), supports, 15, 60, 0);
  const double ratio = draw.logarithmic(mixed ? 0.0005 : 0.003, 0.03), gap = draw.logarithmic(2e-5, 4e-4);
  const double frequency_ratio = draw.logarithmic(5.0, mixed ? 100.0 : 50.0);
  add_modes(out.scene, tube, ratio);
  const Laws laws{draw_tube_laws(draw), std::pow(frequency_ratio * tube.of_spans(), 2) / mobility(tube),
                  ratio, gap, mixed};
  std::string places, loads;
  add_supports(draw, out.scene, tube, laws, places);
  add_loads(draw, out.scene, tube, ratio, gap * draw.logarithmic(0.5, 3.0), loads);
  if (draw.chance(heavy_axes))
    add_axis(draw, out.scene, tube, ratio, gap, loads);
  finish(out, tube, gap);
  out.description = fmt::format(
      "{} modes, {} contacts: {}, w_c/w_s {:.0f}, {}, loads {}, {:.3g} Hz, zeta {:.2g}, gap {:.2g} mm",
      tube.modes, supports, places, frequency_ratio, mixed ? "mixed laws" : described(laws.draw), loads,
      1.0 / out.period, ratio, 1e3 * gap);
  return out;
}

RandomScene random_pair(Draw& draw) {
  RandomScene out;
  const double span = draw.logarithmic(0.4, 1.2), ratio = draw.logarithmic(0.003, 0.03),
               gap = draw.logarithmic(2e-5, 4e-4);
  const double frequency_ratio = draw.logarithmic(5.0, 50.0);
  const int supports = draw.integer(1, 4), bridges = draw.integer(1, 3);
  const Tube a = draw_tube(draw, span, supports, 15, 30, 0);
  const Tube b = draw_tube(draw, span * draw.uniform(0.8, 1.2), supports, 15, 30, a.modes);
  add_modes(out.scene, a, ratio);
  add_modes(out.scene, b, ratio);
  const Laws laws{draw_tube_laws(draw), std::pow(frequency_ratio * a.of_spans(), 2) / mobility(a), ratio,
                  gap};
  std::string places, loads, bridge;
  add_supports(draw, out.scene, a, laws, places);
  add_supports(draw, out.scene, b, laws, places);
  const double first = draw.uniform(0.2, 0.45) / (supports + 1);
  for (int k = 0; k < bridges; ++k) {
    const double overlap = gap * draw.logarithmic(0.3, 2.0);
    auto point = between(draw, a, b, gap, overlap, first + (k + 0.5) / (bridges + 1.0), bridge);
    const double mass = 0.5 * mass_per_length * a.length;
    set_laws(point.support, laws.draw, laws.normal_stiffness, 1.0 / (mobility(a) + mobility(b)),
             {std::pow(a.frequency(1), 2) * mass, mass, ratio}, a.of_spans() * gap);
    out.scene.contacts.push_back(point);
    places += ", " + bridge;
  }
  const double amplitude = gap * draw.logarithmic(0.5, 3.0);
  add_loads(draw, out.scene, a, ratio, amplitude, loads);
  add_loads(draw, out.scene, b, ratio, amplitude, loads);
  finish(out, a, gap);
  out.first_modes = {a.first, b.first};
  out.description = fmt::format(
      "{} + {} modes, {} contacts: {}, w_c/w_s {:.0f}, {}, loads {}, {:.3g} Hz, zeta {:.2g}, gap {:.2g} mm",
      a.modes, b.modes, out.scene.contacts.size(), places, frequency_ratio, described(laws.draw), loads,
      1.0 / out.period, ratio, 1e3 * gap);
  return out;
}

} // namespace fretwork::bench
