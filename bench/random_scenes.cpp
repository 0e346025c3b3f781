// SPDX-License-Identifier: GPL-3.0-or-later
#include "bench/random_scenes.hpp"
#include "contact/support_shapes.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace fretwork::bench {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double tube_radius = 0.009525; // m

/// How far from the obstacle's centre a node stands whose gap is `target`, m.
double distance_of(const contact::Obstacle& obstacle, double angle, double target, double most) {
  double low = 0.0, high = most;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    const double gap = contact::locate(obstacle, middle * std::cos(angle), middle * std::sin(angle)).gap;
    (gap > target ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

} // namespace

std::string name_of(SceneKind kind) {
  switch (kind) {
  case SceneKind::mass:
    return "mass";
  case SceneKind::tube:
    return "tube";
  case SceneKind::pair:
    return "pair";
  case SceneKind::mixed:
    return "mixed";
  }
  return {};
}

Draw::Draw(std::uint64_t seed, std::uint64_t kind, std::uint64_t number) {
  std::uint64_t mixed = 0; // splitmix64 of the three
  for (const std::uint64_t part : {seed, kind + 1, number + 1}) {
    mixed += part + 0x9e3779b97f4a7c15U;
    mixed = (mixed ^ (mixed >> 30)) * 0xbf58476d1ce4e5b9U;
    mixed = (mixed ^ (mixed >> 27)) * 0x94d049bb133111ebU;
    mixed ^= mixed >> 31;
  }
  generator_.seed(mixed);
}
double Draw::uniform(double low, double high) {
  return low + (high - low) * ((static_cast<double>(generator_() >> 11) + 0.5) * 0x1p-53);
}
double Draw::logarithmic(double low, double high) {
  return low * std::exp(uniform(0.0, std::log(high / low)));
}
int Draw::integer(int low, int high) {
  return std::min(high, low + static_cast<int>(uniform(0.0, high - low + 1.0)));
}
std::uint64_t Draw::seed() { return generator_() >> 33; }

LawDraw draw_laws(Draw& draw) {
  LawDraw out{};
  const double damper = draw.uniform(0.0, 1.0);
  out.normal_ratio = damper < 0.5 ? draw.uniform(0.01, 0.3) : 0.0;
  out.dissipation_number = damper > 0.9 ? draw.uniform(0.05, 0.5) : 0.0;
  out.mu_dynamic = draw.uniform(0.1, 1.0);
  out.mu_static = out.mu_dynamic * (draw.chance(0.25) ? draw.uniform(1.1, 1.6) : 1.0);
  out.stiffness_ratio = draw.logarithmic(0.01, 1.0);
  const double tangential = draw.uniform(0.0, 1.0), ratio = draw.logarithmic(0.05, 1.0);
  out.tangential_ratio = tangential < 0.2 ? 0.0 : tangential < 0.5 ? -1.0 : ratio;
  const double along = draw.uniform(0.0, 1.0);
  out.along = along < 0.1   ? contact::Vec2{1.0, 0.0}
              : along < 0.2 ? contact::Vec2{0.0, 1.0}
                            : contact::Vec2{1.0, 1.0};
  return out;
}

void set_laws(contact::Support& support, const LawDraw& laws, double normal_stiffness, double mass,
              const DampedMode& mode, double speed) {
  support.normal = {normal_stiffness, 2.0 * laws.normal_ratio * std::sqrt(normal_stiffness * mass),
                    laws.dissipation_number / speed};
  const double k = laws.stiffness_ratio * normal_stiffness;
  const double damping = laws.tangential_ratio < 0.0
                             ? contact::automatic_tangential_damping(k, mode.stiffness, mode.mass, mode.ratio)
                             : 2.0 * laws.tangential_ratio * std::sqrt(k * mass);
  support.friction = {
      k, damping, laws.mu_static, laws.mu_dynamic, contact::FrictionMemoryKind::return_map, laws.along};
}

std::string described(const LawDraw& laws) {
  std::string out = laws.dissipation_number > 0.0 ? fmt::format("d v {:.2f}", laws.dissipation_number)
                                                  : fmt::format("xi_N {:.2g}", laws.normal_ratio);
  out += fmt::format(", mu {:.2f}", laws.mu_dynamic);
  if (laws.mu_static > laws.mu_dynamic)
    out += fmt::format(" ({:.2f})", laws.mu_static);
  out += fmt::format(", K_T/K_N {:.2g}, ", laws.stiffness_ratio);
  out += laws.tangential_ratio < 0.0    ? "C_T auto"
         : laws.tangential_ratio == 0.0 ? "C_T 0"
                                        : fmt::format("xi_T {:.2f}", laws.tangential_ratio);
  if (laws.along.t == 0.0)
    out += ", axial";
  if (laws.along.x == 0.0)
    out += ", transverse";
  return out;
}

Place draw_place(Draw& draw, double gap, double overlap, bool tube) {
  using contact::PlaneAxis;
  Place out{contact::Circle{gap}, core::Vec3::Zero(), "circle"};
  double angle = draw.uniform(0.0, 2.0 * pi); // of a rest position away from the middle
  const PlaneAxis axis = draw.chance(0.5) ? PlaneAxis::y : PlaneAxis::z;
  const double across = axis == PlaneAxis::y ? 0.0 : 0.5 * pi, back = draw.chance(0.5) ? pi : 0.0;
  const std::string letter = axis == PlaneAxis::y ? "y" : "z";
  const double shape = draw.uniform(0.0, 1.0), second = gap * draw.uniform(0.5, 2.0),
               turn = draw.uniform(0.0, pi);
  if (shape < 0.25) {
    out.obstacle = contact::PlanePair{gap, axis};
    out.name = (tube ? "bars_" : "plane_") + letter;
    angle = across + back;
  } else if (shape < 0.45) {
    out.obstacle = contact::Stop{gap, axis};
    out.name = "stop_" + letter;
    angle = across;
  } else if (shape < 0.6) {
    out.obstacle = contact::egg_crate(tube_radius, tube_radius + gap, tube_radius + second);
    out.name = "egg crate";
  } else if (shape < 0.75 && tube) {
    const int lands = draw.chance(0.5) ? 3 : 4;
    out.obstacle = contact::BroachedSpace(
        tube_radius, {tube_radius + gap, tube_radius + gap + 0.0025, lands, draw.uniform(0.25, 0.5), turn});
    out.name = lands == 3 ? "trefoil" : "quatrefoil";
  } else if (shape < 0.85 && tube) {
    out.obstacle = contact::drilled_hole(tube_radius, tube_radius + gap);
    out.name = "drilled";
  }
  const double situation = draw.uniform(0.0, 1.0), share = draw.uniform(0.05, 0.9);
  if (situation < 0.5)
    return out;
  const double target = situation < 0.6 ? 0.0 : situation < 0.8 ? share * gap : -overlap;
  const double r = distance_of(out.obstacle, angle, target, 20.0 * (gap + overlap));
  out.rest = {0.0, r * std::cos(angle), r * std::sin(angle)};
  out.name += situation < 0.6 ? " touching" : situation < 0.8 ? " off its middle" : " pressed";
  return out;
}

signals::TimeFunction draw_load(Draw& draw, double frequency, double ratio, double about, double amplitude) {
  const double kind = draw.uniform(0.0, 1.0);
  if (kind < 0.45) {
    const double f = about * draw.logarithmic(0.4, 3.0), r = f / frequency;
    const double gain = std::clamp(std::hypot(1.0 - r * r, 2.0 * ratio * r), 0.1, 3.0);
    return signals::Harmonic{std::numbers::sqrt2 * amplitude * gain, f, draw.uniform(0.0, 2.0 * pi)};
  }
  if (kind > 0.85) {
    const double distance = draw.logarithmic(0.05, 0.5) / about; // of two rows, the mean
    const double resonance = pi * frequency * distance / (2.0 * ratio);
    const double largest = amplitude * std::sqrt(3.0 / (1.0 + resonance));
    signals::Table out;
    for (double time = 0.0; time < 2.0 * most_periods / about; time += distance * draw.uniform(0.3, 1.7)) {
      out.time.push_back(time);
      out.value.push_back(largest * draw.uniform(-1.0, 1.0));
    }
    return out;
  }
  const double low = about * draw.uniform(0.2, 0.7), high = about * draw.logarithmic(2.0, 8.0);
  const double resonance = pi * frequency / (4.0 * ratio * (high - low));
  return signals::Random{amplitude / std::sqrt(1.0 + resonance), low, high, draw.seed()};
}

char letter_of(const signals::TimeFunction& load) {
  return std::holds_alternative<signals::Harmonic>(load) ? 'h'
         : std::holds_alternative<signals::Random>(load) ? 'r'
         : std::holds_alternative<signals::Table>(load)  ? 't'
                                                         : 'c';
}

RandomScene random_mass(Draw& draw) {
  RandomScene out;
  const double mass = draw.logarithmic(0.1, 2.0), lowest = draw.logarithmic(5.0, 40.0),
               ratio = draw.logarithmic(0.005, 0.05), gap = draw.logarithmic(2e-5, 5e-4);
  const double frequency_ratio = draw.logarithmic(5.0, 50.0);
  double frequency[3] = {lowest, lowest * draw.uniform(1.0, 2.5), lowest * draw.uniform(1.0, 2.5)}; // Hz
  std::swap(frequency[0], frequency[draw.integer(0, 2)]);
  transient::Scene& scene = out.scene;
  scene.system.stiffness.resize(3);
  for (int i = 0; i < 3; ++i)
    scene.system.stiffness(i) = std::pow(2.0 * pi * frequency[i], 2);
  scene.system.damping = 2.0 * ratio * scene.system.stiffness.cwiseSqrt();
  scene.q0 = scene.v0 = Eigen::VectorXd::Zero(3);
  const LawDraw laws = draw_laws(draw);
  const Place place = draw_place(draw, gap, gap * draw.logarithmic(0.3, 2.0), false);
  transient::ContactPoint point;
  point.name = "c";
  point.rest = place.rest;
  point.support.obstacle = place.obstacle;
  const double w_n = 2.0 * pi * std::max(frequency[1], frequency[2]);
  set_laws(point.support, laws, mass * std::pow(2.0 * pi * lowest * frequency_ratio, 2), mass,
           {mass * scene.system.stiffness(0), mass, ratio}, w_n * gap);
  point.b = Eigen::MatrixXd::Identity(3, 3) / std::sqrt(mass);
  scene.contacts.push_back(point);
  const double amplitude = gap * draw.logarithmic(1.0, 4.0), tangential = draw.logarithmic(0.1, 2.0);
  std::string loads;
  for (int i = 0; i < 3; ++i) {
    const double size = amplitude * (i == 0 ? tangential : draw.logarithmic(0.4, 1.6));
    vibration::Load load{draw_load(draw, frequency[i], ratio, lowest, size), Eigen::VectorXd::Zero(3)};
    load.modal_force(i) = std::sqrt(mass) * scene.system.stiffness(i);
    const bool none = i == 0 && draw.chance(0.15);
    loads += none ? '-' : letter_of(load.function);
    if (!none)
      scene.loads.push_back(load);
    if (draw.chance(0.25)) {
      load.function = signals::Constant{amplitude * draw.uniform(-1.0, 1.0)};
      scene.loads.push_back(load);
      loads += 'c';
    }
  }
  if (draw.chance(heavy_axes)) {
    const double lightness = draw.logarithmic(1e-3, 0.3), heavier = 1.0 / std::sqrt(lightness);
    scene.contacts[0].b.row(0) /= heavier;
    for (vibration::Load& load : scene.loads)
      load.modal_force(0) *= heavier;
    if (laws.along.t == 0.0)
      scene.contacts[0].support.friction.damping *= heavier;
    loads += fmt::format(", m_x/m {:.0f}", 1.0 / lightness);
  }
  out.period = 1.0 / lowest;
  out.gap = gap;
  out.description =
      fmt::format("{}, w_c/w_1 {:.0f}, {}, loads {}, {:.3g} Hz, zeta {:.2g}, gap {:.2g} mm", place.name,
                  frequency_ratio, described(laws), loads, lowest, ratio, 1e3 * gap);
  return out;
}

RandomScene random_scene(SceneKind kind, std::uint64_t seed, int number) {
  Draw draw(seed, static_cast<std::uint64_t>(kind), static_cast<std::uint64_t>(number));
  RandomScene out = kind == SceneKind::mass   ? random_mass(draw)
                    : kind == SceneKind::pair ? random_pair(draw)
                                              : random_tube(draw, kind == SceneKind::mixed);
  out.kind = kind;
  out.name = fmt::format("{}-{}", name_of(kind), number);
  out.scene.duration = 100.0 * out.period;
  return out;
}

} // namespace fretwork::bench
