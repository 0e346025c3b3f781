// SPDX-License-Identifier: GPL-3.0-or-later
// Beams that strike stops, and a chain with dampers, as studies.
#include "mesh_text.hpp"
#include "paths.hpp"
#include "transient_case.hpp"

namespace fretwork::cases::beam_cases_test {
namespace {

using app::test::bytes_of;
using app::test::example;
using app::test::lone_points;
using app::test::straight_line;

/// Published values have five digits, and their own time step.
constexpr double five_digits = 1e-3;
/// The splitting scheme rests h^2 away from the static solution: with the automatic step this far, with 2e-5
/// s within the reference's digits.
constexpr double settled = 1e-4, settled_finely = 1e-6;
/// Digits of the reference.
constexpr double six_digits = 1e-5;
/// Measured for the first-order scheme with steps of 1e-5 s; references are a matrix exponential.
constexpr double first_order = 1e-4;

TEST(BeamCases, CantileverStrikesItsStop) {
  const Workshop folder;
  const Results run = folder.run(example("cantilever_stop"), "results");
  const double tip[] = {-1.5018e-5, -4.2025e-5, -7.9664e-5, -1.1039e-4, -1.2317e-4, -1.1867e-4,
                        -1.2149e-4, -1.2720e-4, -1.0770e-4, -7.7699e-5, -4.4751e-5, -2.0416e-5,
                        -2.1139e-6, -1.1703e-5, -3.5526e-5, -7.6781e-5};
  const double force[] = {1038.8, 2316.6, 1867.2, 2148.9, 2720.1, 769.5};
  for (int k = 0; k < 16; ++k)
    expect_value("B1", run, fmt::format("tip at {} s, m", 0.01 * (k + 1)), tip[k],
                 run.node("tip").displacement(at(run, 0.01 * (k + 1)), 1), five_digits, 1.28e-4);
  for (int k = 0; k < 6; ++k)
    expect_value("B1", run, fmt::format("force at {} s, N", 0.04 + 0.01 * k), force[k],
                 run.contact("stop").normal_force(at(run, 0.04 + 0.01 * k)), five_digits, 2796.8);
  expect_value("B1", run, "largest force, N", 2796.8, run.statistics("stop")["normal_force"]["max"],
               five_digits);
}

/// The cantilever of the example with eighty elements, whose modes are exact to the digits of the references.
std::string fine_cantilever(const Workshop& folder, const std::string& more) {
  folder.write("beam.msh", straight_line("beam", {0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, 80).text());
  return R"([mesh]
file = "beam.msh"
[materials.beam]
young_modulus = 1.0e10
poisson_ratio = 0.3
density = 1.0e6
[sections.rod]
shape = "circle"
diameter = 0.2
[[beams]]
group = "beam"
material = "beam"
section = "rod"
[[restraints]]
group = "beam_begin"
fixed = "all"
[[restraints]]
group = "beam"
fixed = ["ux", "uz", "rx", "ry"]
)" + more;
}

TEST(BeamCases, CantileverComesToRestOnItsStop) {
  const std::pair<int, double> references[] = {{5, 746.705}, {10, 746.775}, {20, 746.784}};
  const Workshop folder;
  for (const auto& [modes, force] : references)
    for (const bool automatic : {true, false}) {
      const Results run =
          folder.run_text(fine_cantilever(folder, fmt::format(R"([modes]
count = {}
damping = 0.1
[[contacts]]
name = "stop"
group = "beam_end"
obstacle = "circle"
gap = 1.0e-4
normal_stiffness = 1.0e8
[[loads]]
group = "beam_end"
direction = [0.0, -1.0, 0.0]
constant = 1000.0
[transient]
duration = 10.0
{}
[output]
statistics_from = 9.5
every = 0.1
)",
                                                              modes, automatic ? "" : "step = 2.0e-5")));
      expect_value(fmt::format("B2, {} modes", modes).c_str(), run, "force at rest, N", force,
                   run.statistics("stop")["normal_force"]["mean"], automatic ? settled : settled_finely);
    }
}

TEST(BeamCases, CantileverRestsExactlyWithStaticModes) {
  const Workshop folder;
  for (const char* start : {"rest", "static"}) {
    const bool settles = std::string(start) == "rest";
    const Results run = folder.run_text(
        fine_cantilever(folder, fmt::format(R"([modes]
count = 5
damping = 0.1
static_modes = "all"
[[contacts]]
name = "stop"
group = "beam_end"
obstacle = "circle"
gap = 1.0e-4
normal_stiffness = 1.0e8
[[loads]]
group = "beam_end"
direction = [0.0, -1.0, 0.0]
constant = 1000.0
[transient]
duration = {}
step = 2.0e-5
start = "{}"
[output]
statistics_from = {}
every = 0.1
)",
                                            settles ? 10.0 : 1.0, start, settles ? 9.5 : 0.0)),
        {"--force"});
    const std::string name = fmt::format("B2, 5 modes, static modes, start = {}", start);
    expect_value(name.c_str(), run, "force at rest, N", 746.785,
                 run.statistics("stop")["normal_force"]["mean"], settled_finely);
    expect_value(name.c_str(), run, "tip at rest, m", -1.0746785e-4,
                 run.statistics("stop")["displacement"]["y"]["mean"], settled_finely);
  }
}

