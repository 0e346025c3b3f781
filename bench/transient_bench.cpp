// SPDX-License-Identifier: GPL-3.0-or-later
// Cost of a step against modes and contacts, open and working, with statistics and the energy balance; 10 s of
// the straight tube.
#include "bench/tube_scene.hpp"
#include "post/contact_statistics.hpp"
#include "transient/run.hpp"
#include <benchmark/benchmark.h>

namespace {

using namespace fretwork;

constexpr double out_of_reach = 1.0; ///< m

/// One run; counters: nanoseconds a step, mean number of closed contacts.
void run_once(benchmark::State& state, const bench::TubeScene& tube, transient::SchemeKind scheme,
              std::optional<double> step) {
  const transient::Scene scene = bench::tube_scene(tube);
  transient::StepOptions options;
  options.scheme = scheme;
  options.step = step;
  const auto choice = transient::choose_step(scene, options);
  double steps = 0.0, closed = 0.0;
  for (auto _ : state) {
    post::ContactStatistics statistics(scene.contacts, 0.02 * tube.duration);
    transient::Observer* observers[] = {&statistics};
    const auto report = transient::run(scene, choice, observers, nullptr, {});
    benchmark::DoNotOptimize(report.energy.stored);
    steps += static_cast<double>(report.counts.steps);
    closed = 0.0;
    for (const auto& contact : statistics.summaries())
      closed += contact.contact_time_ratio;
  }
  state.counters["step_ns"] =
      benchmark::Counter(1e-9 * steps, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
  state.counters["closed"] = closed;
  state.counters["h_us"] = 1e6 * choice.step;
}

bench::TubeScene tube(int modes, int supports, double gap, double duration) {
  bench::TubeScene out;
  out.modes = modes;
  out.supports = supports;
  out.length = supports + 1.0;
  out.gap = gap;
  out.duration = duration;
  return out;
}

void euler_straight_tube_1s(benchmark::State& state) {
  run_once(state, tube(41, 8, 2e-4, 1.0), transient::SchemeKind::euler, 1e-5);
}
void devogelaere_straight_tube_1s(benchmark::State& state) {
  run_once(state, tube(41, 8, 2e-4, 1.0), transient::SchemeKind::devogelaere, 2e-5);
}
/// At its default tolerance, 1e-6; h_us is the longest step.
void runge_kutta_54_straight_tube_1s(benchmark::State& state) {
  run_once(state, tube(41, 8, 2e-4, 1.0), transient::SchemeKind::runge_kutta_54, {});
}
void automatic_straight_tube_10s(benchmark::State& state) {
  run_once(state, tube(41, 8, 2e-4, 10.0), transient::SchemeKind::splitting, {});
}
void splitting_working(benchmark::State& state) {
  run_once(state, tube(static_cast<int>(state.range(0)), static_cast<int>(state.range(1)), 2e-4, 2.0),
           transient::SchemeKind::splitting, 1e-4);
}
void splitting_open(benchmark::State& state) {
  run_once(state, tube(static_cast<int>(state.range(0)), static_cast<int>(state.range(1)), out_of_reach, 2.0),
           transient::SchemeKind::splitting, 1e-4);
}

void energy_conserving_working(benchmark::State& state) {
  run_once(state, tube(static_cast<int>(state.range(0)), static_cast<int>(state.range(1)), 2e-4, 2.0),
           transient::SchemeKind::energy_conserving, 1e-4);
}

void collocation_working(benchmark::State& state) {
  run_once(state, tube(static_cast<int>(state.range(0)), static_cast<int>(state.range(1)), 2e-4, 2.0),
           transient::SchemeKind::collocation, 2e-4);
}

BENCHMARK(collocation_working)->ArgsProduct({{20, 40, 100}, {3, 10, 30}})->Unit(benchmark::kMillisecond);
BENCHMARK(euler_straight_tube_1s)->Unit(benchmark::kMillisecond);
BENCHMARK(devogelaere_straight_tube_1s)->Unit(benchmark::kMillisecond);
BENCHMARK(runge_kutta_54_straight_tube_1s)->Unit(benchmark::kMillisecond);
BENCHMARK(automatic_straight_tube_10s)->Unit(benchmark::kMillisecond);
BENCHMARK(splitting_open)->ArgsProduct({{20, 40, 100}, {3, 10, 30}})->Unit(benchmark::kMillisecond);
BENCHMARK(splitting_working)->ArgsProduct({{20, 40, 100}, {3, 10, 30}})->Unit(benchmark::kMillisecond);
BENCHMARK(energy_conserving_working)->ArgsProduct({{40, 100}, {3, 10, 30}})->Unit(benchmark::kMillisecond);

} // namespace

BENCHMARK_MAIN();
