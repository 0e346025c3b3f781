// SPDX-License-Identifier: GPL-3.0-or-later
#include "folder.hpp"
#include "results/write.hpp"
#include "synthetic.hpp"
#include <algorithm>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>
#include <nlohmann/json.hpp>
#include <numbers>
#include <set>

namespace fretwork::results::summary_test {
namespace {

using Json = nlohmann::json;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

std::string text_of(const RunResults& results) {
  const Folder folder;
  write_summary(folder / "summary.json", results);
  return bytes_of(folder / "summary.json");
}

Json summary_of(const RunResults& results) { return Json::parse(text_of(results)); }

std::set<std::string> keys(const Json& object) {
  std::set<std::string> out;
  for (const auto& [key, value] : object.items())
    out.insert(key);
  return out;
}

using Keys = std::set<std::string>;

TEST(Summary, HasTheKeysOfTheContract) {
  const Json s = summary_of(made_up());
  EXPECT_EQ(keys(s), (Keys{"version",        "study",    "ranks",     "seed",         "seeds",
                           "input_sha256",   "model",    "modes",     "contacts",     "contact_sums",
                           "error_estimate", "nodes",    "energy",    "transient",    "timings_s",
                           "warnings",       "notes",    "libraries", "vector_width", "files_sha256",
                           "sha256",         "overrides"}));
  EXPECT_EQ(keys(s["model"]), (Keys{"nodes", "elements", "dofs", "mass_kg", "different_structures"}));
  EXPECT_EQ(keys(s["modes"]),
            (Keys{"frequencies_hz", "residuals", "damping", "static_modes", "orthogonality", "distributed",
                  "error_estimate", "effective_mass_kg", "effective_mass_sum_kg", "moving_mass_kg"}));
  EXPECT_EQ(keys(s["energy"]), (Keys{"input_J", "initial_J", "stored_J", "modal_damping_J",
                                     "contact_damping_J", "friction_J", "residual_relative"}));
  EXPECT_EQ(keys(s["transient"]),
            (Keys{"scheme", "steps", "rejected", "force_evaluations", "step_min_s", "step_max_s",
                  "step_reason", "scheme_reason", "resolution", "scaled_modes", "contact_frequency_rad_s",
                  "outcome", "unconverged_steps", "duration_s", "end_time_s", "statistics_from_s"}));
  EXPECT_EQ(keys(s["timings_s"]),
            (Keys{"read", "mesh", "assembly", "modes", "basis", "transient", "output", "total"}));
}

TEST(Summary, ListsStaticModesApart) {
  RunResults results = made_up({.modes = 4});
  results.bases[0].static_modes = 1;
  results.bases[0].damping(3) = 0.5;
  const Json modes = summary_of(results)["modes"];
  EXPECT_EQ(modes["static_modes"], 1);
  EXPECT_EQ(modes["static_frequencies_hz"],
            Json::array({results.bases[0].omega(3) / (2.0 * std::numbers::pi)}));
  EXPECT_EQ(modes["static_damping"], Json::array({0.5}));
  for (const char* key : {"frequencies_hz", "residuals", "damping", "error_estimate", "effective_mass_kg"})
    EXPECT_EQ(modes[key].size(), 3u) << key;
}

TEST(Summary, HasTheKeysOfTheContractForAContactAndANode) {
  const Json s = summary_of(made_up());
  const Json& c = s["contacts"][0];
  EXPECT_EQ(keys(c), (Keys{"name",
                           "impacts",
                           "impacts_per_second",
                           "standard_error",
                           "contact_time_ratio",
                           "normal_force",
                           "normal_force_in_contact",
                           "tangential_force",
                           "displacement",
                           "position",
                           "penetration",
                           "work_rate",
                           "friction_power",
                           "impact_velocity",
                           "contact_duration",
                           "departure_velocity",
                           "energy",
                           "sliding_distance_m",
                           "impulse_Ns",
                           "sticking_ratio",
                           "step_error",
                           "static_flexibility"}));
  EXPECT_EQ(keys(c["departure_velocity"]), (Keys{"mean", "max"}));
  EXPECT_EQ(keys(c["energy"]), (Keys{"damping_J", "friction_J"}));
  EXPECT_EQ(keys(c["normal_force"]), (Keys{"mean", "rms", "max"}));
  EXPECT_EQ(keys(c["normal_force_in_contact"]), (Keys{"mean", "rms"}));
  EXPECT_EQ(keys(c["tangential_force"]), (Keys{"rms", "max"}));
  EXPECT_EQ(keys(c["displacement"]), (Keys{"y", "z", "radial"}));
  EXPECT_EQ(keys(c["displacement"]["y"]), (Keys{"mean", "std", "min", "max"}));
  EXPECT_EQ(keys(c["displacement"]["radial"]), (Keys{"rms", "max"}));
  EXPECT_EQ(keys(c["position"]), (Keys{"y", "z", "radial"}));
  EXPECT_EQ(keys(c["position"]["y"]), (Keys{"mean", "std", "min", "max"}));
  EXPECT_EQ(keys(c["penetration"]), (Keys{"max"}));
  EXPECT_EQ(keys(c["impact_velocity"]), (Keys{"mean", "rms", "max"}));
  EXPECT_EQ(keys(c["contact_duration"]), (Keys{"mean", "max"}));
  EXPECT_EQ(keys(s["nodes"][0]), (Keys{"name", "displacement", "standard_error"}));
  EXPECT_EQ(keys(s["nodes"][0]["displacement"]), (Keys{"x", "y", "z"}));
  EXPECT_EQ(keys(s["nodes"][0]["displacement"]["x"]), (Keys{"mean", "std", "min", "max"}));
}

TEST(Summary, PutsEachStatisticUnderItsName) {
  RunResults results = made_up();
  post::ContactSummary& c = results.contact_summaries[1];
  c = {5, 0.5, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, {8, 9, 10, 11}, {12, 13, 14, 15}, 16, 17, 40};
  results.contacts[1].rest = {0.5, 100.0, -200.0};
  c.work_rate = 18;
  c.friction_power = 18.5;
  c.impact_velocity_mean = 19;
  c.impact_velocity_rms = 19.5;
  c.impact_velocity_max = 20;
  c.contact_duration_mean = 21;
  c.contact_duration_max = 22;
  c.departure_velocity_mean = 23;
  c.departure_velocity_max = 24;
  c.impulse = 25;
  c.sliding_distance = 26;
  c.sticking_ratio = 0.125;
  c.damping_work = 27;
  c.friction_work = 28;
  c.impact_rate = 29;
  c.error = {30, 31, 32, 33, 34, 35, 36, 41, 42, 43, 44};
  results.contacts[1].static_flexibility = {37, 38, 39};
  EXPECT_EQ(summary_of(results)["contacts"][1], Json::parse(R"({
    "name": "tsp2", "impacts": 5, "impacts_per_second": 29.0, "contact_time_ratio": 0.5,
    "normal_force": {"mean": 1.0, "rms": 2.0, "max": 3.0}, "normal_force_in_contact": {"mean": 4.0, "rms": 5.0},
    "tangential_force": {"rms": 6.0, "max": 7.0},
    "displacement": {"y": {"mean": 8.0, "std": 9.0, "min": 10.0, "max": 11.0},
                     "z": {"mean": 12.0, "std": 13.0, "min": 14.0, "max": 15.0}, "radial": {"rms": 16.0, "max": 17.0}},
    "position": {"y": {"mean": 108.0, "std": 9.0, "min": 110.0, "max": 111.0},
                 "z": {"mean": -188.0, "std": 13.0, "min": -186.0, "max": -185.0}, "radial": {"rms": 16.0, "max": 17.0}},
    "penetration": {"max": 40.0},
    "work_rate": 18.0, "friction_power": 18.5, "impact_velocity": {"mean": 19.0, "rms": 19.5, "max": 20.0},
    "contact_duration": {"mean": 21.0, "max": 22.0}, "departure_velocity": {"mean": 23.0, "max": 24.0},
    "impulse_Ns": 25.0, "sliding_distance_m": 26.0, "sticking_ratio": 0.125,
    "energy": {"damping_J": 27.0, "friction_J": 28.0},
    "standard_error": {"work_rate": 30.0, "friction_power": 31.0, "impacts_per_second": 33.0,
                       "contact_time_ratio": 42.0, "normal_force": {"mean": 44.0, "rms": 32.0, "max": 43.0},
                       "displacement": {"y": {"std": 34.0}, "z": {"std": 35.0}}, "batches": 36.0, "work_rate_batches": 41.0},
    "step_error": null, "static_flexibility": {"exact": 37.0, "basis": 38.0, "missing": 39.0}})"));
  EXPECT_TRUE(summary_of(results)["contacts"][0]["static_flexibility"].is_null()) << "there is none";
}

TEST(Summary, CarriesTheMeasuredErrorsOfTheStep) {
  RunResults results = made_up({.contacts = 2});
  results.step_errors.resize(2);
  results.step_errors[1].parts = 3;
  results.step_errors[1].sums[transient::replayed_work] = 2.0;
  results.step_errors[1].errors[transient::replayed_work] = -0.5;
  results.step_errors[1].spreads[transient::replayed_work] = 0.25;
  const Json s = summary_of(results),
             error = Json::parse(
                 R"({"intervals": 3, "work_rate": {"relative": -0.25, "standard_error": 0.125}})");
  EXPECT_TRUE(s["contacts"][0]["step_error"].is_null()) << "of a run without replays";
  EXPECT_EQ(s["contacts"][1]["step_error"], error);
  EXPECT_EQ(s["contact_sums"]["step_error"], error);
}

TEST(Summary, AddsUpTheContactsWithTheErrorsOfTheSums) {
  RunResults results = made_up({.contacts = 2});
  results.contact_summaries[0].work_rate = 1.0;
  results.contact_summaries[1].work_rate = 2.5;
  const Json sums = summary_of(results)["contact_sums"];
  EXPECT_EQ(sums["work_rate"], 3.5);
  EXPECT_EQ(sums["impacts_per_second"], 31.5 + 32.5);
  EXPECT_EQ(sums["standard_error"], Json::parse(R"({"work_rate": 0.001, "friction_power": 0.0003,
                                                    "impacts_per_second": 2.5, "batches": 40.0, "work_rate_batches": 42.0})"));
}

TEST(Summary, TellsTheErrorsOfANode) {
  RunResults results = made_up();
  results.node_summaries[0].std_error = {1.0, 2.0, nan};
  results.node_summaries[0].batches = 16.0;
  EXPECT_EQ(
      summary_of(results)["nodes"][0]["standard_error"],
      Json::parse(
          R"({"displacement": {"x": {"std": 1.0}, "y": {"std": 2.0}, "z": {"std": null}}, "batches": 16.0})"));
}

TEST(Summary, WritesNullWhereThereAreTooFewBatches) {
  RunResults results = made_up();
  results.contact_summaries[0].error.work_rate = nan;
  EXPECT_TRUE(summary_of(results)["contacts"][0]["standard_error"]["work_rate"].is_null());
}

TEST(Summary, CarriesItsErrorEstimateAndWhatItIs) {
  const Json estimate = summary_of(made_up())["error_estimate"];
  EXPECT_EQ(keys(estimate), (Keys{"kind", "relative", "text"}));
  EXPECT_EQ(estimate["kind"], "statistical");
  const Json none = summary_of(made_up({.contacts = 0}))["error_estimate"];
  EXPECT_EQ(none["kind"], "none");
  EXPECT_TRUE(none["relative"].is_null());
}

TEST(Summary, SaysWhatTheStepResolves) {
  RunResults results = made_up({.structures = 2}); // steps of 2.5e-5 s, w_c = 2e4 rad/s
  results.transients[1].choice.contact_frequency = 1.0;
  results.transients[1].choice.stick_frequency = 4e3;
  results.transients[1].choice.structure_frequency = 800.0;
  results.transients[1].choice.damper_rate = 8e3;
  results.transients[1].report.counts.step_max = 1e-3;
  EXPECT_EQ(summary_of(results)["transient"]["resolution"],
            Json::parse(R"({"w_c_h": 0.5, "w_t_h": 4.0, "w_s_h": 0.8, "r_t_h": 8.0, "w_max_h": 1.256})"));
}

TEST(Summary, TellsAVerificationFigureByFigure) {
  RunResults results = made_up({.contacts = 1});
  Verification v;
  v.step_max = 1e-5;
  v.factor = 3.0;
  v.contacts = {{{"work_rate", 1.0, 1.5, 0.25, true}}};
  v.sums = {{"work_rate", 2.0, 4.0, nan, false}};
  results.verification = v;
  const Json told = summary_of(results)["verification"];
  EXPECT_EQ(told, Json::parse(
                      R"({"agrees": false, "step_max_s": 1e-5, "factor": {"sums": 2.0, "contacts": 3.0},
    "sums": [{"name": "work_rate", "value": 2.0, "value_at_half_step": 4.0, "difference": -2.0, "standard_error": null, "agrees": false}],
    "contacts": [{"name": "tsp1", "figures":
      [{"name": "work_rate", "value": 1.0, "value_at_half_step": 1.5, "difference": -0.5, "standard_error": 0.25, "agrees": true}]}]})"));
  EXPECT_EQ(summary_of(results)["error_estimate"]["kind"], "verified");
  results.verification->failure = "it stopped";
  EXPECT_EQ(summary_of(results)["verification"],
            Json::parse(R"({"agrees": false, "failure": "it stopped"})"));
}

TEST(Summary, HasNoShareOfStickingWithoutFriction) {
  RunResults results = made_up();
  results.contacts[0].friction_static = results.contacts[0].friction_dynamic = 0.0;
  const Json contacts = summary_of(results)["contacts"];
  EXPECT_TRUE(contacts[0]["sticking_ratio"].is_null());
  EXPECT_EQ(contacts[1]["sticking_ratio"], 0.27);
}

TEST(Summary, HasNoTransientKeysWithoutATransient) {
  const Keys found = keys(summary_of(made_up({.outputs = 0})));
  for (const char* absent : {"contacts", "nodes", "energy", "transient"})
    EXPECT_FALSE(found.contains(absent)) << absent;
  EXPECT_TRUE(found.contains("modes"));
}

TEST(Summary, SortsTheModesOfAllStructuresAndSaysWhoseTheyAre) {
  const Json modes = summary_of(made_up({.structures = 2, .modes = 4}))["modes"];
  const auto f = modes["frequencies_hz"].get<std::vector<double>>();
  ASSERT_EQ(f.size(), 8u);
  EXPECT_TRUE(std::is_sorted(f.begin(), f.end()));
  EXPECT_EQ(modes["structure"], Json::parse("[0, 0, 1, 1, 0, 0, 1, 1]"));
  EXPECT_EQ(modes["residuals"].size(), 8u);
  EXPECT_EQ(modes["damping"].size(), 8u);
}

TEST(Summary, GivesTheFirstSeedOrNull) {
  RunResults results = made_up();
  EXPECT_EQ(summary_of(results)["seed"], 7);
  EXPECT_EQ(summary_of(results)["seeds"], Json::parse("[7, 18446744073709551615]"));
  results.record.seeds.clear();
  EXPECT_TRUE(summary_of(results)["seed"].is_null());
}

TEST(Summary, AddsTheEnergiesOfTheStructuresAndBalances) {
  RunResults results = made_up({.structures = 2});
  results.transients[1].report.residual_relative = 0.5;
  results.transients[1].report.counts.step_min = 1e-5;
  results.transients[1].choice.reason = "the smaller step";
  const Json s = summary_of(results);
  const Json& e = s["energy"];
  EXPECT_EQ(e["input_J"], 3.25); // twice (0.125 + 1.5)
  EXPECT_EQ(e["initial_J"], 0.25);
  EXPECT_EQ(e["stored_J"].get<double>() + e["modal_damping_J"].get<double>() +
                e["contact_damping_J"].get<double>() + e["friction_J"].get<double>(),
            3.25); // the made-up energies are sums of powers of two: exact
  EXPECT_EQ(e["residual_relative"], 0.5);
  EXPECT_EQ(s["transient"]["steps"], 160000);
  EXPECT_EQ(s["transient"]["step_min_s"], 1e-5);
  EXPECT_EQ(s["transient"]["step_max_s"], 2.5e-5);
  EXPECT_EQ(s["transient"]["step_reason"], "the smaller step");
  EXPECT_EQ(s["transient"]["outcome"], "done");
}

TEST(Summary, WritesNullWhereARunDiverged) {
  RunResults results = made_up({.structures = 2});
  results.transients[0].report.outcome = transient::Outcome::diverged;
  results.transients[0].report.energy.stored = nan;
  results.transients[0].report.residual_relative = nan;
  results.contact_summaries[0].normal_max = infinity;
  const std::string text = text_of(results);
  const Json s = Json::parse(text); // JSON has no NaN: parsing would fail
  EXPECT_EQ(s["transient"]["outcome"], "diverged");
  EXPECT_TRUE(s["energy"]["stored_J"].is_null());
  EXPECT_TRUE(s["energy"]["residual_relative"].is_null());
  EXPECT_TRUE(s["contacts"][0]["normal_force"]["max"].is_null());
  for (const char* word : {"nan", "NaN", "inf\n", "Infinity"})
    EXPECT_EQ(text.find(word), std::string::npos) << word;
}

TEST(Summary, WritesNumbersThatReadBackTheSame) {
  RunResults results = made_up();
  results.model.mass_kg = 0.1 + 0.2;
  EXPECT_EQ(summary_of(results)["model"]["mass_kg"].get<double>(), 0.1 + 0.2);
  EXPECT_THAT(text_of(made_up()), testing::HasSubstr("\"mass_kg\": 4.6,\n"));
}

TEST(Summary, NamesEachWarningOnce) {
  RunResults results = made_up();
  results.warnings = {"a", "b"};
  results.transients[0].choice.warnings = {"b", "c"};
  EXPECT_EQ(summary_of(results)["warnings"], Json::parse(R"(["a", "b", "c"])"));
}

TEST(Summary, SurvivesATitleThatIsNotUtf8) {
  RunResults results = made_up();
  results.record.title = "caf\xe9";
  EXPECT_EQ(summary_of(results)["study"], "caf\xef\xbf\xbd");
}

} // namespace
} // namespace fretwork::results::summary_test
