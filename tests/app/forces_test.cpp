// SPDX-License-Identifier: GPL-3.0-or-later
// Section forces, stresses and reactions of runs: statics and single modes in closed form, supports that move, springs, sweeps and ranks.
#include "mesh_text.hpp"
#include "program.hpp"
#include "study_text.hpp"
#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace fretwork::app::test::forces_test {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double length = 2.0, outer = 0.01905, inner = outer - 2 * 0.00109, young = 2.0e11;
const double inertia = pi * (std::pow(outer, 4) - std::pow(inner, 4)) / 64.0;
const double stiffness = young * inertia; // N m2
constexpr int elements = 16;
constexpr const char* pinned = "[\"ux\", \"uy\", \"uz\", \"rx\"]";

/// A tube along x.
void write_tube(const Workshop& folder) {
  MeshText mesh = straight_line("tube", {0.0, 0.0, 0.0}, {length, 0.0, 0.0}, elements);
  mesh.points.emplace_back("middle", elements / 2);
  folder.write("mesh.msh", mesh.text());
}

std::string study(const std::string& begin, const std::string& end, int modes, const std::string& more,
                  double duration = 0.2) {
  return steel_pipe("mesh.msh") + tube_between("tube", begin, end) + more +
         fmt::format("[modes]\ncount = {}\n[transient]\nduration = {}\n[output]\nevery = 1.0e-3\n"
                     "section_forces = [\"tube\"]\nreactions = [\"tube_begin\", \"tube_end\"]\n",
                     modes, duration);
}

const nlohmann::json& reaction(const Results& run, std::size_t number) {
  return run.summary["reactions"].at(number);
}

/// A mode of pins, A sin(pi x/L) cos(w t), of amplitude 1 mm.
TEST(Forces, OfAModeAreThoseOfItsCurvature) {
  const Workshop folder;
  write_tube(folder);
  constexpr double amplitude = 1e-3;
  // the field of the study is given at nodes: one at the middle starts other modes too, so the first is left alone
  const Results run = folder.run_text(
      study(pinned, pinned, 1, fmt::format("[[initial]]\ngroup = \"middle\"\nvelocity = [0.0, 1.0, 0.0]\n")));
  const Eigen::MatrixXd& q = run.archive.series.modal_displacement;
  const modal::Basis& basis = run.archive.bases.at(0);
  const double in_middle = basis.shapes.col(0).segment<3>(6 * (elements / 2)).norm();
  const double largest = in_middle * q.cwiseAbs().maxCoeff();
  EXPECT_GT(largest, 0.01 * amplitude);
  const double wave = pi / length;
  const auto& forces = run.summary["section_forces"].at(0);
  constexpr double of_mesh = 2e-5; // (wave h)^4 / 720 and more of its like
  constexpr double sampled = 2e-3; // the largest output, 1 ms apart, is below that of every step
  const double moment = stiffness * wave * wave * largest, shear = stiffness * std::pow(wave, 3) * largest;
  EXPECT_TRUE(close_to(forces["moment"]["largest"], moment, sampled));
  EXPECT_TRUE(close_to(forces["moment"]["s"], 0.5 * length, 1e-9));
  EXPECT_TRUE(close_to(forces["shear_force"]["largest"], shear, sampled));
  EXPECT_TRUE(close_to(forces["stress"]["largest"],
                       forces["moment"]["largest"].get<double>() * 0.5 * outer / inertia, 1e-12));
  // ratios know nothing of time
  EXPECT_TRUE(
      close_to(forces["shear_force"]["largest"].get<double>() / forces["moment"]["largest"].get<double>(),
               wave, of_mesh));
  for (const std::size_t end : {0u, 1u}) {
    EXPECT_TRUE(
        close_to(reaction(run, end)["largest_force"], forces["shear_force"]["largest"].get<double>(), 1e-9));
    EXPECT_TRUE(reaction(run, end)["moment"]["z"].is_null()) << "a pin turns";
  }
  // the series: the pins pull the tube back where it is
  const Eigen::MatrixXd& series = run.archive.series.reactions.at(0).force;
  ASSERT_EQ(series.rows(), q.cols());
  const Eigen::VectorXd middle = q.row(0).transpose() * basis.shapes(6 * (elements / 2) + 1, 0);
  EXPECT_LT((series.col(1) + stiffness * std::pow(wave, 3) * middle).norm(), of_mesh * series.col(1).norm());
}

