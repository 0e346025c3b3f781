// SPDX-License-Identifier: GPL-3.0-or-later
// What a run says of the motion past the threshold: a limit cycle that is known, a growth that is that of the root, a stable tube.
#include "mesh_text.hpp"
#include "program.hpp"
#include "study_text.hpp"
#include "tube_in_flow.hpp"
#include <Eigen/LU>
#include <cmath>
#include <complex>
#include <fmt/format.h>
#include <numbers>

namespace fretwork::app::test::law_motion_test {
namespace {

using namespace tube_in_flow;
using nlohmann::json;

constexpr double density = 300.0;

std::string in_flow(double velocity) {
  return s1 + flow("s1", zone(0.0, 1.0, velocity, density, inside_of_light()));
}
/// Over the middle half of the tube.
std::string in_flow_of_middle(double velocity) {
  const auto part = [](double from, double to, double v) {
    return zone(from, to, v, density, inside_of_light());
  };
  return s1 + flow("s1", part(0.0, 0.25, 0.0) + part(0.25, 0.75, velocity) + part(0.75, 1.0, 0.0));
}
/// Stops on both sides of the middle, 0.5 mm from it.
std::string stops(const std::string& keys = "") {
  return "[[contacts]]\nname = \"stop\"\ngroup = \"middle\"\nobstacle = \"plane_z\"\naxis = [1, 0, 0]\n"
         "normal_stiffness = 1e5\ngap = 5e-4\n" +
         keys;
}
/// A run from a given speed of the tube. @param output  more of [output]
std::string moved(double speed, const std::string& transient, const std::string& output = "") {
  return fmt::format("[[initial]]\ngroup = \"tube\"\nvelocity = [0, 0, {}]\n[transient]\n{}"
                     "[output]\nnodes = [\"middle\"]\n{}",
                     speed, transient, output);
}

double watts(const json& motion, const char* term) { return motion["power_W"][term]["mean"]; }
double error_of(const json& motion, const char* term) { return motion["power_W"][term]["standard_error"]; }
bool warns(const json& summary, const std::string& part) {
  return summary["warnings"].dump().find(part) != std::string::npos;
}

/// V11 of doc/fluidelastic.md, by a Runge-Kutta method of order 8: six modes, lossless stops.
TEST(LawMotion, OfALimitCycleIsThatOfTheReference) {
  constexpr double of_steps = 1e-3;   // contacts are of order 2
  constexpr double of_samples = 5e-3; // 3000 outputs, not in step with the motion
  const Workshop folder;
  const json summary =
      summary_of(folder,
                 tube(in_flow_of_middle(4.0) + stops() +
                      moved(0.2, "duration = 8\nstep = 5e-5\n", "statistics_from = 5\nevery = 1e-3\n")),
                 "run");
  const json motion = summary["fluidelastic"][0]["motion"], place = motion["place"];
  EXPECT_EQ(place["name"], "stop");
  EXPECT_EQ(place["kind"], "contact");
  EXPECT_EQ(place["axis"], "z");
  EXPECT_TRUE(close_to(place["rms_m"], 4.6423795e-4, of_steps));
  EXPECT_TRUE(close_to(place["largest_m"], 6.733738331e-4, of_steps));
  EXPECT_TRUE(close_to(place["largest_of_diameter"], 6.733738331e-4 / outer, of_steps));
  EXPECT_TRUE(close_to(place["frequency_hz"], 42.24715150, of_steps));
  EXPECT_TRUE(close_to(place["reduced_velocity"], 4.0 / (42.24715150 * outer), of_steps));
  EXPECT_EQ(motion["later_from_s"], 5.0);
  EXPECT_FALSE(motion["growth"]["grows"].get<bool>());
  EXPECT_NEAR(motion["growth"]["rms_ratio"], 1.0, of_steps);
  EXPECT_FALSE(warns(summary, "still grows"));
  EXPECT_FALSE(warns(summary, "statistics begin"));
  // the fluid brings what the modes dissipate, which their speeds say too
  EXPECT_GT(watts(motion, "fluid"), 0.0);
  EXPECT_NEAR(watts(motion, "fluid"), watts(motion, "modal_damping"),
              3.0 * std::hypot(error_of(motion, "fluid"), error_of(motion, "modal_damping"),
                               error_of(motion, "stored")));
  const results::RunResults archive = read_results(folder.path("out")).archive;
  const Eigen::VectorXd rates = 2.0 * archive.bases[0].damping.cwiseProduct(archive.bases[0].omega),
                        squares =
                            archive.series.modal_velocity.rightCols(3000).rowwise().squaredNorm() / 3000.0;
  EXPECT_TRUE(close_to(watts(motion, "modal_damping"), rates.dot(squares), of_samples));
}

/// Dampers of stops and of the modes take what the fluid brings.
TEST(LawMotion, OfAStopWithLossesSharesThePowerOfTheFluid) {
  const Workshop folder;
  const Outcome outcome =
      outcome_of(folder,
                 tube(in_flow(4.0) + stops("normal_damping = 20\n") +
                      moved(0.2, "duration = 6\n", "statistics_from = 3\nevery = 1e-3\n")),
                 "run");
  const json motion = read_results(folder.path("out")).summary["fluidelastic"][0]["motion"];
  const double taken = watts(motion, "modal_damping") + watts(motion, "contact_damping");
  EXPECT_GT(watts(motion, "contact_damping"), 0.2 * taken);
  EXPECT_EQ(watts(motion, "friction"), 0.0);
  EXPECT_EQ(watts(motion, "loads"), 0.0);
  EXPECT_NEAR(watts(motion, "fluid"), taken + watts(motion, "stored"), 0.01 * taken);
  EXPECT_NEAR(watts(motion, "fluid"), taken,
              3.0 * error_of(motion, "fluid") + 3.0 * error_of(motion, "stored"));
  for (const char* part : {"unstable without contacts: contact \"stop\" moves along z_loc by",
                           "does not grow", "powers in mW: fluid "})
    EXPECT_TRUE(says(outcome.out, part));
}

/// Nothing limits the motion: from quarter to quarter it grows by exp(Re(s) T/4).
TEST(LawMotion, ThatGrowsIsThatOfTheRoot) {
  constexpr double of_blocks = 1e-3; // their ends are not in step with the motion
  const Workshop folder;
  const json summary = summary_of(folder, tube(in_flow(4.0) + moved(1e-4, "duration = 2\n")), "run");
  const json law = summary["fluidelastic"][0], motion = law["motion"], growth = motion["growth"];
  const double root = law["growth_per_s"], size = 2.0 * std::numbers::pi * law["frequency_hz"].get<double>();
  EXPECT_GT(root, 0.0);
  EXPECT_TRUE(growth["grows"].get<bool>());
  EXPECT_EQ(motion["later_from_s"], 1.0);
  EXPECT_TRUE(close_to(growth["rate_per_s"], root, of_blocks));
  EXPECT_NEAR(growth["rate_per_s"], root, 3.0 * growth["standard_error_per_s"].get<double>());
  EXPECT_TRUE(close_to(growth["rms_ratio"], std::exp(0.5 * root), of_blocks));
  EXPECT_TRUE(close_to(motion["place"]["frequency_hz"],
                       std::sqrt(size * size - root * root) / (2.0 * std::numbers::pi), of_blocks));
  EXPECT_TRUE(warns(summary, "the motion still grows, by 2.7"));
  EXPECT_FALSE(warns(summary, "statistics begin"));
}

/// The same limit cycle from a small speed, with statistics from the beginning.
TEST(LawMotion, ThatBuildsUpInTheWindowIsWarnedOf) {
  const Workshop folder;
  const json summary = summary_of(
      folder, tube(in_flow(4.0) + stops() + moved(1e-3, "duration = 8\n", "every = 1e-3\n")), "run");
  EXPECT_FALSE(summary["fluidelastic"][0]["motion"]["growth"]["grows"].get<bool>());
  EXPECT_TRUE(warns(summary, "the statistics begin before the motion has built up"));
  EXPECT_TRUE(warns(summary, "give output.statistics_from = 4"));
}

/// Outputs at 20 Hz of a motion at 34: its lines are folded.
TEST(LawMotion, HasNoFrequencyWhereOutputsAreTooFew) {
  const Workshop folder;
  const json summary =
      summary_of(folder, tube(in_flow(3.2) + moved(1e-3, "duration = 30\n", "every = 0.05\n")), "run");
  const json place = summary["fluidelastic"][0]["motion"]["place"];
  EXPECT_GT(place["rms_m"], 0.0);
  EXPECT_TRUE(place["frequency_hz"].is_null());
  EXPECT_TRUE(place["reduced_velocity"].is_null());
}

TEST(LawMotion, BelowTheThresholdIsNotGiven) {
  const Workshop folder;
  const Outcome outcome =
      outcome_of(folder, tube(in_flow(2.0) + stops() + moved(0.1, "duration = 0.5\n")), "run");
  const json summary = read_results(folder.path("out")).summary;
  EXPECT_TRUE(summary["fluidelastic"][0]["motion"].is_null());
  EXPECT_TRUE(says(outcome.out, "\"T1\": stable without contacts"));
  EXPECT_EQ(outcome.out.find("powers in mW"), std::string::npos);
  EXPECT_FALSE(warns(summary, "T1"));
}

/// A tube on each rank; two tubes that their stop joins have one energy balance.
TEST(LawMotion, IsTheSameOnAnyNumberOfRanks) {
  MeshText text = together(straight_line("tube", {0, 0, 0}, {1, 0, 0}, 40),
                           straight_line("other", {0, 0, 0.03}, {1, 0, 0.03}, 40));
  text.points.emplace_back("middle", 20);
  text.points.emplace_back("of_other", 41 + 20);
  const std::string both =
      steel_pipe("mesh.msh", metal) + pinned("tube") + pinned("other") +
      "[modes]\ncount = 6\ndamping = 0.01\n" + in_flow(4.0) +
      "[[flow]]\nname = \"T2\"\ngroup = \"other\"\nfrom = \"other_begin\"\nlaw = \"s1\"\n" +
      zone(0.0, 1.0, 4.5, density, inside_of_light()) + stops() + moved(0.1, "duration = 0.5\n") +
      "[[initial]]\ngroup = \"other\"\nvelocity = [0, 0, 0.1]\n";
  const Workshop folder;
  folder.write("mesh.msh", text.text());
  const fs::path study = folder.write("study.toml", both);
  const Results alone = folder.run(study, "alone"), ranks = folder.run(study, "ranks", {}, 2);
  EXPECT_EQ(lasting(alone.summary), lasting(ranks.summary));
  const json laws = alone.summary["fluidelastic"];
  ASSERT_EQ(laws.size(), 2u);
  EXPECT_EQ(laws[0]["motion"]["power_tubes"], json({"T1"}));
  EXPECT_EQ(laws[1]["motion"]["power_tubes"], json({"T2"}));
  EXPECT_TRUE(laws[1]["motion"]["place"].is_null()) << "nothing of it is observed";
  EXPECT_NE(watts(laws[0]["motion"], "fluid"), watts(laws[1]["motion"], "fluid"));
  const json joined =
      folder
          .run_text(
              both +
              "[[contacts]]\nname = \"meet\"\ngroup = \"middle\"\nother = \"of_other\"\naxis = [1, 0, 0]\n"
              "distance_1 = 0.0145\ndistance_2 = 0.015\nnormal_stiffness = 1e5\n")
          .summary["fluidelastic"];
  for (const json& law : joined)
    EXPECT_EQ(law["motion"]["power_tubes"], json({"T1", "T2"}));
  EXPECT_EQ(joined[0]["motion"]["power_W"], joined[1]["motion"]["power_W"]);
}

/// Root of a free vibration from its samples: a(t + h) + e^(2 Re(s) h) a(t - h) = 2 e^(Re(s) h) cos(Im(s) h) a(t).
std::complex<double> root_of(const Eigen::VectorXd& a, double step) {
  const Eigen::Index n = a.size() - 2;
  Eigen::MatrixXd before(n, 2);
  before << a.segment(1, n), -a.head(n);
  const Eigen::Vector2d x =
      (before.transpose() * before).inverse() * (before.transpose() * a.tail(n)); // 2 e^.. cos, e^..
  return {0.5 * std::log(x(1)) / step, std::acos(0.5 * x(0) / std::sqrt(x(1))) / step};
}

/// Laws frozen at the frequency of the mode: its free vibration decays or grows as its root says, m u'' + c u' + k u = 0 with
/// c = 2 m zeta w - q (D/V) c_d, k = m w^2 - q c_k.
TEST(LawMotion, UnderAFrozenLawIsThatOfTheRoot) {
  constexpr double of_roots = 1e-6, mass = 1.0993164814, damping = 0.01, constant = 3.0;
  const double w = 2.0 * std::numbers::pi * 33.425241258;
  struct Law {
    std::string keys;
    double velocity, stiffness, feed; ///< c_k, c_d
  };
  // Connors: c_d = 4 V_r/K^2 at the frequency of the mode
  const auto connors = [&](double velocity) {
    return Law{fmt::format("law = \"connors\"\nform = \"damping\"\nconstant = {}\n", constant), velocity, 0.0,
               4.0 * velocity / (33.425241258 * outer) / (constant * constant)};
  };
  const std::string table =
      "law = \"table\"\nfit = 0\ntable = [[1, -2, 0.6], [9, -2, 0.6]]\n"; // V_r, c_k, c_d
  for (const Law& law :
       {connors(0.6), connors(2.0), Law{table, 1.0, -2.0, 0.6}, Law{table, 4.0, -2.0, 0.6}}) {
    SCOPED_TRACE(fmt::format("{}{} m/s", law.keys, law.velocity));
    const Workshop folder;
    const json summary =
        summary_of(folder,
                   tube("[flow_laws.frozen]\n" + law.keys +
                        flow("frozen", zone(0.0, 1.0, law.velocity, density, inside_of_light())) +
                        moved(0.01, "duration = 0.5\n", "every = 1e-3\n")),
                   "run");
    const Eigen::VectorXd first = read_results(folder.path("out")).archive.series.modal_displacement.row(0);
    const std::complex<double> found = root_of(first, 1e-3);
    const double q = 0.5 * density * law.velocity * law.velocity,
                 rate = 0.5 * (2.0 * damping * w - q * outer / law.velocity * law.feed / mass),
                 square = w * w - q * law.stiffness / mass;
    EXPECT_TRUE(close_to(std::norm(found), square, of_roots));
    EXPECT_NEAR(found.real(), -rate, of_roots * std::abs(found));
    const json root = summary["fluidelastic"][0];
    if (root["growth_per_s"] > 0.0) { // it is the one of the first mode
      EXPECT_TRUE(close_to(found.real(), root["growth_per_s"], of_roots));
      EXPECT_TRUE(
          close_to(std::abs(found), 2.0 * std::numbers::pi * root["frequency_hz"].get<double>(), of_roots));
    }
    EXPECT_EQ(found.real() > 0.0, law.velocity >= 2.0);
  }
}

} // namespace
} // namespace fretwork::app::test::law_motion_test
