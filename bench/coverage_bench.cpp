// SPDX-License-Identifier: GPL-3.0-or-later
// Does the scatter that a single run states of itself cover the truth?
//   bench_coverage [RUNS [SECONDS [SCENE]]]     (200 runs of 20 s of every tube, of some windows of a mass in a hole)
// Every run has its own draw of the random forces (scenes under harmonic forces: its own initial state, apart by 1e-7 m kg^1/2 of the first mode). The truth of a
// figure is its mean over all runs. Figures of merit:
//     ratio      root of the mean square of the stated standard errors over the standard deviation over the runs; 1 is right
//     coverage   share of the runs whose interval of 95 % holds the truth; 0.90 to 0.99 is right. Of work rates, depth and years the interval is that of
//                wear/work_rate.hpp, of other figures value +- t(n - 1) error
//     width      median over the runs of the half of the interval, over 1.96 standard deviations over the runs; 1 where the error is known
// Printed as lowest / mean / highest over the contacts.
#include "bench/rattling_mass.hpp"
#include "bench/scenes.hpp"
#include "core/error.hpp"
#include "post/contact_statistics.hpp"
#include "wear/life.hpp"
#include "wear/student.hpp"
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace {

using namespace fretwork;

constexpr double share_before = 0.1; ///< of the duration: the motion becomes stationary
constexpr double confidence = 0.95;
constexpr std::array figures = {"work rate", "friction power", "rms force", "impact rate",
                                "y std",     "z std",          "depth",     "years"};
constexpr std::size_t measured = 6; ///< the other two follow from the work rate

struct Estimate {
  double value, error, low, high;
};
using Run = std::vector<std::array<Estimate, figures.size()>>; ///< by contact, the sum of all last

Estimate interval(double value, double error, double batches) {
  const double half = wear::student_factor(batches - 1.0, confidence) * error;
  return {value, error, value - half, value + half};
}

Estimate interval_of_work_rate(double value, double error, double batches) {
  const auto rate = wear::work_rate_with_confidence(value, error, batches, confidence);
  return {value, error, rate.low, rate.high};
}

/// A flat bar of 10 mm: K = 1e-17 m2/N, low for the hard impacts of these scenes; depth after a year, years to 40 % of 1.09 mm.
std::array<Estimate, 2> wear_of(const Estimate& work) {
  const wear::WornSupport support{wear::SharedScar{wear::FlatBar{9.525e-3, 0.01}}, wear::Archard{1e-17},
                                  1.09e-3};
  const std::array states{
      wear::UncertainState{1.0, wear::work_rate_between(work.low, work.value, work.high)}};
  const std::array times{wear::year};
  const auto depth = wear::depth_history(support, states, times);
  const auto life = wear::time_to_limit(support, states);
  const auto at = [](const std::vector<wear::DepthAt>& history) { return history[0].depth.value().tube; };
  return {Estimate{at(depth.value), 0.0, at(depth.low), at(depth.high)},
          Estimate{life.value.tube.years(), 0.0, life.at_high.tube.years(), life.at_low.tube.years()}};
}

Run run_of(transient::Scene scene, std::uint64_t number) {
  bool random = false;
  for (std::size_t k = 0; k < scene.loads.size(); ++k)
    if (auto* noise = std::get_if<signals::Random>(&scene.loads[k].function)) {
      noise->seed = number * scene.loads.size() + k + 1;
      random = true;
    }
  if (!random)
    scene.q0(0) = 1e-7 * static_cast<double>(number);
  const auto choice = transient::choose_step(scene, {});
  post::ContactStatistics statistics(scene.contacts, share_before * scene.duration);
  transient::Observer* const observers[] = {&statistics};
  if (transient::run(scene, choice, observers, nullptr, {}).outcome != transient::Outcome::done)
    throw core::ComputationError("a run did not end");
  Run out;
  const auto add = [&](const post::ContactSummary& c, const post::StandardErrors& e) {
    const double n = e.batches, w = e.work_rate_batches;
    auto& row = out.emplace_back();
    row = {interval_of_work_rate(c.work_rate, e.work_rate, w),
           interval(c.friction_power, e.friction_power, n),
           interval(c.normal_rms, e.normal_rms, n),
           interval(c.impact_rate, e.impact_rate, n),
           interval(c.y.std, e.y_std, n),
           interval(c.z.std, e.z_std, n)};
    const auto worn = wear_of(row[0]);
    row[measured] = worn[0];
    row[measured + 1] = worn[1];
  };
  post::ContactSummary sum;
  for (const auto& c : statistics.summaries()) {
    add(c, c.error);
    sum.work_rate += c.work_rate;
    sum.friction_power += c.friction_power;
    sum.impact_rate += c.impact_rate;
  }
  add(sum, statistics.errors_of_sums());
  return out;
}

struct Merit {
  double ratio, coverage, scatter, width;
};

Merit merit(const std::vector<Run>& runs, std::size_t contact, std::size_t figure) {
  const auto n = static_cast<double>(runs.size());
  double mean = 0.0, squares = 0.0, stated = 0.0, covered = 0.0;
  for (const Run& run : runs)
    mean += (figure < measured ? run[contact][figure].value : run[contact][0].value) / n;
  double truth = mean;
  if (figure >= measured) // of the mean work rate
    truth = wear_of({mean, 0.0, mean, mean})[figure - measured].value;
  std::vector<double> halves;
  for (const Run& run : runs) {
    const Estimate& e = run[contact][figure];
    halves.push_back(0.5 * (e.high - e.low));
    squares += (e.value - truth) * (e.value - truth) / (n - 1.0);
    stated += e.error * e.error / n;
    covered += (e.low <= truth && truth <= e.high ? 1.0 : 0.0) / n;
  }
  const auto middle = halves.begin() + static_cast<std::ptrdiff_t>(halves.size() / 2);
  std::nth_element(halves.begin(), middle, halves.end());
  constexpr double normal = 1.96; // half of the interval of a known error
  return {std::sqrt(stated / squares), covered, std::sqrt(squares) / truth,
          *middle / (normal * std::sqrt(squares))};
}

/// Figures that have an error of their sum over the contacts.
bool summed(std::size_t figure) { return figure == 0 || figure == 1 || figure == 3; }

void print(const std::vector<double>& values, const char* format) {
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  double mean = 0.0;
  for (const double v : values)
    mean += v / static_cast<double>(values.size());
  for (const double v : {*low, mean, *high})
    std::printf(format, v);
  std::printf(" |");
}

void judge(const std::string& name, const std::vector<Run>& runs) {
  const std::size_t contacts = runs.front().size() - 1;
  for (std::size_t f = 0; f < figures.size(); ++f) {
    std::vector<double> ratios, coverages, scatters, widths;
    for (std::size_t c = 0; c < contacts; ++c) {
      const Merit m = merit(runs, c, f);
      ratios.push_back(m.ratio);
      coverages.push_back(m.coverage);
      scatters.push_back(100.0 * m.scatter);
      widths.push_back(m.width);
    }
    std::printf("| %s | %s |", name.c_str(), figures[f]);
    print(scatters, " %.1f");
    if (f < measured)
      print(ratios, " %.2f");
    else
      std::printf(" - |");
    print(coverages, " %.3f");
    print(widths, " %.2f");
    if (summed(f)) {
      const Merit m = merit(runs, contacts, f);
      std::printf(" %.2f | %.3f |\n", m.ratio, m.coverage);
    } else {
      std::printf(" - | - |\n");
    }
  }
  std::fflush(stdout);
}

/// Impacts from many to few, in windows from long to short.
std::vector<bench::NamedScene> masses() {
  struct Mass {
    const char* name;
    bench::RattlingMass mass; ///< of which the duration is that of the window
  };
  std::vector<bench::NamedScene> out;
  for (Mass one :
       {Mass{"mass, 0.1 mm, 20 s", {20.0, 0.05, 20.0, 1e-4}},
        Mass{"mass, 0.1 mm, 0.5 s", {0.5, 0.05, 20.0, 1e-4}},
        Mass{"mass, 0.8 mm, 20 s", {20.0, 0.05, 8.0, 8e-4}},
        Mass{"mass, 0.8 mm, 2 s", {2.0, 0.05, 8.0, 8e-4}}, Mass{"mass, 1 mm, 20 s", {20.0, 0.05, 8.0, 1e-3}},
        Mass{"mass, 1.3 mm, 20 s", {20.0, 0.02, 8.0, 1.3e-3}},
        Mass{"mass, 1.3 mm, 5 s", {5.0, 0.02, 8.0, 1.3e-3}}}) {
    one.mass.duration /= 1.0 - share_before;
    out.push_back({one.name, bench::rattling_mass(one.mass, 0)});
  }
  return out;
}

} // namespace

int main(int argc, char** argv) {
  const int runs = argc > 1 ? std::max(2, std::atoi(argv[1])) : 200;
  const double seconds = argc > 2 ? std::atof(argv[2]) : 20.0;
  const std::string only = argc > 3 ? argv[3] : "";
  std::printf(
      "%d runs, of tubes of %g s, statistics of the last 90 %%. Lowest, mean, highest over the contacts\n\n"
      "| scene | figure | scatter, %% | ratio | coverage | width | ratio of the sum | coverage of the sum |\n"
      "| --- | --- | --- | --- | --- | --- | --- | --- |\n",
      runs, seconds);
  std::vector<bench::NamedScene> scenes = masses();
  for (auto& tube : bench::rattling_tubes()) {
    tube.scene.duration = seconds;
    scenes.push_back(std::move(tube));
  }
  for (const auto& [name, scene] : scenes) {
    if (!only.empty() && only != name)
      continue;
    std::vector<Run> all;
    for (int r = 0; r < runs; ++r)
      all.push_back(run_of(scene, static_cast<std::uint64_t>(r)));
    judge(name, all);
  }
}