/// The weight w of a tube between clamps: w L/2 and w L^2/12 at each, w L^2/24 in the middle. The static start moves nothing after it.
TEST(Forces, OfTheWeightAreThoseOfStatics) {
  const Workshop folder;
  write_tube(folder);
  std::string text = study("\"all\"", "\"all\"", 8, "[gravity]\nacceleration = [0.0, -9.81, 0.0]\n", 0.01);
  text.replace(text.find("[transient]"), 11, "[transient]\nstart = \"static\"");
  const Results run = folder.run_text(text);
  const double weight = 9.81 * 8000.0 * pi * (outer * outer - inner * inner) / 4.0;
  constexpr double statics = 1e-7; // few modes: what they lack follows the loads
  for (const std::size_t end : {0u, 1u}) {
    const auto& held = reaction(run, end);
    EXPECT_TRUE(close_to(held["force"]["y"]["mean"], 0.5 * weight * length, statics)) << end;
    EXPECT_TRUE(close_to(held["moment"]["z"]["mean"],
                         (end == 0 ? 1.0 : -1.0) * weight * length * length / 12.0, statics))
        << end;
    EXPECT_LT(held["force"]["y"]["std"].get<double>(), 1e-6 * weight);
  }
  const auto& moment = run.summary["section_forces"].at(0)["moment"];
  EXPECT_TRUE(close_to(moment["largest"], weight * length * length / 12.0, statics));
  const auto& sites = run.archive.force_sites;
  for (std::size_t k = 0; k < sites.size(); ++k)
    if (sites[k].is_section()) {
      const auto& there = run.archive.force_summaries[k].components;
      const double x = sites[k].s;
      EXPECT_NEAR(there[1].mean, -weight * (0.5 * length - x), statics * weight * length);
      EXPECT_NEAR(there[5].mean, -weight * (length * length / 12.0 - 0.5 * x * (length - x)),
                  statics * weight * length * length);
    }
}

/// A mass on a spring and a damper to the ground.
constexpr double mass = 2.0, spring = 2.0e4, damper = 40.0;
Results on_spring_and_damper(const Workshop& folder, const std::string& more) {
  folder.write("mesh.msh", lone_points({"mass"}).text());
  return folder.run_text(R"([mesh]
file = "mesh.msh"
[[masses]]
group = "mass"
mass = 2.0
[[restraints]]
group = "mass"
fixed = ["ux", "uz", "rx", "ry", "rz"]
[[springs]]
group = "mass"
stiffness = [0.0, 2.0e4, 0.0, 0.0, 0.0, 0.0]
damping = [0.0, 40.0, 0.0, 0.0, 0.0, 0.0]
[modes]
count = 1
)" + more + R"([transient]
duration = 4.0
[output]
every = 1.0e-3
nodes = ["mass"]
reactions = ["mass"]
statistics_from = 3.0
)");
}

/// Equilibrium at every output, F + R = m a; of the statistics the amplitude of the steady state.
TEST(Forces, OfSpringsAndDampersToTheGroundAreReactions) {
  const Workshop folder;
  constexpr double force = 40.0, omega = 2.0 * pi * 10.0;
  const Results run =
      on_spring_and_damper(folder, "[[loads]]\ngroup = \"mass\"\ndirection = [0.0, 1.0, 0.0]\nharmonic = { "
                                   "amplitude = 40.0, frequency = 10.0 }\n");
  const Eigen::VectorXd& time = run.archive.series.time;
  const Eigen::VectorXd load = force * (omega * time.array()).sin();
  const Eigen::VectorXd inertia_force = mass * run.node("mass").acceleration.col(1);
  const Eigen::VectorXd held = run.archive.series.reactions.at(0).force.col(1);
  EXPECT_LT((load + held - inertia_force).cwiseAbs().maxCoeff(), 1e-9 * force);
  const double amplitude =
      force * std::hypot(spring, damper * omega) / std::hypot(spring - mass * omega * omega, damper * omega);
  constexpr double of_step = 1e-3; // (w h)^2/8 of 200 steps a period, and outputs between them
  const auto& statistics = reaction(run, 0);
  EXPECT_TRUE(close_to(statistics["force"]["y"]["std"], amplitude / std::sqrt(2.0), of_step));
  EXPECT_TRUE(close_to(statistics["largest_force"], amplitude, of_step));
  EXPECT_TRUE(statistics["force"]["x"].is_object()) << "restrained";
}

