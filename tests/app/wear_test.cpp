// SPDX-License-Identifier: GPL-3.0-or-later
// Wear of a study: from the work rates of its contacts to depth and life, over operating states.
#include "study_text.hpp"
#include "wear/depth.hpp"
#include "wear/work_rate.hpp"
#include "worn_tubes.hpp"
#include <cmath>
#include <fmt/format.h>

namespace fretwork::app::test::wear_test {
namespace {

using namespace worn_tubes;
constexpr double round_off = 1e-12; ///< of sums and products of a few numbers
constexpr double of_sums = 1e-9;    ///< work summed by contact and by sector, over some ten thousand steps

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
