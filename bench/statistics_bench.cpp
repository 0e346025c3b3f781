// SPDX-License-Identifier: GPL-3.0-or-later
// Statistics of the automatic step against reference ones.
//   bench_statistics reference FILE [SCENE]     writes the reference (of one scene into it): runs at a quarter of the automatic step
//   bench_statistics compare FILE [SCHEME [FACTOR [SCENE [VECTOR]]]]   prints deviations of SCHEME (auto) at FACTOR (1) times its automatic
//     step, and times; "" for all scenes; VECTOR: doubles a vector at most, 2, 4 or 8 (8)
// Impacts with friction are chaotic: figures are means over runs whose initial states differ by 1e-7, with standard errors.
#include "bench/scenes.hpp"
#include "bench/thread_time.hpp"
#include "core/error.hpp"
#include "kernels/kernels.hpp"
#include "post/contact_statistics.hpp"
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>

namespace {

using namespace fretwork;
using Json = nlohmann::ordered_json;

constexpr int runs = 16;
constexpr double window_from = 0.2; ///< s
constexpr double disturbed = 1e-7;  ///< m kg^1/2, of the first mode
constexpr std::array figures = {"work_rate",          "friction_power",   "normal_rms",
                                "impacts_per_second", "displacement_std", "contact_time_ratio"};

struct Ensemble {
  std::array<double, figures.size()> mean{}, error{}; ///< sums over contacts
  double told = 0.0;                ///< standard error of the work rate as single runs tell it, mean
  double seconds = 0.0, bare = 0.0; ///< a run with statistics and one without, the fastest
  transient::StepChoice choice;
};

std::array<double, figures.size()> sums(const post::ContactStatistics& statistics) {
  std::array<double, figures.size()> out{};
  for (const post::ContactSummary& c : statistics.summaries()) {
    const double one[] = {
        c.work_rate,         c.friction_power, c.normal_rms, c.impact_rate, std::hypot(c.y.std, c.z.std),
        c.contact_time_ratio};
    for (std::size_t k = 0; k < out.size(); ++k)
      out[k] += one[k];
  }
  return out;
}

Ensemble ensemble(transient::Scene scene, const transient::StepOptions& options, double factor) {
  Ensemble out;
  out.choice = transient::choose_step(scene, options);
  out.choice.step *= factor;
  out.choice.steps = static_cast<std::int64_t>(std::ceil(scene.duration / out.choice.step * (1 - 1e-12)));
  std::array<double, figures.size()> squares{};
  out.seconds = out.bare = 1e300;
  for (int run = 0; run < runs; ++run) {
    scene.q0(0) = disturbed * run;
    post::ContactStatistics statistics(scene.contacts, window_from);
    transient::Observer* const observers[] = {&statistics};
    double begin = bench::thread_seconds();
    (void)transient::run(scene, out.choice, {}, nullptr, {});
    out.bare = std::min(out.bare, bench::thread_seconds() - begin);
    begin = bench::thread_seconds();
    const auto report = transient::run(scene, out.choice, observers, nullptr, {});
    out.seconds = std::min(out.seconds, bench::thread_seconds() - begin);
    if (report.outcome != transient::Outcome::done)
      throw core::ComputationError("a run did not end");
    out.told += statistics.errors_of_sums().work_rate / runs;
    const auto values = sums(statistics);
    for (std::size_t k = 0; k < values.size(); ++k) {
      out.mean[k] += values[k] / runs;
      squares[k] += values[k] * values[k] / runs;
    }
  }
  for (std::size_t k = 0; k < squares.size(); ++k)
    out.error[k] = std::sqrt(std::max(0.0, squares[k] - out.mean[k] * out.mean[k]) / (runs - 1));
  return out;
}

void write_reference(const char* file, const std::string& only) {
  Json out = Json::object();
  if (!only.empty()) {
    std::ifstream in(file);
    out = Json::parse(in);
  }
  for (const auto& [name, scene] : bench::rattling_tubes()) {
    if (!only.empty() && only != name)
      continue;
    const Ensemble e = ensemble(scene, {transient::SchemeKind::splitting, {}}, 0.25);
    Json one{
        {"step_s", e.choice.step}, {"runs", runs}, {"duration_s", scene.duration}, {"from_s", window_from}};
    for (std::size_t k = 0; k < figures.size(); ++k)
      one[figures[k]] = {{"mean", e.mean[k]}, {"standard_error", e.error[k]}};
    out[name] = one;
    std::printf("%s: step %.3g s, %.2f s a run\n", name.c_str(), e.choice.step, e.seconds);
    std::fflush(stdout);
  }
  std::ofstream(file) << out.dump(1) << '\n';
}

void limit_vectors(int doubles) {
  using kernels::VectorSize;
  kernels::limit_vectors(doubles >= 8   ? VectorSize::pack
                         : doubles >= 4 ? VectorSize::half
                                        : VectorSize::pair);
  std::printf("%s. ", kernels::vector_width());
}

std::optional<transient::SchemeKind> scheme_named(const std::string& name) {
  using enum transient::SchemeKind;
  for (const auto kind : {splitting, collocation, energy_conserving, euler, devogelaere})
    if (transient::name_of(kind) == name)
      return kind;
  return {};
}

void compare(const char* file, const std::string& scheme, double factor, const std::string& only) {
  std::ifstream in(file);
  const Json reference = Json::parse(in);
  std::printf("Deviation from the reference in %% +- 2 standard errors of the difference; the last column: "
              "standard error of the work rate in %%, "
              "scatter of %d runs / as single runs tell it\n\n",
              runs);
  std::printf("| scene | scheme | step, s | w_c h | w_max h | s | without statistics | work | friction | rms "
              "force | impacts | "
              "motion | contact time | scatter |\n"
              "| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |\n");
  for (const auto& [name, scene] : bench::rattling_tubes()) {
    if (!only.empty() && only != name)
      continue;
    const Ensemble e = ensemble(scene, {scheme_named(scheme), {}}, factor);
    std::printf("| %s | %s | %.3g | %.2f | %.2f | %.4f | %.4f |", name.c_str(),
                transient::name_of(e.choice.scheme).c_str(), e.choice.step,
                e.choice.contact_frequency * e.choice.step, e.choice.highest_mode * e.choice.step, e.seconds,
                e.bare);
    for (std::size_t k = 0; k < figures.size(); ++k) {
      const Json& r = reference.at(name).at(figures[k]);
      const double mean = r.at("mean"), error = r.at("standard_error");
      std::printf(" %.2f+-%.2f |", 100.0 * (e.mean[k] / mean - 1.0),
                  200.0 * std::hypot(e.error[k], error) / mean);
    }
    std::printf(" %.2f/%.2f |\n", 100.0 * std::sqrt(double(runs)) * e.error[0] / e.mean[0],
                100.0 * e.told / e.mean[0]);
    std::fflush(stdout);
  }
}

} // namespace

int main(int argc, char** argv) {
  if ((argc == 3 || argc == 4) && std::strcmp(argv[1], "reference") == 0)
    write_reference(argv[2], argc == 4 ? argv[3] : "");
  else if (argc >= 3 && argc <= 7 && std::strcmp(argv[1], "compare") == 0) {
    limit_vectors(argc > 6 ? std::atoi(argv[6]) : 8);
    compare(argv[2], argc > 3 ? argv[3] : "auto", argc > 4 ? std::atof(argv[4]) : 1.0,
            argc > 5 ? argv[5] : "");
  } else
    std::fprintf(
        stderr,
        "bench_statistics reference FILE [SCENE] | compare FILE [SCHEME [FACTOR [SCENE [VECTOR]]]]\n");
}