/// Of a mass that follows its ground: what accelerates it, m s'', where k s would be 5.6 kN and c s' 5.5 N at 3.5 s. The curve through two rows of displacement, at rest at
/// both, is s = 3 (t/T)^2 - 2 (t/T)^3 for T = 10 s.
TEST(Forces, OfSpringsAndDampersWhoseGroundMovesKnowItsMotion) {
  const Workshop folder;
  const Results run =
      on_spring_and_damper(folder, "[[support_motion]]\ngroup = \"mass\"\ndirection = [0.0, 1.0, 0.0]\n"
                                   "quantity = \"displacement\"\ntable = [[0.0, 0.0], [10.0, 1.0]]\n");
  const auto accelerating = [](double time) { return mass * (0.06 - 0.012 * time); };
  constexpr double of_window = 2e-4; // from a step after 3 s on; the spring follows c/k later
  EXPECT_TRUE(close_to(reaction(run, 0)["force"]["y"]["mean"], accelerating(3.5), of_window));
  EXPECT_TRUE(
      close_to(run.archive.series.reactions.at(0).force.bottomRows(1)(0, 1), accelerating(4.0), of_window));
}

/// 12 EI d/L^3 and 6 EI d/L^2 of clamps of which one has moved by d, and nothing of a base that moves all.
TEST(Forces, ContainThoseOfSupportsThatMove) {
  const Workshop folder;
  write_tube(folder);
  const double moved = 1e-3;
  const std::string ramp =
      "quantity = \"displacement\"\ntable = [[0.0, 0.0], [2.0, 1.0e-3], [3.0, 1.0e-3]]\n";
  const std::string one = "[[support_motion]]\ngroup = \"tube_end\"\ndirection = [0.0, 0.0, 1.0]\n" + ramp;
  std::string text = study("\"all\"", "\"all\"", 10, one, 3.0);
  text += "statistics_from = 2.9\n";
  text.replace(text.find("[modes]"), 7, "[modes]\ndamping = 0.1");
  const Results run = folder.run_text(text);
  const double shear = 12.0 * stiffness * moved / std::pow(length, 3),
               moment = 6.0 * stiffness * moved / (length * length);
  constexpr double at_rest = 1e-6;
  EXPECT_TRUE(close_to(reaction(run, 1)["force"]["z"]["mean"], shear, at_rest));
  EXPECT_TRUE(close_to(reaction(run, 0)["force"]["z"]["mean"], -shear, at_rest));
  EXPECT_TRUE(close_to(reaction(run, 0)["largest_moment"], moment, at_rest));
  EXPECT_TRUE(close_to(run.summary["section_forces"].at(0)["moment"]["largest"], moment, at_rest));
  EXPECT_TRUE(close_to(run.archive.series.reactions.at(1).force.bottomRows<1>()(2), shear, at_rest));
  std::string both = one;
  both.replace(both.find("tube_end"), 8, "tube_begin");
  text.insert(text.find("[[support_motion]]"), both);
  EXPECT_LT(folder.run_text(text).summary["section_forces"].at(0)["moment"]["largest"].get<double>(),
            at_rest * moment);
}

/// A spring to another node pulls at the restrained one: R = k (0 - u).
TEST(Forces, OfARestraintContainItsSprings) {
  const Workshop folder;
  write_tube(folder);
  const std::string spring = "[[springs]]\ngroup = \"middle\"\nother = \"tube_end\"\n"
                             "stiffness = [0.0, 5.0e3, 0.0, 0.0, 0.0, 0.0]\n";
  const std::string push = "[[initial]]\ngroup = \"middle\"\nvelocity = [0.0, 1.0, 0.0]\n";
  const Results run = folder.run_text(study(pinned, pinned, 8, spring + push));
  const Eigen::MatrixXd &begin = run.archive.series.reactions.at(0).force,
                        &end = run.archive.series.reactions.at(1).force;
  const modal::Basis& basis = run.archive.bases.at(0);
  const Eigen::VectorXd middle = run.archive.series.modal_displacement.transpose() *
                                 basis.shapes.row(6 * (elements / 2) + 1).transpose();
  EXPECT_GT((end.col(1) - begin.col(1)).norm(), 0.1 * begin.col(1).norm());
  // the beam pulls at both pins alike
  EXPECT_LT((end.col(1) - begin.col(1) + 5.0e3 * middle).norm(), 1e-6 * begin.col(1).norm());
}

