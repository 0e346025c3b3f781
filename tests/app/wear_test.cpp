// SPDX-License-Identifier: GPL-3.0-or-later
// Wear of a study: from the work rates of its contacts to depth and life, over operating states.
#include "mesh_text.hpp"
#include "program.hpp"
#include "study_text.hpp"
#include "wear/depth.hpp"
#include "wear/work_rate.hpp"
#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace fretwork::app::test::wear_test {
namespace {

constexpr double round_off = 1e-12;   ///< of sums and products of a few numbers
constexpr double printed = 1e-7;      ///< reference values of eight digits
constexpr double of_sums = 1e-9;      ///< work summed by contact and by sector, over some ten thousand steps
constexpr double year = 31536000.0;   // s
constexpr double radius = 9.525e-3;   // m
constexpr double clearance = 1e-5;    // m
constexpr double wall = 1.09e-3;      // m
constexpr double coefficient = 2e-14; // m2/N

const std::string short_run =
    "[transient]\nduration = 0.3\n[output]\nevery = 1.0e-3\nstatistics_from = 0.05\n";

/// Tubes that rattle and slide a little in holes, and [[wear]].
std::string worn_bundle(const Workshop& folder, int tubes, const std::string& wear,
                        const std::string& run = short_run) {
  std::string study = bundle(folder, tubes, run);
  for (int i = 0; i < tubes; ++i)
    study += across(fmt::format("drive{}", i), 0.1);
  return study + "[[wear]]\n" + wear;
}

const std::string archard = "coefficient = 2.0e-14\nlength = 0.02\n";

const nlohmann::json& support(const Results& run, std::size_t i = 0) {
  return run.summary["wear"]["supports"].at(i);
}

double sum(const nlohmann::json& numbers) {
  double total = 0.0;
  for (const auto& number : numbers)
    total += number.get<double>();
  return total;
}

/// A support that wears at a given rate: [[wear]] for the only contact.
Results with_given_rate(const Workshop& folder, const std::string& keys, const std::string& rate) {
  return folder.run_text(worn_bundle(folder, 1, keys + "states = [{ share = 1, work_rate = " + rate + " }]\n",
                                     "[transient]\nduration = 0.01\n"));
}

} // namespace

TEST(Wear, FollowsFromTheWorkRateOfTheContact) {
  const Workshop folder;
  const Results run = folder.run_text(worn_bundle(folder, 1, archard + "support_coefficient = 1e-14\n"));
  const auto& worn = support(run);
  const double w = run.statistics("support0")["work_rate"];
  ASSERT_GT(w, 0.0);
  EXPECT_EQ(worn["name"], "support0");
  EXPECT_EQ(worn["work_rate"]["value"], w);
  const double volume = coefficient * w * 40.0 * year;
  EXPECT_TRUE(close_to(worn["volume_m3"]["value"], volume, round_off));
  EXPECT_TRUE(close_to(worn["support_volume_m3"]["value"], 0.5 * volume, round_off));
  EXPECT_EQ(worn["geometry"]["kind"], "drilled_hole");
  EXPECT_EQ(worn["geometry"]["clearance_m"], clearance);
  EXPECT_EQ(worn["geometry"]["tube_radius_m"], radius);
  EXPECT_EQ(worn["geometry"]["wall_m"], wall);
  const auto depth = wear::depth(wear::DrilledHole{radius, clearance, 0.02}, 1.5 * volume);
  ASSERT_TRUE(depth);
  EXPECT_TRUE(close_to(worn["depth_m"]["value"], *depth / 1.5, round_off));
  EXPECT_TRUE(close_to(worn["support_depth_m"]["value"], *depth / 3.0, round_off));
  EXPECT_EQ(worn["coefficient_source"], "study");
}

TEST(Wear, DoesNotDependOnTheOutputSampling) {
  const Workshop folder;
  const fs::path study = folder.write("study.toml", worn_bundle(folder, 1, archard));
  const Results fine = folder.run(study, "fine");
  for (const char* every :
       {"0.05", "0.00037", "2.0e-5"}) { // coarse, no multiple of a step, finer than the step
    const Results other = folder.run(study, every, {"--set", std::string("output.every=") + every});
    EXPECT_NE(fine.archive.series.time.size(), other.archive.series.time.size()) << every;
    EXPECT_EQ(fine.summary["wear"], other.summary["wear"])
        << every; // to the last bit: numbers are written in full
    EXPECT_EQ(fine.statistics("support0"), other.statistics("support0")) << every;
  }
  EXPECT_GT(support(fine)["work_rate"]["value"], 0.0);
  EXPECT_TRUE(
      close_to(sum(support(fine)["sectors"]["work_rate"]), support(fine)["work_rate"]["value"], of_sums));
}

