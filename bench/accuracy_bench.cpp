// SPDX-License-Identifier: GPL-3.0-or-later
// Accuracy on scenes that nobody tuned for.
//   bench_accuracy [OPTIONS]             random scenes, the automatic step against the reference solution (accuracy_study.hpp)
//   bench_accuracy reference [OPTIONS]   the reference solution against the one at half its step
//   bench_accuracy list [OPTIONS]        the scenes
//   bench_accuracy impacts [OPTIONS]     single impacts (impact_bench.cpp)
// Options:
//   --scenes N (60), --seed S (1)   how many scenes: of ten, five are masses, three tubes and two pairs; random numbers
//   --only CASE           scenes of one kind (mass, tube, pair, mixed), or one scene (tube-7)
//   --accuracy a (0.01)   of the automatic step; the tolerance is 2 a, at least 0.4 %
//   --scheme NAME, --step-factor f (1), --tolerance t (1e-6)   of the run under test: scheme, times its automatic step, of an adaptive one
//   --against NAME        compares that scheme with another, at the same factor and tolerance, in place of the reference solution
//   --resolution x        w_c h of the reference solution of masses (0.02; below an accuracy of 0.005 0.01), of tubes 1.5 times that
//   --budget s (1)        times the usual processor time of the reference solution a scene
//   --ct-factor x         times C_T of all contacts of random scenes
//   --ct-ratio x          C_T of single impacts over 2 (K_T m)^1/2; else automatic
//   --print all           every figure, not only those that fail
//   --csv FILE            all figures
#include "bench/accuracy_study.hpp"
#include "core/error.hpp"
#include <cstdio>
#include <cstdlib>
#include <fmt/format.h>
#include <functional>
#include <map>

namespace {

using namespace fretwork;
using bench::SceneKind;

constexpr SceneKind order[] = {SceneKind::mass, SceneKind::mass, SceneKind::tube, SceneKind::mass,
                               SceneKind::pair, SceneKind::tube, SceneKind::mass, SceneKind::tube,
                               SceneKind::mass, SceneKind::pair};
constexpr double mass_budget = 1.8, tube_budget = 5.5; // s of the reference solution, a scene
constexpr double resolution = 0.02, tubes_to_masses = 1.5, fine_resolution = 0.01, fine_accuracy = 0.005;

struct Arguments {
  std::string mode, only, csv;
  int scenes = 60;
  bool all = false;
  std::uint64_t seed = 1;
  double budget = 1.0;
  std::optional<double> resolution, tangential_ratio;
  double tangential_factor = 1.0;
  bench::StudyOptions study;
};

transient::SchemeKind scheme_named(const std::string& name) {
  using enum transient::SchemeKind;
  for (const auto kind : {splitting, collocation, energy_conserving, euler, devogelaere, runge_kutta_54})
    if (transient::name_of(kind) == name)
      return kind;
  throw core::Error(fmt::format("there is no scheme \"{}\"", name));
}

double number(const std::string& text) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  if (text.empty() || *end != '\0' || !(value >= 0.0))
    throw core::Error(fmt::format("\"{}\" is no number >= 0", text));
  return value;
}

