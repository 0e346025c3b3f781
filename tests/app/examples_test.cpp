// SPDX-License-Identifier: GPL-3.0-or-later
// Every example runs and gives its headline numbers.
#include "paths.hpp"
#include "program.hpp"
#include <algorithm>
#include <fmt/format.h>
#include <set>

namespace fretwork::app::test::examples_test {
namespace {

constexpr double single_impact = 1e-4; ///< the rule's least number of steps aims at this
constexpr double five_digits = 1e-3;   ///< of published values, which have their own time step
constexpr double mesh_of_ninety =
    5e-4; ///< ninety elements against exact beam modes, at the twentieth (201.488 Hz against 201.455)
constexpr double independent = 1e-5;     ///< six digits of an independent beam program on the same mesh
constexpr double four_digits = 3e-4;     ///< as printed
constexpr double trusted_balance = 2e-2; ///< of the energy put in: above it the step was wrong

/// Keys of a summary, but names of zones, libraries and files.
void add_keys(const nlohmann::json& value, std::set<std::string>& keys) {
  static const std::set<std::string> of_names{"zones", "connors_constants", "libraries", "files_sha256"};
  if (value.is_object()) {
    for (const auto& [key, item] : value.items()) {
      keys.insert(key);
      for (const auto& part : of_names.contains(key) ? std::vector<nlohmann::json>(item.begin(), item.end())
                                                     : std::vector<nlohmann::json>{item})
        add_keys(part, keys);
    }
  } else if (value.is_array()) {
    for (const auto& item : value)
      add_keys(item, keys);
  }
}

/// Runs an example; every key of its summary is in the manual.
Results example_run(const Workshop& folder, const std::string& name, const std::string& output,
                    const std::vector<std::string>& more = {}) {
  static const std::string manual = bytes_of(test_paths::source_dir() / "doc" / "results.md");
  Results out = folder.run(example(name), output, more);
  std::set<std::string> keys;
  add_keys(out.summary, keys);
  for (const std::string& key : keys)
    EXPECT_TRUE(says(manual, "`" + key + "`")) << key << " of the summary of " << name;
  return out;
}

TEST(Examples, EveryFolderOfExamplesIsRunHere) {
  std::set<std::string> found;
  for (const auto& entry : fs::directory_iterator(test_paths::source_dir() / "examples"))
    if (fs::exists(entry.path() / "study.toml"))
      found.insert(entry.path().filename());
  EXPECT_EQ(found, (std::set<std::string>{"bundle", "bundle_flow", "cantilever_stop", "fuel_rod",
                                          "oscillator", "straight_tube", "tube_in_flow", "tube_study",
                                          "tube_sweep", "two_tubes", "u_bend", "u_bend_flow"}));
}

TEST(Examples, BundleOfUBendsTouchesAtItsTops) {
  const Workshop folder;
  const Results run = example_run(folder, "bundle", "results");
  for (const char* pair : {"tubes_12", "tubes_23", "tubes_34", "tubes_45"})
    EXPECT_GT(run.statistics(pair)["contact_time_ratio"].get<double>(), 0.0) << pair;
}

/// Past the threshold of the free bends neighbours and the frame limit the motion; with bars at the tops none of them is touched.
TEST(Examples, RowOfUBendsInFlowTouchesPastItsThreshold) {
  const char* clips[] = {"tubes_12", "tubes_23", "tubes_34", "tubes_45", "frame_1", "frame_5"};
  const Workshop folder;
  const Results run = example_run(folder, "bundle_flow", "results");
  const auto& stability = run.summary["stability"];
  ASSERT_EQ(stability.size(), 10u) << "two assessments of five tubes";
  for (std::size_t tube = 0; tube < 5; ++tube) {
    EXPECT_TRUE(close_to(stability[tube]["law"]["critical_factor"], 0.71292, four_digits));
    EXPECT_TRUE(stability[5 + tube]["law"]["critical_factor"].is_null());
  }
  for (const char* name : clips)
    EXPECT_GT(run.statistics(name)["impacts"].get<int>(), 20) << name; // some 40 to 110
  EXPECT_GT(run.summary["energy"]["fluid_J"].get<double>(), 0.3);
  EXPECT_LT(run.summary["energy"]["residual_relative"].get<double>(), trusted_balance);
  const Results held = example_run(folder, "bundle_flow", "held", {"--set", "contacts.bars.active=true"});
  for (const char* name : clips)
    EXPECT_EQ(held.statistics(name)["impacts"].get<int>(), 0) << name;
}

/// The motion in the plane of the bend grows to the stops, and no further; bars without clearance hold it by friction.
TEST(Examples, UBendPastItsInPlaneThresholdIsLimitedByStops) {
  const Workshop folder;
  const Results run = example_run(folder, "u_bend_flow", "results");
  const auto& stability = run.summary["stability"];
  ASSERT_EQ(stability.size(), 3u);
  EXPECT_TRUE(close_to(stability[0]["law"]["critical_factor"], 0.75265, four_digits)) << "loose bars";
  EXPECT_TRUE(stability[1]["law"]["critical_factor"].is_null()) << "bars hold";
  EXPECT_TRUE(close_to(stability[2]["law"]["critical_factor"], 2.4534, four_digits)) << "stops closed";
  constexpr double gap = 1e-3, deepest = 0.06e-3; // m; 0.04 mm of penetration in a run of 8 s
  for (const char* stop : {"stops[0]", "stops[1]"}) {
    EXPECT_GT(run.statistics(stop)["impacts"].get<int>(), 50) << stop; // some 150
    EXPECT_GT(run.statistics(stop)["position"]["z"]["max"].get<double>(), gap) << stop;
    EXPECT_LT(run.statistics(stop)["position"]["z"]["max"].get<double>(), gap + deepest) << stop;
  }
  EXPECT_GT(run.summary["energy"]["fluid_J"].get<double>(), 0.2);
  EXPECT_LT(run.summary["energy"]["residual_relative"].get<double>(), trusted_balance);
  const Results held =
      example_run(folder, "u_bend_flow", "held", {"--set", "contacts.bars.bars=[0.009525, 0.009525]"});
  for (const char* stop : {"stops[0]", "stops[1]"})
    EXPECT_LT(held.statistics(stop)["position"]["z"]["max"].get<double>(), 0.1 * gap) << stop;
  EXPECT_LT(held.summary["contact_sums"]["work_rate"].get<double>(),
            0.1 * run.summary["contact_sums"]["work_rate"].get<double>());
}

TEST(Examples, OscillatorMeetsItsStopThreeTimes) {
  const Workshop folder;
  const Results run = example_run(folder, "oscillator", "results");
  EXPECT_EQ(run.statistics("stop")["impacts"], 3);
  EXPECT_TRUE(close_to(run.statistics("stop")["normal_force"]["max"], 9950.37, single_impact));
  EXPECT_TRUE(run.summary["warnings"].empty()) << run.summary["warnings"];
}

TEST(Examples, CantileverReachesThePublishedForce) {
  const Workshop folder;
  const Results run = example_run(folder, "cantilever_stop", "results");
  EXPECT_TRUE(close_to(run.statistics("stop")["normal_force"]["max"], 2796.8, five_digits));
  // the density of the published case is none of any metal
  ASSERT_EQ(run.summary["warnings"].size(), 1u) << run.summary["warnings"];
  EXPECT_TRUE(says(run.summary["warnings"][0], "units are SI"));
}

/// Springs press the rod on two dimples each with what their overlap leaves; the grid without springs lets it rattle.
TEST(Examples, FuelRodIsPressedByItsGrids) {
  const Workshop folder;
  const Results run = example_run(folder, "fuel_rod", "results");
  constexpr double spring = 1e5, dimple = 5e5, overlap = 3.5e-5;              // N/m, m
  constexpr double pressed = overlap / (1.0 / spring + 1.0 / (2.0 * dimple)); // N; dimples that open add 1 %
  for (const char* name : {"springs_x[2]", "springs_y[2]", "springs_x[4]", "springs_y[4]"})
    EXPECT_NEAR(run.statistics(name)["normal_force"]["mean"].get<double>(), pressed, 0.03 * pressed) << name;
  for (const char* name : {"lost_x", "lost_y"})
    EXPECT_LT(run.statistics(name)["contact_time_ratio"].get<double>(), 0.5) << name;
  for (const char* name : {"below_x[0]", "above_x[0]", "below_y[0]", "above_y[0]"})
    EXPECT_GT(run.statistics(name)["impacts"].get<int>(), 20) << name;
  EXPECT_GT(run.summary["wear"]["tubes"][0]["life_years"]["value"].get<double>(), 2.0);
  EXPECT_LT(run.summary["wear"]["tubes"][0]["life_years"]["value"].get<double>(), 15.0);
  EXPECT_LT(run.summary["energy"]["residual_relative"].get<double>(), trusted_balance);
  EXPECT_TRUE(run.summary["warnings"].empty()) << run.summary["warnings"];
}

TEST(Examples, TubeInFlowIsStableWithAndWithoutItsSecondPlate) {
  const Workshop folder;
  const Results run = example_run(folder, "tube_in_flow", "results");
  const auto& stability = run.summary["stability"];
  ASSERT_EQ(stability.size(), 2u);
  EXPECT_TRUE(close_to(stability[0]["cases"][0]["ratios"][0], 0.1710, four_digits));
  EXPECT_TRUE(close_to(stability[1]["cases"][0]["ratios"][0], 0.4203, four_digits));
  EXPECT_EQ(stability[0]["cases"].size(), 2u) << "one for each K of the liquid";
  EXPECT_GT(run.summary["contact_sums"]["work_rate"].get<double>(), 0.0);
  EXPECT_TRUE(run.summary["warnings"].empty()) << run.summary["warnings"];
}

TEST(Examples, TubeStudyGoesFromTheFlowToTheYears) {
  const Workshop folder;
  const Results run = example_run(folder, "tube_study", "results");
  ASSERT_EQ(run.summary["stability"].size(), 2u);
  constexpr double of_margin = 1e-3; // four digits of a ratio near 1
  // all supports, inner bars out of action: bounds of a stable tube of the periphery
  EXPECT_TRUE(close_to(run.summary["stability"][0]["cases"][0]["margin"], 1.0 - 0.6016, four_digits));
  EXPECT_TRUE(close_to(run.summary["stability"][1]["cases"][0]["margin"], 1.0 - 0.9165, of_margin));
  EXPECT_EQ(run.summary["contacts"].size(), 20u);
  // a chaotic run of 9 s: the standard error of its work rate is 6 %
  const double work = run.summary["contact_sums"]["work_rate"],
               years = run.summary["wear"]["tubes"][0]["life_years"]["value"];
  EXPECT_GT(work, 0.02);
  EXPECT_LT(work, 0.035);
  EXPECT_GT(years, 20.0);
  EXPECT_LT(years, 45.0);
  EXPECT_LT(run.summary["energy"]["residual_relative"].get<double>(), trusted_balance);
  EXPECT_TRUE(run.summary["warnings"].empty()) << run.summary["warnings"];
  for (const char* file : {"flow.csv", "spectra.csv", "stability.csv"})
    EXPECT_TRUE(fs::exists(folder.path("results") / file)) << file;
}

TEST(Examples, StraightTubeHasItsFrequenciesAndItsWorkRate) {
  const Workshop folder;
  const Results run = example_run(folder, "straight_tube", "results");
  const auto& frequencies = run.summary["modes"]["frequencies_hz"];
  ASSERT_EQ(frequencies.size(), 41u);
  std::size_t bending = 0;
  for (int n = 1; n <= 20; ++n)
    for (int of_pair = 0; of_pair < 2; ++of_pair, ++bending) {
      const double exact = 0.503639 * n * n;
      if (std::abs(frequencies[bending].get<double>() - exact) > 0.01 * exact)
        ++bending; // the torsion mode among them
      EXPECT_TRUE(close_to(frequencies[bending], exact, mesh_of_ninety)) << "pair " << n;
    }
  double work = 0.0;
  for (const auto& contact : run.summary["contacts"])
    work += contact["work_rate"].get<double>();
  // a chaotic run: ten runs from slightly different starts scatter by about 2 %
  EXPECT_GT(work, 5.5);
  EXPECT_LT(work, 6.7);
  EXPECT_EQ(run.summary["contacts"].size(), 8u);
  EXPECT_LT(run.summary["energy"]["residual_relative"].get<double>(), trusted_balance);
  ASSERT_EQ(run.summary["warnings"].size(), 1u) << run.summary["warnings"];
  EXPECT_TRUE(says(run.summary["warnings"][0], "modal truncation")); // 0.7/K_N
}

TEST(Examples, TwoTubesMeetInTheirSpanAndAtTheEdgesOfTheirPlate) {
  const Workshop folder;
  const Results run = example_run(folder, "two_tubes", "results");
  ASSERT_EQ(run.summary["contacts"].size(), 5u);
  EXPECT_GT(run.statistics("span")["impacts"].get<int>(), 0);
  for (const char* edge : {"plate[0]@1", "plate[0]@2", "plate[1]@1", "plate[1]@2"})
    EXPECT_GT(run.statistics(edge)["impacts"].get<int>(), 0) << edge;
  EXPECT_LT(run.summary["energy"]["residual_relative"].get<double>(), trusted_balance);
  EXPECT_TRUE(run.summary["warnings"].empty()) << run.summary["warnings"];
}

TEST(Examples, UBendRattles) {
  const Workshop folder;
  const Results run = folder.run(
      example("u_bend"), "results",
      {"--set", "transient.duration=0.2", "--set", "output.statistics_from=0", "--set", "modes.count=60"});
  EXPECT_EQ(run.summary["contacts"].size(), 22u);
  int impacts = 0;
  for (const auto& contact : run.summary["contacts"])
    impacts += contact["impacts"].get<int>();
  EXPECT_GT(impacts, 0);
  EXPECT_LT(run.summary["energy"]["residual_relative"].get<double>(), trusted_balance);
  const auto& worn = run.summary["wear"]["supports"];
  ASSERT_EQ(worn.size(), 22u);
  EXPECT_EQ(worn[0]["geometry"]["kind"], "drilled_hole");
  EXPECT_EQ(worn[21]["geometry"]["kind"], "flat_bar");
  EXPECT_EQ(worn[21]["coefficient_m2_per_N"], 0.41e-15);
  EXPECT_EQ(run.summary["wear"]["tubes"].size(), 1u);
  const double frequencies[] = {0.105645, 0.186017, 0.455817, 0.675923,
                                0.685948, 1.015528, 1.107386, 1.910963};
  for (std::size_t i = 0; i < 8; ++i)
    EXPECT_TRUE(close_to(run.summary["modes"]["frequencies_hz"][i], frequencies[i], independent)) << i;
}

} // namespace
} // namespace fretwork::app::test::examples_test