TEST(Wear, CarriesTheIntervalOfTheWorkRateToDepthAndLife) {
  const Workshop folder;
  const Results run = folder.run_text(worn_bundle(folder, 1, archard));
  const auto &worn = support(run), &contact = run.statistics("support0");
  const double w = contact["work_rate"], error = contact["standard_error"]["work_rate"];
  ASSERT_GT(error, 0.0);
  EXPECT_TRUE(worn["work_rate"]["has_interval"]);
  EXPECT_TRUE(close_to(worn["work_rate"]["low"], w - error, round_off));
  EXPECT_TRUE(close_to(worn["work_rate"]["high"], w + error, round_off));
  for (const auto& [end, rate] : {std::pair("low", w - error), {"high", w + error}}) {
    EXPECT_TRUE(close_to(worn["volume_m3"][end], coefficient * rate * 40.0 * year, round_off));
    const auto depth =
        wear::depth(wear::DrilledHole{radius, clearance, 0.02}, coefficient * rate * 40.0 * year);
    EXPECT_TRUE(close_to(worn["depth_m"][end], depth.value(), round_off));
  }
  const double limit = wear::volume(wear::DrilledHole{radius, clearance, 0.02}, 0.4 * wall);
  EXPECT_EQ(worn["life_years"]["end"], "reached");
  EXPECT_TRUE(close_to(worn["life_years"]["value"], limit / (coefficient * w) / year, round_off));
  EXPECT_TRUE(close_to(worn["life_years"]["low"], limit / (coefficient * (w + error)) / year, round_off));
  EXPECT_TRUE(close_to(worn["life_years"]["high"], limit / (coefficient * (w - error)) / year, round_off));
}

TEST(Wear, HasTheIntervalOfTheConfidenceThatIsAskedFor) {
  const Workshop folder;
  const Results plain = folder.run_text(worn_bundle(folder, 1, archard)),
                sure = folder.run_text(worn_bundle(folder, 1, archard + "confidence = 0.95\n"));
  const auto &contact = sure.statistics("support0"), &rate = support(sure)["work_rate"];
  const double w = contact["work_rate"], error = contact["standard_error"]["work_rate"],
               batches = contact["standard_error"]["work_rate_batches"];
  const auto interval = wear::work_rate_with_confidence(w, error, batches, 0.95);
  EXPECT_LT(rate["low"], w - error);
  EXPECT_TRUE(close_to(rate["low"], interval.low, round_off));
  EXPECT_TRUE(close_to(rate["high"], interval.high, round_off));
  EXPECT_TRUE(
      close_to(support(sure)["volume_m3"]["high"], coefficient * interval.high * 40.0 * year, round_off));
  EXPECT_EQ(support(sure)["confidence"], 0.95);
  EXPECT_FALSE(support(plain).contains("confidence"));
  EXPECT_EQ(rate["value"], support(plain)["work_rate"]["value"]);
}

TEST(Wear, OfPointsAlongAThicknessIsThatOfOneSupport) {
  const Workshop folder;
  std::string study = bundle(folder, 1, short_run) + across("drive0", 0.1);
  study.replace(study.find("gap = 1.0e-5"), 12, "gap = 1.0e-5\nthickness = 0.03");
  const Results run = folder.run_text(study + "[[wear]]\ncontacts = \"support*\"\ncoefficient = 2.0e-14\n");
  ASSERT_EQ(run.summary["wear"]["supports"].size(), 1u);
  const auto& worn = support(run);
  EXPECT_EQ(worn["contacts"], (std::vector<std::string>{"support0@1", "support0@2"}));
  EXPECT_EQ(worn["geometry"]["length_m"], 0.03);
  double value = 0.0, high = 0.0;
  for (const char* point : {"support0@1", "support0@2"}) {
    const auto& contact = run.statistics(point);
    value += contact["work_rate"].get<double>();
    high += contact["work_rate"].get<double>() + contact["standard_error"]["work_rate"].get<double>();
  }
  EXPECT_TRUE(close_to(worn["work_rate"]["value"], value, round_off));
  EXPECT_TRUE(close_to(worn["work_rate"]["high"], high, round_off));
  EXPECT_TRUE(close_to(sum(worn["sectors"]["work_rate"]), value, of_sums));
}