/// Largest force with which the span of bench/span hits its stop at 0.47 of it.
double impact_of_a_span(const Workshop& folder, int modes, const char* static_modes) {
  const auto set = [](const char* key, const auto& value) { return fmt::format("--set={}={}", key, value); };
  const Results run =
      folder.run(test_paths::source_dir() / "bench" / "span" / "study.toml", "span",
                 {set("modes.count", modes), set("modes.static_modes", static_modes), "--force"});
  return run.statistics("stop")["normal_force"]["max"];
}

TEST(BeamCases, ImpactOfASpanNeedsFewerModesWithStaticModes) {
  constexpr double contact = 8249.0,
                   first = 219.8; // rad/s: w_c of the infinite beam (doc/theory.md, section 5), w_1
  constexpr double a_percent = 0.01;
  const Workshop folder;
  const double exact = impact_of_a_span(folder, 60, "all");
  for (const int modes : {5, 7, 10, 12, 15, 20}) {
    const double none = impact_of_a_span(folder, modes, "none") / exact - 1.0,
                 all = impact_of_a_span(folder, modes, "all") / exact - 1.0;
    const double highest = first * modes * modes / contact;
    fmt::print("| span on a stop, {} modes | w_max / w_c {:.2f} | none {:.2f} % | all {:.2f} % |\n", modes,
               highest, 100.0 * none, 100.0 * all);
    EXPECT_LT(std::abs(all), 0.7 * std::abs(none)) << modes;
    if (highest > 3.0) {
      EXPECT_LT(std::abs(all), a_percent) << modes;
    }
    EXPECT_EQ(std::abs(none) < a_percent, highest > 3.0) << modes;
  }
}

