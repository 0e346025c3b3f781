// SPDX-License-Identifier: GPL-3.0-or-later
// Cost of whole runs of the splitting scheme, 10 s of tubes in steps that give statistics to 1 %, with statistics and without; and what
// a run saves that leaves out the modes that nothing moves.
#include "bench/thread_time.hpp"
#include "bench/tube_scene.hpp"
#include "post/contact_statistics.hpp"
#include "transient/modes/moving_modes.hpp"
#include "transient/run.hpp"
#include <cstdio>
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
  double closed = 0.0;                                                   ///< contacts, mean
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

} // namespace

int main() {
  print_tubes();
  print_still_modes();
}