Arguments parsed(int argc, char** argv) {
  Arguments out;
  using Text = const std::string&;
  const std::map<std::string, std::function<void(Text)>> options = {
      {"--scenes", [&](Text t) { out.scenes = static_cast<int>(number(t)); }},
      {"--seed", [&](Text t) { out.seed = static_cast<std::uint64_t>(number(t)); }},
      {"--only", [&](Text t) { out.only = t; }},
      {"--accuracy", [&](Text t) { out.study.step.accuracy = number(t); }},
      {"--scheme", [&](Text t) { out.study.step.scheme = scheme_named(t); }},
      {"--against", [&](Text t) { out.study.against = scheme_named(t); }},
      {"--step-factor", [&](Text t) { out.study.step_factor = number(t); }},
      {"--tolerance", [&](Text t) { out.study.step.tolerance = number(t); }},
      {"--resolution", [&](Text t) { out.resolution = number(t); }},
      {"--budget", [&](Text t) { out.budget = number(t); }},
      {"--ct-factor", [&](Text t) { out.tangential_factor = number(t); }},
      {"--ct-ratio", [&](Text t) { out.tangential_ratio = number(t); }},
      {"--print", [&](Text t) { out.all = t == "all"; }},
      {"--csv", [&](Text t) { out.csv = t; }}};
  int i = 1;
  if (argc > 1 && argv[1][0] != '-')
    out.mode = argv[i++];
  for (; i < argc; i += 2) {
    const auto found = options.find(argv[i]);
    if (found == options.end() || i + 1 == argc)
      throw core::Error(
          fmt::format("unknown option or no value: \"{}\"; see bench/accuracy_bench.cpp", argv[i]));
    found->second(argv[i + 1]);
  }
  out.study.resolution =
      out.resolution.value_or(out.study.step.accuracy < fine_accuracy ? fine_resolution : resolution);
  return out;
}

std::vector<bench::RandomScene> scenes_of(const Arguments& arguments) {
  std::vector<bench::RandomScene> out;
  for (const SceneKind kind : {SceneKind::mass, SceneKind::tube, SceneKind::pair, SceneKind::mixed}) {
    const std::string name = bench::name_of(kind);
    if (arguments.only == name)
      for (int i = 0; i < arguments.scenes; ++i)
        out.push_back(bench::random_scene(kind, arguments.seed, i));
    else if (arguments.only.starts_with(name + "-"))
      out.push_back(bench::random_scene(kind, arguments.seed,
                                        static_cast<int>(number(arguments.only.substr(name.size() + 1)))));
  }
  if (!arguments.only.empty() && out.empty())
    throw core::Error(fmt::format(
        "--only {}: mass, tube, pair, mixed or one of them with its number, as mass-3", arguments.only));
  std::map<SceneKind, int> numbers;
  for (int i = 0; arguments.only.empty() && i < arguments.scenes; ++i) {
    const SceneKind kind = order[static_cast<std::size_t>(i) % std::size(order)];
    out.push_back(bench::random_scene(kind, arguments.seed, numbers[kind]++));
  }
  for (bench::RandomScene& scene : out)
    for (transient::ContactPoint& contact : scene.scene.contacts)
      contact.support.friction.damping *= arguments.tangential_factor;
  return out;
}

void run_scenes(Arguments& arguments) {
  arguments.study.halved = arguments.mode == "reference";
  std::printf("| scene | figure | %s | reference | difference, %% | standard error, %% | as measured, %% | "
              "intervals |\n"
              "| --- | --- | --- | --- | --- | --- | --- | --- |\n",
              arguments.study.halved ? "at twice the step" : "ours");
  std::vector<bench::SceneResult> results;
  for (bench::RandomScene& scene : scenes_of(arguments)) {
    bench::StudyOptions options = arguments.study;
    const bool mass = scene.kind == SceneKind::mass;
    options.budget = arguments.budget * (mass ? mass_budget : tube_budget);
    options.resolution *= mass ? 1.0 : tubes_to_masses;
    results.push_back(bench::study(std::move(scene), options));
    bench::print_figures(results.back(), arguments.all);
    std::fflush(stdout);
  }
  bench::print_summary(results, arguments.study);
  if (!arguments.csv.empty())
    bench::write_csv(arguments.csv, results);
}

} // namespace

int main(int argc, char** argv) {
  try {
    Arguments arguments = parsed(argc, argv);
    if (arguments.mode == "impacts") {
      bench::print_impacts(arguments.study, arguments.tangential_ratio);
    } else if (arguments.mode == "list") {
      for (const bench::RandomScene& scene : scenes_of(arguments))
        std::printf("%s: %s\n", scene.name.c_str(), scene.description.c_str());
    } else if (arguments.mode.empty() || arguments.mode == "reference") {
      run_scenes(arguments);
    } else {
      throw core::Error(fmt::format("unknown mode \"{}\": reference, list or impacts", arguments.mode));
    }
  } catch (const core::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
