// SPDX-License-Identifier: GPL-3.0-or-later
#include "bench/stability_map.hpp"
#include "post/contact_statistics.hpp"
#include <cmath>
#include <limits>
#include <numbers>

namespace fretwork::bench {
namespace {

using namespace signals;
using namespace transient;

constexpr double rate = 1000.0; ///< rad/s: w_c, w_t

struct Run {
  double energy_ratio, friction_power;
  std::int64_t impacts;
  bool warned, done;
};

Run run(const Scene& scene, SchemeKind scheme, double step) {
  StepOptions options;
  options.scheme = scheme;
  options.step = step;
  const StepChoice choice = choose_step(scene, options);
  post::ContactStatistics statistics(scene.contacts, 0.25 * scene.duration);
  Observer* const observers[] = {&statistics};
  const Report report = transient::run(scene, choice, observers, nullptr, {});
  const post::ContactSummary s = statistics.summaries()[0];
  return {report.energy.stored / report.energy.initial, s.friction_power, s.impacts, !choice.warnings.empty(),
          report.outcome == Outcome::done};
}

} // namespace

MapPoint bouncing(SchemeKind scheme, double resolution, double mode) {
  constexpr double low = rate / 50.0, speed = 1.0, gap = 0.02 * speed / low, impacts_wanted = 100.0;
  // impacts are the gap's two crossings apart, and half a period of the contact
  const double duration = impacts_wanted * (2.0 * gap / speed + std::numbers::pi / rate);
  const bool high = mode > 0.0;
  Scene scene;
  scene.duration = duration;
  const Eigen::Index n = high ? 2 : 1;
  scene.system.stiffness.resize(n);
  scene.system.stiffness(0) = low * low;
  if (high)
    scene.system.stiffness(1) = mode * mode * rate * rate;
  scene.system.damping = scene.q0 = scene.v0 = Eigen::VectorXd::Zero(n);
  scene.v0(0) = speed;
  ContactPoint point;
  point.support.obstacle = contact::PlanePair{gap, contact::PlaneAxis::y};
  point.support.normal = {rate * rate};
  point.b = Eigen::MatrixXd::Zero(3, n);
  point.b(1, 0) = high ? std::sqrt(0.9) : 1.0;
  if (high)
    point.b(1, 1) = std::sqrt(0.1);
  scene.contacts = {point};
  const Run r = run(scene, scheme, resolution / rate);
  const double error =
      r.done ? std::log(r.energy_ratio) / impacts_wanted : std::numeric_limits<double>::infinity();
  return {resolution, error, r.warned};
}

MapPoint rubbing(SchemeKind scheme, double resolution, double damper) {
  constexpr double mu = 0.3, pressed = 1.0, stiffness = 1e4, forced = 0.05 * rate; // mass 1
  Scene scene;
  scene.duration = 20.0 * 2.0 * std::numbers::pi / forced;
  scene.system.stiffness = Eigen::VectorXd::Constant(1, std::pow(0.02 * rate, 2));
  scene.system.damping = scene.q0 = scene.v0 = Eigen::VectorXd::Zero(1);
  ContactPoint point;
  point.support.obstacle = contact::Stop{0.0, contact::PlaneAxis::z};
  point.support.normal = {stiffness};
  point.support.friction = {rate * rate, damper * rate, mu, mu};
  point.rest.z() = pressed / stiffness;
  point.b = Eigen::MatrixXd::Zero(3, 1);
  point.b(1, 0) = 1.0; // along the plane
  scene.contacts = {point};
  scene.loads = {{Harmonic{3.0 * mu * pressed, forced / (2.0 * std::numbers::pi)}, Eigen::VectorXd::Ones(1)}};
  const Run fine = run(scene, SchemeKind::splitting, 0.05 / rate / std::max(1.0, 0.25 * damper));
  const Run r = run(scene, scheme, resolution / rate);
  const bool ended = r.done && std::isfinite(r.friction_power);
  return {resolution,
          ended ? r.friction_power / fine.friction_power - 1.0 : std::numeric_limits<double>::infinity(),
          r.warned};
}

} // namespace fretwork::bench