TEST(Wear, OfContactsThatAreOneSupportIsSummed) {
  const Workshop folder;
  const Results run = folder.run_text(
      worn_bundle(folder, 2, archard + "name = \"plate\"\ncontacts = \"support?\"\none_support = true\n"));
  ASSERT_EQ(run.summary["wear"]["supports"].size(), 1u);
  EXPECT_EQ(support(run)["name"], "plate");
  EXPECT_TRUE(close_to(support(run)["work_rate"]["value"],
                       run.statistics("support0")["work_rate"].get<double>() +
                           run.statistics("support1")["work_rate"].get<double>(),
                       round_off));
}

TEST(Wear, IsToldByTube) {
  const Workshop folder;
  const Results run = folder.run_text(worn_bundle(folder, 2, archard));
  const auto& tubes = run.summary["wear"]["tubes"];
  ASSERT_EQ(tubes.size(), 2u);
  for (std::size_t t = 0; t < 2; ++t) {
    EXPECT_EQ(tubes[t]["tube"], t);
    EXPECT_EQ(tubes[t]["deepest_support"], fmt::format("support{}", t));
    EXPECT_EQ(tubes[t]["work_rate"]["value"], support(run, t)["work_rate"]["value"]);
    EXPECT_EQ(tubes[t]["life_years"]["value"], support(run, t)["life_years"]["value"]);
  }
}

TEST(Wear, CombinesOperatingStates) {
  const Workshop folder;
  const fs::path part = folder.write(
      "part.toml", bundle(folder, 1, short_run) + "[[base_motion]]\ndirection = [0, 1, 0]\nconstant = 5\n");
  const Results other = folder.run(part, "part");
  const Results run = folder.run_text(worn_bundle(folder, 1, archard + R"(states = [
  { share = 0.7 }, { name = "part load", share = 0.2, results = "part" }, { share = 0.05, work_rate = [1e-3, 2e-3, 4e-3] },
  { share = 0.05, work_rate = 0 }])"));
  const auto& worn = support(run);
  const double w = run.statistics("support0")["work_rate"], v = other.statistics("support0")["work_rate"],
               error = run.statistics("support0")["standard_error"]["work_rate"],
               other_error = other.statistics("support0")["standard_error"]["work_rate"];
  ASSERT_NE(w, v);
  EXPECT_EQ(worn["states"].size(), 4u);
  EXPECT_EQ(worn["states"][1]["name"], "part load");
  EXPECT_EQ(worn["states"][1]["work_rate"]["value"], v);
  const double mean = 0.7 * w + 0.2 * v + 0.05 * 2e-3;
  EXPECT_TRUE(close_to(worn["work_rate"]["value"], mean, round_off));
  EXPECT_TRUE(close_to(worn["work_rate"]["high"], 0.7 * (w + error) + 0.2 * (v + other_error) + 0.05 * 4e-3,
                       round_off));
  EXPECT_TRUE(close_to(worn["volume_m3"]["value"], coefficient * mean * 40.0 * year, round_off));
}

TEST(Wear, IsComputedAgainWhereTheOtherRunHasChanged) {
  const Workshop folder;
  const auto other = [&](double acceleration) {
    return folder.run(folder.write("part.toml", bundle(folder, 1, short_run) +
                                                    fmt::format("[[base_motion]]\ndirection = [0, 1, 0]\n"
                                                                "constant = {}\n",
                                                                acceleration)),
                      "part");
  };
  const std::string study =
      worn_bundle(folder, 1, archard + "states = [{ share = 0.5 }, { share = 0.5, results = \"part\" }]\n");
  (void)other(5.0);
  const Results first = folder.run_text(study);
  EXPECT_TRUE(
      says(folder.fretwork({"transient", folder.path("study.toml"), "-o", folder.path("results")}).out,
           "up to date"));
  (void)other(9.0);
  EXPECT_NE(first.summary["wear"], folder.run_text(study).summary["wear"]);
}