TEST(Forces, AreTheSameInSweepsAndOnAllRanks) {
  const Workshop folder;
  const std::string text = bundle(folder, 3, R"([transient]
duration = 0.3
[output]
nodes = ["drive1"]
section_forces = ["tube0", "tube2"]
reactions = ["tube1_begin", "tube0_end", "tube1_end"]
)");
  const Results run = folder.run_text(text);
  ASSERT_EQ(run.summary["section_forces"].size(), 2u);
  EXPECT_EQ(run.summary["section_forces"].at(1)["group"], "tube2");
  EXPECT_GT(run.summary["section_forces"].at(1)["stress"]["largest"].get<double>(), 1e3);
  EXPECT_GT(run.summary["reactions"].at(0)["largest_moment"].get<double>(), 0.0);
  for (const post::ReactionSeries& series : run.archive.series.reactions)
    EXPECT_EQ(series.force.rows(), run.archive.series.time.size()) << series.name;
  for (const int ranks : {2, 3}) {
    const Results many = folder.run(folder.path("study.toml"), fmt::format("ranks{}", ranks), {}, ranks);
    EXPECT_TRUE(same_numbers(many.archive, run.archive)) << ranks;
    for (const char* key : {"section_forces", "reactions"})
      EXPECT_EQ(many.summary[key], run.summary[key]) << ranks;
  }
  folder.write("sweep.toml", text + "[sweep]\ndesign = \"grid\"\n[[sweep.variables]]\n"
                                    "key = \"modes.damping\"\nvalues = [0.01]\n");
  ASSERT_EQ(folder.fretwork({"sweep", folder.path("sweep.toml").string(), "--no-report"}).status, 0);
  const std::string table = bytes_of(folder.path("sweep.sweep") / "table.csv");
  const std::string row =
      table.substr(table.find('\n', table.rfind("nr", 0) == 0 ? 0 : table.find("tube0.stress")));
  for (const nlohmann::json& value : {run.summary["section_forces"].at(0)["stress"]["largest"],
                                      run.summary["section_forces"].at(1)["moment"]["largest"],
                                      run.summary["section_forces"].at(0)["shear_y"]["largest"],
                                      run.summary["section_forces"].at(1)["moment_z"]["largest"],
                                      run.summary["reactions"].at(0)["largest_force"],
                                      run.summary["nodes"].at(0)["displacement"]["y"]["std"]})
    EXPECT_TRUE(says(row, fmt::format(",{},", value.get<double>())));
}

/// A slow harmonic force in the middle, and its like of another entry: halves of it at the pins, whatever the modes.
TEST(Forces, FollowLoadsThatVary) {
  const Workshop folder;
  write_tube(folder);
  const std::string push = "[[loads]]\ngroup = \"middle\"\ndirection = [0.0, 1.0, 0.0]\n"
                           "harmonic = { amplitude = 6.0, frequency = 0.05 }\n";
  const Results run = folder.run_text(study(pinned, pinned, 4, push + push, 5.0) + "statistics_from = 4.0\n",
                                      {"--set", "modes.damping=0.5"});
  constexpr double slow = 2e-4; // (f/f1)^2 of what inertia and damping add
  for (const std::size_t end : {0u, 1u}) {
    EXPECT_TRUE(close_to(reaction(run, end)["force"]["y"]["min"], -6.0, slow)) << end;
    EXPECT_TRUE(close_to(run.archive.series.reactions.at(end).force.bottomRows<1>()(1), -6.0, slow)) << end;
  }
  EXPECT_TRUE(close_to(run.summary["section_forces"].at(0)["shear_force"]["largest"], 6.0, slow));
  const auto& forces = run.summary["section_forces"].at(0);
  EXPECT_TRUE(close_to(forces["moment"]["largest"], 6.0 * 0.5 * length, slow));
  EXPECT_TRUE(close_to(forces["shear_y"]["largest"], 6.0, slow));
  EXPECT_TRUE(close_to(forces["moment_z"]["largest"], 6.0 * 0.5 * length, slow));
  for (const char* across : {"shear_z", "moment_y"})
    EXPECT_EQ(forces[across]["largest"], 0.0) << across;
}