TEST(BeamCases, CantileverHeldByItsStopHasTheFrequenciesOfBoth) {
  const Workshop folder;
  const Results run = folder.run_text(fine_cantilever(folder, R"([[springs]]
group = "beam_end"
stiffness = [0, 1e8, 0, 0, 0, 0]
[modes]
count = 4
[transient]
duration = 0.01
)"));
  const double references[] = {10.8921, 26.6883, 52.8922, 98.0103};
  for (std::size_t i = 0; i < 4; ++i)
    expect_value("B2", run, fmt::format("frequency {} with the tip held, Hz", i + 1), references[i],
                 run.summary["modes"]["frequencies_hz"][i], six_digits);
}

TEST(BeamCases, HingedBeamThatTurnsHitsAStop) {
  const Workshop folder;
  auto mesh = straight_line("beam", {0.0, 0.0, 0.0}, {0.783, 0.0, 0.0}, 10);
  mesh.nodes[6].x() = 0.4620; // as in the reference
  folder.write("beam.msh", mesh.text());
  const Results run = folder.run_text(R"([mesh]
file = "beam.msh"
[materials.alloy]
young_modulus = 6.7e10
poisson_ratio = 0.0
density = 2400.0
[sections.bar]
shape = "rectangle"
height_y = 0.014
height_z = 0.014
[[beams]]
group = "beam"
material = "alloy"
section = "bar"
[[restraints]]
group = "beam_begin"
fixed = ["ux", "uy", "uz", "rx", "ry"]
[[restraints]]
group = "beam"
fixed = ["ux", "uz", "rx", "ry"]
[modes]
count = 10
damping = 0.01
[[initial]]
group = "beam"
rotation_rate = [0.0, 0.0, -3.8]
[[initial]]
group = "beam_end"
velocity = [0.0, -2.96786, 0.0]
rotation_rate = [0.0, 0.0, -3.8]
centre = [0.783, 0.0, 0.0]
[[contacts]]
name = "stop"
group = "beam_end"
obstacle = "stop_y"
axis = [0.0, 0.0, 1.0]
y_axis = [0.0, -1.0, 0.0]
gap = 0.0
normal_stiffness = 18000.0
[transient]
duration = 0.0125
[output]
every = 1.0e-4
nodes = ["beam_end"]
)");
  const double tip[] = {-2.66e-3, -4.33e-3, -4.92e-3, -4.78e-3, -3.82e-3, -2.87e-3,
                        -2.71e-3, -3.09e-3, -3.41e-3, -3.36e-3, -2.64e-3, -7.42e-4};
  const double accepted =
      5e-5 /
      4.92e-3; // of the largest: the reference's own three digits and its own projection of the initial speed
  EXPECT_LT(run.summary["modes"]["frequencies_hz"][0].get<double>(), 1e-3) << "one rigid mode";
  for (int k = 0; k < 12; ++k)
    expect_value("B3", run, fmt::format("tip at {} ms, m", k + 1), tip[k],
                 run.node("beam_end").displacement(at(run, 1e-3 * (k + 1)), 1), accepted, 4.92e-3);
}

/// Case A5: ten points, nine springs, eight masses; dampers that couple the modes.
std::string chain() {
  std::string study = "[mesh]\nfile = \"chain.msh\"\n";
  for (int i = 0; i < 10; ++i)
    study += fmt::format("[[restraints]]\ngroup = \"p{}\"\nfixed = {}\n", i,
                         i == 0 || i == 9 ? "\"all\"" : R"(["uy", "uz", "rx", "ry", "rz"])");
  for (int i = 1; i < 9; ++i)
    study += fmt::format("[[masses]]\ngroup = \"p{}\"\nmass = 10.0\n", i);
  for (int i = 0; i < 9; ++i)
    study += fmt::format("[[springs]]\ngroup = \"p{}\"\nother = \"p{}\"\nstiffness = [1e5, 0, 0, 0, 0, "
                         "0]\ndamping = [{}, 0, 0, 0, 0, 0]\n",
                         i, i + 1,
                         i == 0   ? 250
                         : i == 8 ? 25
                                  : 50);
  return study + R"([[loads]]
group = "p4"
direction = [1.0, 0.0, 0.0]
table = [[0.0, 1.0], [1.0, 1.0], [1.0, 0.0]]
[output]
nodes = ["p4"]
every = 1.0e-2
[transient]
duration = 1.0
step = 1.0e-5
)";
}

TEST(BeamCases, ChainWithDampersThatCoupleItsModes) {
  const Workshop folder;
  folder.write("chain.msh", lone_points({"p0", "p1", "p2", "p3", "p4", "p5", "p6", "p7", "p8", "p9"}).text());
  const Results run = folder.run_text(chain());
  const double frequencies[] = {5.5274, 10.8868, 15.9155, 20.4606, 24.3840, 27.5664, 29.9113, 31.3474};
  for (std::size_t i = 0; i < 8; ++i)
    expect_value("A5", run, fmt::format("frequency {}, Hz", i + 1), frequencies[i],
                 run.summary["modes"]["frequencies_hz"][i], six_digits);
  const std::pair<double, double> moved[] = {{0.09, 3.954085e-5}, {0.18, 5.135974e-6}, {0.27, 3.767924e-5},
                                             {0.36, 7.355104e-6}, {0.45, 3.585249e-5}, {0.54, 8.819161e-6},
                                             {0.63, 3.465793e-5}, {0.72, 1.009426e-5}, {0.81, 3.362162e-5},
                                             {0.91, 1.130791e-5}, {0.99, 3.261071e-5}};
  for (const auto& [time, value] : moved)
    expect_value("A5", run, fmt::format("fourth mass at {} s, m", time), value,
                 run.node("p4").displacement(at(run, time), 0), first_order, 3.954085e-5);
  // under a constant load both schemes move the modes exactly, whatever the step
  const Results other = folder.run_text(
      chain(), {"--force", "--set", "transient.scheme=collocation", "--set", "transient.step=1.0e-3"});
  constexpr double exact = 1e-9;          // relative
  const Eigen::Index last = at(run, 0.9); // the load ends with the run, inside the last step
  EXPECT_LT((other.node("p4").displacement - run.node("p4").displacement).topRows(last).cwiseAbs().maxCoeff(),
            exact * 3.954085e-5);
}

} // namespace
} // namespace fretwork::cases::beam_cases_test