TEST(Wear, OfAFlatBarHasItsReferenceLife) {
  const Workshop folder;
  const Results run =
      with_given_rate(folder, "geometry = \"flat_bar\"\ncoefficient = 2e-14\nlength = 8e-3\n", "2e-3");
  EXPECT_TRUE(close_to(support(run)["life_years"]["value"], 10.551999, printed));
  const Results reference = with_given_rate(
      folder, "geometry = \"flat_bar\"\nform = \"reference\"\ncoefficient = 2e-14\nlength = 8e-3\n", "2e-3");
  EXPECT_TRUE(close_to(support(reference)["life_years"]["value"], 10.625255, printed));
  EXPECT_FALSE(support(run)["work_rate"]["has_interval"]);
}

TEST(Wear, OfEdfMzAppliesFromItsLeastWorkRateOn) {
  const Workshop folder;
  const std::string law = "law = \"edf_mz\"\ngeometry = \"flat_bar\"\nlength = 8e-3\nyears = 20\n";
  const Results run = with_given_rate(folder, law, "5e-3");
  EXPECT_TRUE(close_to(support(run)["life_years"]["value"], 3.089330, 2.0 * printed));
  EXPECT_TRUE(close_to(support(run)["volume_m3"]["value"], 7.43318422e-8, printed));
  EXPECT_TRUE(support(run)["coefficient_m2_per_N"].is_null());
  const Results outside = with_given_rate(folder, law, "2e-3");
  EXPECT_EQ(support(outside)["life_years"]["end"], "outside_law");
  EXPECT_TRUE(support(outside)["depth_m"]["value"].is_null());
  EXPECT_TRUE(says(support(outside)["outside_law"], "edf_mz"));
  EXPECT_TRUE(says(outside.summary["warnings"].dump(), "wear of \\\"support0\\\": "));
}

TEST(Wear, OfNoWorkNeverReachesTheLimit) {
  const Workshop folder;
  const Results run = with_given_rate(folder, archard, "0");
  EXPECT_EQ(support(run)["life_years"]["end"], "never");
  EXPECT_TRUE(support(run)["life_years"]["value"].is_null());
  EXPECT_EQ(support(run)["depth_m"]["value"], 0.0);
}

// A part that is replaced: the tube does not wear, the support by Archard's volume and the segment of the tube.
TEST(Wear, OfTheSupportHasItsOwnLifeAndEndsThatOfAll) {
  const Workshop folder;
  const fs::path study = folder.write(
      "study.toml",
      bundle(folder, 1, "[transient]\nduration = 0.01\n") +
          "[[wear]]\ncoefficient = 0\nsupport_coefficient = 1e-14\nsupport_limit = 1e-3\nlength = 0.02\n"
          "geometry = \"flat_bar\"\nstates = [{ share = 1, work_rate = [1e-3, 2e-3, 4e-3] }]\n");
  const Outcome outcome =
      folder.fretwork({"run", study.string(), "--no-report", "-o", folder.path("out").string()});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const Results run = read_results(folder.path("out"));
  constexpr double radius = 9.525e-3, p = 1e-3;
  const double segment = radius * radius * std::acos(1.0 - p / radius) -
                         (radius - p) * std::sqrt(2.0 * radius * p - p * p),
               years = 0.02 * segment / (1e-14 * 2e-3) / year;
  EXPECT_EQ(support(run)["life_years"]["end"], "never");
  EXPECT_TRUE(close_to(support(run)["support_life_years"]["value"], years, 1e-9));
  const auto& tube = run.summary["wear"]["tubes"][0];
  EXPECT_EQ(tube["first_support"], "support0");
  EXPECT_EQ(tube["first_body"], "support");
  EXPECT_EQ(tube["life_years"], [&] {
    nlohmann::json all = support(run)["support_life_years"];
    all.erase("end");
    return all;
  }());
  EXPECT_TRUE(says(outcome.out, "the supports themselves"));
  EXPECT_TRUE(says(outcome.out, fmt::format("{:.3g} ({:.3g} to {:.3g})", years, 0.5 * years, 2.0 * years)));
}

TEST(Wear, BeyondTheWallIsTold) {
  const Workshop folder;
  const auto warnings = [&](const char* rate) {
    return with_given_rate(folder, archard, rate).summary["warnings"].dump();
  };
  EXPECT_TRUE(says(warnings("0.05"), "mm and the wall 1.09 mm: the tube is worn through before"));
  EXPECT_FALSE(says(warnings("1e-4"), "worn through"));
}