/// A tube that its weight presses on a stop: reactions, stop and weight are in equilibrium with few modes, and the moments they make are those
/// of its sections; and on two stops alone.
TEST(Forces, BesideContactsAreThoseOfStatics) {
  const Workshop folder;
  MeshText mesh = straight_line("tube", {0.0, 0.0, 0.0}, {length, 0.0, 0.0}, elements);
  mesh.points.emplace_back("quarter", elements / 4);
  mesh.points.emplace_back("other_quarter", 3 * elements / 4);
  folder.write("mesh.msh", mesh.text());
  const double weight = 9.81 * 8000.0 * pi * (outer * outer - inner * inner) / 4.0 * length;
  const auto stop = [](const char* group) {
    return fmt::format("[[contacts]]\ngroup = \"{}\"\naxis = [1.0, 0.0, 0.0]\ny_axis = [0.0, -1.0, 0.0]\n"
                       "obstacle = \"stop_y\"\ngap = 0.0\nnormal_stiffness = 1.0e6\n",
                       group);
  };
  const std::string gravity = "[gravity]\nacceleration = [0.0, -9.81, 0.0]\n";
  constexpr double statics = 1e-7;
  std::string text = study("\"all\"", pinned, 6, gravity + stop("quarter"), 0.01);
  text.replace(text.find("[transient]"), 11, "[transient]\nstart = \"static\"");
  const Results held = folder.run_text(text);
  const double by_stop = held.summary["contacts"].at(0)["normal_force"]["mean"],
               left = reaction(held, 0)["force"]["y"]["mean"],
               right = reaction(held, 1)["force"]["y"]["mean"];
  EXPECT_GT(by_stop, 0.2 * weight);
  EXPECT_NEAR(left + right + by_stop, weight, statics * weight);
  EXPECT_NEAR(reaction(held, 0)["moment"]["z"]["mean"].get<double>() + right * length +
                  by_stop * 0.25 * length,
              0.5 * weight * length, statics * weight * length);
  EXPECT_NEAR(held.archive.series.reactions.at(1).force.bottomRows<1>()(1), right, 1e-4 * right);
  // on two stops: w (L/4)^2/2 above them, as much below in the middle
  std::string loose = steel_pipe("mesh.msh") + tube_between("tube", "", "") + gravity + stop("quarter") +
                      stop("other_quarter") +
                      "[modes]\ncount = 12\n[transient]\nduration = 0.01\nstart = \"static\"\n"
                      "[output]\nsection_forces = [\"tube\"]\n";
  const auto moment = folder.run_text(loose).summary["section_forces"].at(0)["moment"];
  EXPECT_TRUE(close_to(moment["largest"], weight * length / 32.0, statics));
}

/// Nothing strains a tube in free fall.
TEST(Forces, OfAFreeStructureAreThoseInItsOwnFrame) {
  const Workshop folder;
  write_tube(folder);
  const std::string free = steel_pipe("mesh.msh") + tube_between("tube", "", "") +
                           "[gravity]\nacceleration = [0.0, -9.81, 0.0]\n[modes]\ncount = 12\n"
                           "[transient]\nduration = 0.05\n[output]\nsection_forces = [\"tube\"]\n";
  const auto forces = folder.run_text(free).summary["section_forces"].at(0);
  EXPECT_LT(forces["shear_force"]["largest"].get<double>(), 1e-6);
  EXPECT_LT(forces["moment"]["largest"].get<double>(), 1e-6);
}

TEST(Forces, AreRefusedWhereThereAreNone) {
  const Workshop folder;
  write_tube(folder);
  const std::string text =
      steel_pipe("mesh.msh") + tube_between("tube") + "[transient]\nduration = 0.1\n[output]\n";
  const auto refused = [&](const std::string& output, const std::string& why) {
    folder.write("study.toml", text + output);
    const Outcome outcome = folder.fretwork({"run", folder.path("study.toml").string()});
    EXPECT_NE(outcome.status, 0);
    EXPECT_TRUE(says(outcome.err, why));
  };
  refused("reactions = [\"middle\"]\n",
          "[output] reactions: neither [[restraints]] nor [[springs]] to the ground hold \"middle\"");
  refused("section_forces = [\"middle\"]\n", "\"middle\"");
  refused("reactions = [\"tube_end\", \"tube_end\"]\n", "named twice");
  MeshText mesh = straight_line("tube", {0.0, 0.0, 0.0}, {length, 0.0, 0.0}, elements);
  mesh.points.emplace_back("wall", static_cast<int>(mesh.nodes.size()));
  mesh.nodes.emplace_back(0.0, 1.0, 0.0);
  folder.write("mesh.msh", mesh.text());
  folder.write("study.toml", steel_pipe("mesh.msh") + tube_between("tube") +
                                 "[[restraints]]\ngroup = \"wall\"\nfixed = \"all\"\n[transient]\nduration = "
                                 "0.1\n[output]\nreactions = [\"wall\"]\n");
  EXPECT_TRUE(says(folder.fretwork({"check", folder.path("study.toml").string()}).err,
                   "\"wall\" belongs to no structure that moves"));
}

} // namespace
} // namespace fretwork::app::test::forces_test
