// SPDX-License-Identifier: GPL-3.0-or-later
// Cost of whole runs of the splitting scheme, 10 s of tubes in steps that give statistics to 1 %, with statistics and without; what
// a run saves that leaves out the modes that nothing moves; and what a fluidelastic law costs.
#include "bench/thread_time.hpp"
#include "bench/tube_scene.hpp"
#include "post/contact_statistics.hpp"
#include "transient/modes/moving_modes.hpp"
#include "transient/run.hpp"
#include <cmath>
#include <cstdio>
#include <cstring>
#include <limits>
#include <numbers>

namespace {

using namespace fretwork;

constexpr int repeats = 7; // of each measurement; the fastest counts: others were disturbed
constexpr double duration = 10.0;

struct Tube {
  const char* name;
  int modes, supports;
  double length, normal_stiffness, step;
};
constexpr Tube tubes[] = {{"straight tube", 41, 8, 9.0, 1e6, 2.48e-4},
                          {"40 modes, 3 supports", 40, 3, 3.0, 1e6, 1e-4},
                          {"60 modes, 10 supports", 60, 10, 9.0, 1e6, 1e-4},
                          {"high modes: 40, 3 supports", 40, 3, 1.2, 1e6, 5e-5},
                          {"60 modes, 10 supports, 1e8 N/m", 60, 10, 9.0, 1e8, 5e-5}};

struct Cost {
  double with = std::numeric_limits<double>::infinity(), without = with; ///< statistics, s
  double set_up = with; ///< s, before the first step, part of both
  double closed = 0.0;  ///< contacts, mean
};

transient::StepChoice choice_of(const transient::Scene& scene, double step) {
  transient::StepOptions options;
  options.step = step;
  return transient::choose_step(scene, options);
}

void measure(const transient::Scene& scene, double step, Cost& cost) {
  const auto choice = choice_of(scene, step);
  post::ContactStatistics statistics(scene.contacts, 0.02 * duration);
  transient::Observer* observers[] = {&statistics};
  double begin = bench::thread_seconds();
  { const transient::Run first(scene, choice, observers, nullptr, {}); }
  cost.set_up = std::min(cost.set_up, bench::thread_seconds() - begin);
  begin = bench::thread_seconds();
  (void)transient::run(scene, choice, observers, nullptr, {});
  cost.with = std::min(cost.with, bench::thread_seconds() - begin);
  begin = bench::thread_seconds();
  (void)transient::run(scene, choice, {}, nullptr, {});
  cost.without = std::min(cost.without, bench::thread_seconds() - begin);
  cost.closed = 0.0;
  for (const auto& contact : statistics.summaries())
    cost.closed += contact.contact_time_ratio;
}

transient::Scene scene_of(const Tube& tube) {
  bench::TubeScene out;
  out.modes = tube.modes;
  out.supports = tube.supports;
  out.length = tube.length;
  out.normal_stiffness = tube.normal_stiffness;
  out.duration = duration;
  return bench::tube_scene(out);
}

void print_tubes() {
  std::printf("| 10 s of | step, s | closed | with statistics, s | without, s | ns a step | without |\n"
              "| --- | --- | --- | --- | --- | --- | --- |\n");
  for (const Tube& tube : tubes) {
    const transient::Scene scene = scene_of(tube);
    Cost cost;
    for (int i = 0; i < repeats; ++i)
      measure(scene, tube.step, cost);
    const double steps = duration / tube.step;
    std::printf("| %s | %.3g | %.1f | %.3f | %.3f | %.0f | %.0f |\n", tube.name, tube.step, cost.closed,
                cost.with, cost.without, 1e9 * cost.with / steps, 1e9 * cost.without / steps);
    std::fflush(stdout);
  }
}

/// Puts a torsion and an axial mode after every two of bending.
transient::Scene with_still_modes(const transient::Scene& scene) {
  const Eigen::Index modes = scene.system.size();
  const auto place = [](Eigen::Index i) { return i / 2 * 4 + i % 2; };
  const auto spread = [&](const Eigen::MatrixXd& rows) { // columns are modes
    Eigen::MatrixXd out = Eigen::MatrixXd::Zero(rows.rows(), 2 * modes);
    for (Eigen::Index i = 0; i < modes; ++i)
      out.col(place(i)) = rows.col(i);
    return out;
  };
  transient::Scene out = scene;
  const double most = scene.system.stiffness.maxCoeff();
  out.system.stiffness = spread((scene.system.stiffness.array() - most).matrix().transpose()).transpose();
  out.system.stiffness.array() += most;
  out.system.damping = spread(scene.system.damping.transpose()).transpose();
  for (auto& load : out.loads)
    load.modal_force = spread(load.modal_force.transpose()).transpose();
  for (auto& contact : out.contacts)
    contact.b = spread(contact.b);
  out.q0 = out.v0 = Eigen::VectorXd::Zero(2 * modes);
  return out;
}

void print_still_modes() {
  std::printf("\n| tube | with as many modes that stay, ns a step | left out |\n| --- | --- | --- |\n");
  for (const Tube& tube : {tubes[1], tubes[2]}) {
    const transient::Scene whole = with_still_modes(scene_of(tube)),
                           moving = transient::with_modes(whole, transient::moving_modes(whole));
    Cost all, left;
    for (int i = 0; i < repeats; ++i) { // in turn: a disturbance falls on both
      measure(whole, tube.step, all);
      measure(moving, tube.step, left);
    }
    const double steps = duration / tube.step;
    std::printf("| %s | %.0f | %.0f |\n", tube.name, 1e9 * all.with / steps, 1e9 * left.with / steps);
    std::fflush(stdout);
  }
}

/// Flow of a velocity V over the middle half of a tube, under a stable law with three lags that couples drag and lift.
constexpr double velocity = 2.0, density = 300.0, diameter = 0.01905, slow = 0.3; // m/s, kg/m3, m, V/(f D)

/// Gives the first modes the law with its memory, the others nothing.
void add_law(transient::Scene& scene, Eigen::Index modes) {
  const Eigen::Matrix2d stiffness{{-1.0, 0.3}, {-0.3, -1.0}}, damping{{-1.0, 0.1}, {-0.1, -1.0}};
  constexpr double rates[] = {0.3, 0.6, 1.2};
  constexpr double line = 0.738; // kg/m, of tube_scene
  constexpr double pressure = 0.5 * density * velocity * velocity / line;
  Eigen::MatrixXd overlap(modes, modes); // of sines, by pairs of planes
  for (Eigen::Index j = 0; j < modes; ++j)
    for (Eigen::Index k = 0; k < modes; ++k) {
      const auto integral = [](Eigen::Index wave) { // of cos(wave pi s) from 1/4 to 3/4
        const double a = std::numbers::pi * static_cast<double>(wave);
        return wave == 0 ? 0.5 : (std::sin(0.75 * a) - std::sin(0.25 * a)) / a;
      };
      overlap(j, k) = pressure * (integral(std::abs(j / 2 - k / 2)) - integral(j / 2 + k / 2 + 2));
    }
  const auto coupled = [&](const Eigen::Matrix2d& law) {
    Eigen::MatrixXd out(modes, modes);
    for (Eigen::Index j = 0; j < modes; ++j)
      for (Eigen::Index k = 0; k < modes; ++k)
        out(j, k) = law(j % 2, k % 2) * overlap(j, k);
    return out;
  };
  const Eigen::Index n = scene.system.size(), states = 3 * modes;
  core::MotionForces& f = scene.system.motion;
  f.stiffness = f.damping = Eigen::MatrixXd::Zero(n, n);
  f.input = Eigen::MatrixXd::Zero(n, states);
  f.output = Eigen::MatrixXd::Zero(states, n);
  f.rates = Eigen::MatrixXd::Zero(states, states);
  f.stiffness.topLeftCorner(modes, modes) = coupled(stiffness);
  f.damping.topLeftCorner(modes, modes) = diameter / velocity * coupled(damping);
  for (Eigen::Index lag = 0; lag < 3; ++lag) {
    f.input.block(0, lag * modes, modes, modes) = coupled(-stiffness / 3.0);
    f.output.block(lag * modes, 0, modes, modes).setIdentity();
    f.rates.diagonal().segment(lag * modes, modes).setConstant(-rates[lag] * velocity / diameter);
  }
}

void print_laws() {
  std::printf("\n| tube | modes with memory | without a law, ns a step | with | ratio | set-up, ms |\n"
              "| --- | --- | --- | --- | --- | --- |\n");
  constexpr Tube with_law[] = {tubes[1], tubes[2], {"100 modes, 8 supports", 100, 8, 9.0, 1e6, 1e-4}};
  for (const Tube& tube : with_law) {
    const transient::Scene dry = scene_of(tube);
    Eigen::Index slow_modes = 0;
    while (slow_modes < tube.modes &&
           slow * std::sqrt(dry.system.stiffness(slow_modes)) * diameter < 2.0 * std::numbers::pi * velocity)
      ++slow_modes;
    for (const Eigen::Index modes : {slow_modes, Eigen::Index{tube.modes}}) {
      transient::Scene wet = dry;
      add_law(wet, modes);
      Cost without, with;
      for (int i = 0; i < repeats; ++i) { // in turn: a disturbance falls on both
        measure(dry, tube.step, without);
        measure(wet, tube.step, with);
      }
      const double steps = duration / tube.step;
      const double dry_step = (without.with - without.set_up) / steps,
                   wet_step = (with.with - with.set_up) / steps;
      std::printf("| %s | %d | %.0f | %.0f | %.2f | %.0f |\n", tube.name, static_cast<int>(modes),
                  1e9 * dry_step, 1e9 * wet_step, wet_step / dry_step, 1e3 * with.set_up);
      std::fflush(stdout);
      if (slow_modes == tube.modes)
        break;
    }
  }
}

} // namespace

int main(int count, char** arguments) {
  if (count > 1 && std::strcmp(arguments[1], "law") == 0) {
    print_laws();
    return 0;
  }
  print_tubes();
  print_still_modes();
  print_laws();
}