TEST(Wear, BeyondTheGeometryIsTold) {
  const Workshop folder;
  const Results run = with_given_rate(folder, archard, "10");
  EXPECT_TRUE(support(run)["depth_m"]["value"].is_null());
  EXPECT_GT(support(run)["volume_m3"]["value"], 0.0);
  EXPECT_EQ(support(run)["life_years"]["end"], "reached");
  EXPECT_TRUE(says(run.summary["warnings"].dump(), "have no depth, the scar leaves what geometry"));
}

// A life that leaves out the support that works most is not that of the tube. Other tubes have lives of their own.
TEST(Wear, WarnsOfASupportWithoutAnEntryThatWorksMost) {
  const Workshop folder;
  const std::string study = worn_bundle(folder, 2, archard + "contacts = \"support0\"\n");
  const auto warned = [&](const std::string& text) {
    return says(folder.run_text(text).summary["warnings"].dump(), "no [[wear]] names \\\"inner\\\"");
  };
  const auto inner = [&](const std::string& gap) { // another hole at the same node
    return study +
           "[[contacts]]\nname = \"inner\"\ngroup = \"support0\"\naxis = [1.0, 0.0, 0.0]\ngap = " + gap +
           "\nnormal_stiffness = 1.0e6\ntangential_stiffness = 1.0e6\nfriction = 0.3\n";
  };
  EXPECT_TRUE(warned(inner("0.2e-5"))); // within the other, which does not touch
  EXPECT_FALSE(warned(inner("1.0e-4")));
  const std::string summary = folder.run_text(study).summary["warnings"].dump();
  EXPECT_FALSE(says(summary, "no [[wear]]")) << "support1 is that of another tube";
}

TEST(Wear, OfKwuEpriTakesForcesAndSpeedsOfTheRun) {
  const Workshop folder;
  const std::string law =
      "law = \"kwu_epri\"\ncoefficient = 2e-14\nlength = 0.02\nconstants = { k1 = 4, k2 = ";
  const Results run =
      folder.run_text(worn_bundle(folder, 1, law + "0.1, force_max = 1000, speed_max = 10 }\n"));
  const auto& indices = support(run)["kwu_epri"];
  const double si = indices["impact_index"], sg = indices["sliding_index"];
  EXPECT_EQ(indices["share_above_maxima"], 0.0);
  ASSERT_GT(sg, 0.0);
  ASSERT_GT(si, sg);
  EXPECT_TRUE(close_to(support(run)["volume_m3"]["value"],
                       coefficient * sg * sg / (sg + si) * support(run)["work_rate"]["value"].get<double>() *
                           40.0 * year,
                       round_off));
  const Results narrow =
      folder.run_text(worn_bundle(folder, 1, law + "40, force_max = 1, speed_max = 0.001 }\n"));
  EXPECT_GT(support(narrow)["kwu_epri"]["share_above_maxima"], 0.0);
  EXPECT_TRUE(says(narrow.summary["warnings"].dump(), "above force_max or speed_max"));
}

TEST(Wear, BySectorsSharesTheVolume) {
  const Workshop folder;
  const Results run =
      folder.run_text(worn_bundle(folder, 1, archard + "geometry = \"sectors\"\nsectors = 12\n"));
  const auto &worn = support(run), &sectors = worn["sectors"];
  ASSERT_EQ(sectors["depth_m"].size(), 12u);
  const double total = sum(sectors["work_rate"]), volume = worn["volume_m3"]["value"];
  double largest = 0.0, volumes = 0.0;
  for (std::size_t k = 0; k < 12; ++k) {
    const wear::TubeSector sector{radius, 0.02, std::numbers::pi / 6.0};
    const double depth = sectors["depth_m"][k];
    EXPECT_NEAR(wear::volume(sector, depth), volume * sectors["work_rate"][k].get<double>() / total,
                of_sums * volume);
    largest = std::max(largest, depth);
    volumes += wear::volume(sector, depth);
  }
  EXPECT_TRUE(close_to(volumes, volume, of_sums));
  EXPECT_TRUE(close_to(worn["depth_m"]["value"], largest, of_sums));
}

