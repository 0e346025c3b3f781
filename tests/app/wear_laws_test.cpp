// SPDX-License-Identifier: GPL-3.0-or-later
// Laws, coefficients and geometries of wear: those that a study names, and those of its obstacles.
#include "study_text.hpp"
#include "wear/depth.hpp"
#include "worn_tubes.hpp"
#include <fmt/format.h>
#include <numbers>

namespace fretwork::app::test::wear_laws_test {
namespace {

using namespace worn_tubes;
constexpr double round_off = 1e-12; ///< of sums and products of a few numbers
constexpr double printed = 1e-7;    ///< reference values of eight digits
constexpr double of_sums = 1e-9;    ///< work summed by contact and by sector, over some ten thousand steps

} // namespace

TEST(WearLaws, OfAFlatBarHasItsReferenceLife) {
  const Workshop folder;
  const Results run =
      with_given_rate(folder, "geometry = \"flat_bar\"\ncoefficient = 2e-14\nlength = 8e-3\n", "2e-3");
  EXPECT_TRUE(close_to(support(run)["life_years"]["value"], 10.551999, printed));
  const Results reference = with_given_rate(
      folder, "geometry = \"flat_bar\"\nform = \"reference\"\ncoefficient = 2e-14\nlength = 8e-3\n", "2e-3");
  EXPECT_TRUE(close_to(support(reference)["life_years"]["value"], 10.625255, printed));
  EXPECT_FALSE(support(run)["work_rate"]["has_interval"]);
}

// 20 % of the wall is lost: V(0.4 wall) - V(0.2 wall) is left.
TEST(WearLaws, GoOnFromInitialWear) {
  const Workshop folder;
  const Results run = with_given_rate(
      folder, "geometry = \"flat_bar\"\ncoefficient = 2e-14\nlength = 8e-3\ninitial_wear = 0.2\nyears = 5\n",
      "2e-3");
  const wear::FlatBar bar{radius, 8e-3};
  const double a_year = 2e-14 * 2e-3 * year, before = wear::volume(bar, 0.2 * wall);
  const auto& worn = support(run);
  EXPECT_TRUE(close_to(worn["initial_depth_m"], 0.2 * wall, of_sums));
  EXPECT_TRUE(close_to(worn["initial_years"], before / a_year, of_sums));
  EXPECT_TRUE(close_to(worn["life_years"]["value"], 10.551999 - before / a_year, 10.0 * printed));
  EXPECT_TRUE(close_to(worn["volume_m3"]["value"], before + 5.0 * a_year, of_sums));
  EXPECT_TRUE(close_to(worn["depth_m"]["value"], wear::depth(bar, before + 5.0 * a_year).value(), of_sums));
  const Results spent = with_given_rate(
      folder, "geometry = \"flat_bar\"\ncoefficient = 2e-14\nlength = 8e-3\ninitial_wear = 0.5\n", "2e-3");
  EXPECT_EQ(support(spent)["life_years"]["value"], 0.0);
  EXPECT_TRUE(says(spent.summary["warnings"].dump(), "initial_wear = 0.5 is at or above limit = 0.4"));
  EXPECT_TRUE(says(run.summary["notes"].dump(),
                   "the work rates would have worn as much in 3.74 years at \\\"support0\\\""))
      << run.summary["notes"].dump();
}

TEST(WearLaws, OfEdfMzAppliesFromItsLeastWorkRateOn) {
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

TEST(WearLaws, OfKwuEpriTakesForcesAndSpeedsOfTheRun) {
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

TEST(WearLaws, BySectorsSharesTheVolume) {
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

TEST(WearLaws, TakesTheGeometryOfEachObstacle) {
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

TEST(WearLaws, TakesTheCoefficientOfTheBankByItsGeometry) {
  const Workshop folder;
  const Results run = with_given_rate(folder, "materials = \"690_600\"\nlength = 0.02\n", "1e-3");
  EXPECT_EQ(support(run)["coefficient_m2_per_N"], 52e-15);
  EXPECT_EQ(support(run)["coefficient_source"], "690_600 on drilled_hole: Code_Aster 17, POST_USURE");
}

} // namespace fretwork::app::test::wear_laws_test