TEST(Wear, TakesTheGeometryOfEachObstacle) {
  const Workshop folder;
  std::string study = bundle(folder, 1, "[transient]\nduration = 0.01\n");
  const auto add = [&](const std::string& name, const std::string& keys) {
    study +=
        fmt::format("[[contacts]]\nname = \"{}\"\ngroup = \"drive0\"\ny_axis = [0, 1, 0]\nnormal_stiffness = "
                    "1e6\nthickness = 0.02\nobstacle = \"{}\"\n{}\n",
                    name, name, keys);
  };
  add("plane_y", "gap = 1e-3");
  add("stop_z", "gap = 1e-3");
  add("circle", "gap = 0");
  add("drilled", "tube_radius = 9.525e-3\nhole_radius = 10.525e-3");
  add("broached",
      "tube_radius = 9.525e-3\nland_radius = 9.825e-3\nlobe_radius = 12e-3\nlands = 4\nland_angle = 20");
  add("egg_crate", "tube_radius = 9.525e-3\nhalf_widths = [0.011, 0.012]");
  add("bars_y", "tube_radius = 9.525e-3\nbars = 0.011");
  const Results run =
      folder.run_text(study + "[[wear]]\nmaterials = \"690_304\"\ncoefficient_class = \"any\"\n"
                              "length = 0.03\n");
  const std::vector<std::string> kinds{"drilled_hole", "flat_bar", "flat_bar", "ring",
                                       "drilled_hole", "lands",    "flat_bar", "flat_bar"};
  ASSERT_EQ(run.summary["wear"]["supports"].size(), kinds.size());
  for (std::size_t i = 0; i < kinds.size(); ++i)
    EXPECT_EQ(support(run, i)["geometry"]["kind"], kinds[i]) << support(run, i)["name"];
  EXPECT_TRUE(close_to(support(run, 4)["geometry"]["clearance_m"], 1e-3, of_sums));
  EXPECT_TRUE(close_to(support(run, 5)["geometry"]["clearance_m"], 3e-4, of_sums));
  EXPECT_EQ(support(run, 0)["coefficient_m2_per_N"], 16.2e-15);
  EXPECT_TRUE(says(support(run, 0)["coefficient_source"], "690_304 on any: "));
}

TEST(Wear, TakesTheCoefficientOfTheBankByItsGeometry) {
  const Workshop folder;
  const Results run = with_given_rate(folder, "materials = \"690_600\"\nlength = 0.02\n", "1e-3");
  EXPECT_EQ(support(run)["coefficient_m2_per_N"], 52e-15);
  EXPECT_EQ(support(run)["coefficient_source"], "690_600 on drilled_hole: Code_Aster 17, POST_USURE");
}

TEST(Wear, IsTheSameOnTwoRanks) {
  const Workshop folder;
  const fs::path study = folder.write(
      "study.toml",
      worn_bundle(folder, 2,
                  archard +
                      "contacts = \"support0\"\n[[wear]]\nlaw = \"kwu_epri\"\ncoefficient = 1e-14\nlength = "
                      "0.02\nconstants = { k1 = 4, k2 = 0.1, force_max = 1000, speed_max = 10 }\n"));
  const Results one = folder.run(study, "one"), two = folder.run(study, "two", {}, 2);
  EXPECT_EQ(one.summary["wear"], two.summary["wear"]);
  EXPECT_TRUE(bytes_of(folder.path("one") / "results.h5") == bytes_of(folder.path("two") / "results.h5"));
}

TEST(Wear, IsPrintedAndExported) {
  const Workshop folder;
  const fs::path study = folder.write("study.toml", worn_bundle(folder, 2, archard + "years = 30\n"));
  const Outcome outcome =
      folder.fretwork({"run", study.string(), "--no-report", "-o", folder.path("results").string()});
  EXPECT_TRUE(says(outcome.out, "in 30 years"));
  EXPECT_TRUE(says(outcome.out, "years to 0.436 mm"));
  EXPECT_TRUE(says(outcome.out, "archard 2e-14"));
  EXPECT_EQ(folder.fretwork({"export", folder.path("results").string()}).status, 0);
  const fs::path csv = folder.path("results") / "export-csv";
  EXPECT_TRUE(says(bytes_of(csv / "wear.csv"), "\"support0\",0,archard,2e-14,\"study\","));
  EXPECT_TRUE(says(bytes_of(csv / "support0_wear.csv"), "time [s],volume [m3],volume_low [m3]"));
  EXPECT_TRUE(
      says(bytes_of(csv / "support1_wear_sectors.csv"), "from [rad],to [rad],work_rate [W]\n-3.14159"));
}

} // namespace fretwork::app::test::wear_test
