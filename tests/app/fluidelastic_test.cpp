// SPDX-License-Identifier: GPL-3.0-or-later
// Stability diagrams of flows with a law by the program: reference values of pinned tubes, supports that are closed, ranges of laws.
#include "core/general_eigenvalues.hpp"
#include "mesh_text.hpp"
#include "program.hpp"
#include "study_text.hpp"
#include "tube_in_flow.hpp"
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace fretwork::app::test::fluidelastic_test {
namespace {

using namespace tube_in_flow;
using nlohmann::json;
constexpr double pi = std::numbers::pi;
constexpr double of_pins = 1e-8; // springs and elastic pins are the same rods, of another residual
std::string assessment(const std::string& keys) { return "[[stability]]\ndamping = 0.01\n" + keys; }
const std::string uniform = zone(0.0, 1.0, 2.0, 300.0, inside_of_light());

json law_of(const Workshop& folder, const std::string& study) {
  return summary_of(folder, study)["stability"][0]["law"];
}

/// Measured coefficients of a cell of tubes at the frequency under flow: Code_Aster's test SDLL117A with Euler's beam.
TEST(FluidelasticStability, OfATubeWhoseFrequencyUnderFlowIsPublished) {
  constexpr double frequency = 32.320739664, ratio = 8.947294371e-3, x = 1.5 / (frequency * outer);
  const std::string law =
      fmt::format("[flow_laws.cell]\nlaw = \"rational\"\nstiffness = {:.17g}\ndamping = {:.17g}\n",
                  88.73 - 637.1517 / x + 1398.2465 / (x * x) - 867.31 / (x * x * x),
                  -0.225 + 2.417 / x - 0.458 / (x * x));
  const Workshop folder;
  const json found = law_of(folder, tube(law + flow("cell", zone(0.0, 1.0, 1.5, 1000.0, 1000.0)) +
                                         "[[stability]]\ndamping = 0.03\nfactors = [0, 1.5]\npoints = 8\n"));
  const auto& factors = found["factors"];
  const auto at = static_cast<std::size_t>(std::find(factors.begin(), factors.end(), 1.0) - factors.begin());
  ASSERT_LT(at, factors.size()) << "the velocities given are always among the points";
  EXPECT_TRUE(close_to(found["modes"][0]["frequencies_hz"][0], 33.425241258, of_mesh));
  EXPECT_TRUE(close_to(found["modes"][0]["dampings"][0], 0.03, 1e-12));
  EXPECT_TRUE(close_to(found["modes"][0]["frequencies_hz"][at], frequency, of_mesh));
  EXPECT_TRUE(close_to(found["modes"][0]["dampings"][at], ratio, 10.0 * of_mesh)); // small difference of two
}

TEST(FluidelasticStability, OfATubeInFlowOverItsMiddleHalf) {
  const double in = inside_of_light();
  const Workshop folder;
  const std::string study =
      tube(s1 +
           flow("s1", zone(0.0, 0.25, 0.0, 300.0, in) + zone(0.25, 0.75, 2.0, 300.0, in) +
                          zone(0.75, 1.0, 0.0, 300.0, in)) +
           assessment("modes = 12\n"));
  const Outcome outcome = outcome_of(folder, study);
  const json summary = json::parse(bytes_of(folder.path("out") / "summary.json")),
             found = summary["stability"][0]["law"];
  EXPECT_TRUE(close_to(found["critical_velocity_m_s"], 3.3372217687, of_mesh));
  EXPECT_TRUE(close_to(found["critical_factor"], 3.3372217687 / 2.0, of_mesh));
  ASSERT_EQ(found["crossings"].size(), 1u);
  EXPECT_EQ(found["crossings"][0]["mode"], 1);
  EXPECT_EQ(found["crossings"][0]["becomes"], "unstable");
  EXPECT_EQ(found["modes"][0]["critical_factor"], found["critical_factor"]);
  EXPECT_TRUE(found["modes"][1]["critical_factor"].is_null());
  EXPECT_TRUE(close_to(found["modes"][0]["connors_factor"],
                       summary["stability"][0]["cases"][0]["critical_scale"], 1e-12));
  EXPECT_TRUE(says(outcome.out, "becomes UNSTABLE"));
  EXPECT_TRUE(says(outcome.out, "fluidelastic law, factors 0 to 2 of 2 m/s"));
  const std::string csv = bytes_of(folder.path("out") / "stability_diagram.csv");
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + 12 * 101); // 1 is among the 101
}

std::string middle(const std::string& keys) {
  return "[[contacts]]\ngroup = \"middle\"\nnormal_stiffness = 2e4\ngap = 1e-3\n" + keys;
}

/// A closed stop adds its stiffness: a spring in its place does the same.
TEST(FluidelasticStability, OfATubeWhoseElasticStopIsClosed) {
  const Workshop folder;
  const std::string in_flow = s1 + flow("s1", uniform), wide = "factors = [0, 8]\n",
                    across = middle("obstacle = \"plane_z\"\naxis = [1, 0, 0]\n");
  const auto critical = [&](const std::string& more) {
    return law_of(folder, tube(in_flow + more))["critical_velocity_m_s"].get<double>();
  };
  const double free = critical(assessment(wide)), rigid = critical(across + assessment(wide)),
               elastic = critical(across + assessment(wide + "elastic = true\n")),
               spring = critical("[[springs]]\ngroup = \"middle\"\nstiffness = [0, 0, 2e4, 0, 0, 0]\n" +
                                 assessment(wide));
  EXPECT_TRUE(close_to(free, 3.1792635889, of_mesh));
  EXPECT_GT(elastic, 1.2 * free);
  EXPECT_GT(rigid, 1.2 * elastic);
  EXPECT_TRUE(close_to(elastic, spring, of_pins));
}

/// A bar across the other direction holds this one by friction alone.
TEST(FluidelasticStability, OfATubeThatSticksToItsBar) {
  const Workshop folder;
  const std::string
      in_flow = s1 + flow("s1", uniform),
      wide = "factors = [0, 8]\n",
      bar = middle("obstacle = \"plane_y\"\naxis = [1, 0, 0]\nfriction = 0.3\ntangential_stiffness = 5e3\n");
  const auto critical = [&](const std::string& more) {
    return law_of(folder, tube(in_flow + more))["critical_velocity_m_s"].get<double>();
  };
  const double slips = critical(bar + assessment(wide + "elastic = true\n")),
               sticks = critical(bar + assessment(wide + "elastic = true\nsticking = true\n")),
               spring = critical("[[springs]]\ngroup = \"middle\"\nstiffness = [0, 0, 5e3, 0, 0, 0]\n" +
                                 assessment(wide));
  EXPECT_TRUE(close_to(slips, 3.1792635889, of_mesh));
  EXPECT_TRUE(close_to(sticks, spring, of_pins));
}

TEST(FluidelasticStability, WithoutEntriesIsOfTheFreeAndOfTheHeldTube) {
  const Workshop folder;
  const json found =
      summary_of(folder, tube(s1 + flow("s1", uniform) +
                              middle("obstacle = \"plane_z\"\naxis = [1, 0, 0]\n")))["stability"];
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0]["name"], "without contacts");
  EXPECT_EQ(found[1]["name"], "contacts closed");
  EXPECT_TRUE(found[1]["elastic"].get<bool>() && found[1]["sticking"].get<bool>());
  EXPECT_TRUE(found[0]["pinned"].empty());
}

TEST(FluidelasticStability, LeavesNoDiagramOfALawThatIsGone) {
  const Workshop folder;
  const std::string no_law = "[[flow]]\nname = \"T1\"\ngroup = \"tube\"\nfrom = \"tube_begin\"\n";
  (void)outcome_of(folder, tube(s1 + flow("s1", uniform) + assessment("")));
  EXPECT_TRUE(fs::exists(folder.path("out") / "stability_diagram.csv"));
  (void)outcome_of(folder, tube(no_law + uniform + assessment("")), "modes");
  EXPECT_TRUE(fs::exists(folder.path("out") / "stability_diagram.csv")) << "nothing was assessed";
  (void)outcome_of(folder, tube(no_law + uniform + assessment("")));
  EXPECT_TRUE(fs::exists(folder.path("out") / "stability.csv"));
  EXPECT_FALSE(fs::exists(folder.path("out") / "stability_diagram.csv"));
}

TEST(FluidelasticStability, WarnsOutsideTheRangeOfTheLaw) {
  const Workshop folder;
  const auto warnings = [&](const std::string& range, const std::string& command) {
    return summary_of(folder,
                      tube(s1 + range + flow("s1", zone(0.0, 1.0, 4.0, 300.0, inside_of_light())) +
                           (command == "run" ? "[transient]\nduration = 0.01\n" : assessment(""))),
                      command)["warnings"]
        .dump();
  };
  // V/(f D) is some 5 where the tube becomes unstable, some 6 at 4 m/s
  for (const std::string command : {"stability", "run"}) {
    for (const char* range : {"range = [0.5, 2.0]\n", "range = [20, 30]\n"})
      EXPECT_TRUE(says(warnings(range, command), "outside the law's range")) << command;
    EXPECT_FALSE(says(warnings("range = [0.5, 9.0]\n", command), "outside the law's range")) << command;
    EXPECT_TRUE(says(warnings("", command), "unstable")) << command;
    EXPECT_TRUE(says(warnings("", command), std::string("with the damping of the ") +
                                                (command == "run" ? "transient" : "assessment")));
  }
  EXPECT_TRUE(
      says(outcome_of(folder, tube(s1 + "range = [0.5, 2.0]\n" + flow("s1", uniform) + assessment(""))).out,
           "becomes UNSTABLE, outside the law's range"));
}

// A pinned tube past its threshold without any stop: nothing limits its motion.
TEST(Fluidelastic, WarnsOfAmplitudesThatALinearLawDoesNotHold) {
  const Workshop folder;
  const auto warnings = [&](double duration) {
    return summary_of(
               folder,
               tube(
                   s1 + flow("s1", zone(0.0, 1.0, 4.0, 300.0, inside_of_light())) +
                   "[[initial]]\ngroup = \"tube\"\nvelocity = [0, 0, 0.1]\n[output]\nnodes = [\"middle\"]\n" +
                   fmt::format("[transient]\nduration = {}\n", duration)),
               "run")["warnings"]
        .dump();
  };
  EXPECT_EQ(warnings(0.01).find("the fluidelastic law is linear"), std::string::npos);
  EXPECT_TRUE(says(warnings(2.0), "node \\\"middle\\\" moves by "));
  EXPECT_TRUE(says(warnings(2.0), "the fluidelastic law is linear, good to some 0.1 of it"));
}

/// Connors' threshold as a damping is that of the criterion; beside contacts a run warns that the law is frozen.
TEST(FluidelasticStability, OfADampingByConnorsIsThatOfTheCriterion) {
  const Workshop folder;
  const std::string connors = "[flow_laws.c]\nlaw = \"connors\"\nform = \"damping\"\nconstant = 3\n",
                    study = tube(connors + flow("c", uniform + "connors_constant = 3\n") + assessment(""));
  const json found = summary_of(folder, study)["stability"][0];
  // the criterion takes the decrement 2 pi zeta/(1 - zeta^2)^(1/2), zeta = 0.01
  const double criterion = found["cases"][0]["critical_scale"].get<double>() * std::pow(1.0 - 1e-4, 0.25);
  EXPECT_TRUE(close_to(found["law"]["critical_factor"], criterion, of_pins));
  const std::string transient = "[transient]\nduration = 0.001\n";
  const auto warnings = [&](const std::string& more) {
    return summary_of(folder, tube(connors + flow("c", uniform) + more + transient), "run")["warnings"]
        .dump();
  };
  EXPECT_TRUE(says(warnings(middle("obstacle = \"plane_z\"\naxis = [1, 0, 0]\n")), "the law is frozen"));
  EXPECT_EQ(warnings("").find("the law is frozen"), std::string::npos);
}

/// A damper couples modes: growth by the whole of its matrix, from closed forms of the shapes.
TEST(Fluidelastic, GrowthBesideADamperIsThatOfCoupledModes) {
  constexpr Eigen::Index n = 12;
  constexpr double v = 12.0, damper = 40.0, at = 0.4, mass = 1.0993164814; // m/s, N s/m, m, kg/m
  constexpr double of_meshes = 1e-5; // of shapes and frequencies of all modes
  const Workshop folder;
  MeshText text = straight_line("tube", {0, 0, 0}, {1, 0, 0}, 40);
  text.points.emplace_back("damped", 16);
  folder.write("mesh.msh", text.text());
  folder.write("study.toml", tube(s1 + flow("s1", zone(0.0, 1.0, v, 300.0, inside_of_light())) +
                                  "[[springs]]\ngroup = \"damped\"\ndamping = [0, 0, 40, 0, 0, 0]\n"
                                  "[transient]\nduration = 0.001\n"));
  const Outcome outcome =
      folder.fretwork({"run", folder.path("study.toml").string(), "-o", folder.path("out").string()});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const json summary = json::parse(bytes_of(folder.path("out") / "summary.json"));
  const double pressure = 150.0 * v * v / mass, rate = v / outer;
  Eigen::VectorXd w(n), shape(n);
  for (Eigen::Index k = 0; k < n; ++k) {
    w(k) = 2.0 * pi * 33.425241258 * static_cast<double>((k + 1) * (k + 1));
    shape(k) = std::sqrt(2.0 / mass) * std::sin(static_cast<double>(k + 1) * pi * at);
  }
  const auto growth = [&](const Eigen::MatrixXd& of_damper) {
    const Eigen::MatrixXd one = Eigen::MatrixXd::Identity(n, n);
    Eigen::MatrixXd a = Eigen::MatrixXd::Zero(3 * n, 3 * n);
    a.block(0, n, n, n) = a.block(2 * n, n, n, n) = one;
    a.block(n, 0, n, n) = -4.0 * pressure * one - Eigen::MatrixXd(w.cwiseAbs2().asDiagonal());
    a.block(n, n, n, n) = -0.4 * pressure / rate * one - 0.02 * Eigen::MatrixXd(w.asDiagonal()) - of_damper;
    a.block(n, 2 * n, n, n) = 4.0 * pressure * one;
    a.block(2 * n, 2 * n, n, n) = -0.4 * rate * one;
    return core::general_eigenvalues(a).real().maxCoeff();
  };
  const Eigen::MatrixXd whole = damper * shape * shape.transpose();
  const double expected = growth(whole), by_diagonal = growth(whole.diagonal().asDiagonal());
  EXPECT_GT(expected, 0.0);
  EXPECT_GT(std::abs(by_diagonal / expected - 1.0), 50.0 * of_meshes);
  EXPECT_TRUE(close_to(summary["fluidelastic"][0]["growth_per_s"], expected, of_meshes));
}

/// Two pinned tubes side by side that move along lift alone. @param laws  [flow_laws.one] and [flow_laws.other]   @param other_first  its flow
std::string two_tubes(const std::string& laws, const std::string& of_first, const std::string& of_second,
                      const std::string& more, bool other_first = false) {
  std::string text = steel_pipe("mesh.msh", metal) + "[modes]\ncount = 4\ndamping = 0.01\n" + laws;
  for (const char* group : {"tube", "other"})
    text += pinned(group);
  std::array flows{std::pair("tube", of_first), std::pair("other", of_second)};
  if (other_first)
    std::swap(flows[0], flows[1]);
  for (const auto& [group, law] : flows)
    text += fmt::format("[[flow]]\ngroup = \"{0}\"\nfrom = \"{0}_begin\"\nlaw = \"{1}\"\n", group, law) +
            zone(0.0, 1.0, 4.0, 300.0, inside_of_light());
  return text + more;
}
Outcome outcome_of_two(const Workshop& folder, const std::string& study, const std::string& command) {
  MeshText mesh = together(straight_line("tube", {0, 0, 0}, {1, 0, 0}, 40),
                           straight_line("other", {0, 0.03, 0}, {1, 0.03, 0}, 25));
  mesh.points.emplace_back("middle", 20);
  mesh.points.emplace_back("of_other", 41 + 12);
  return outcome_on(mesh, folder, study, command);
}

/// Neighbours that push each other by kappa = 8 pi/K^2: V_c/(f D) = K sqrt(m delta/(rho D^2)), of tubes in uniform flow too.
TEST(FluidelasticStability, OfTwoTubesThatTheirLawCouples) {
  constexpr double mass = 1.0993164814, frequency = 33.425241258, ratio = 0.01, density = 300.0, k = 3.0;
  const double closed =
      k * frequency * outer * std::sqrt(mass * 2.0 * pi * ratio / (density * outer * outer));
  const std::string kappa = fmt::format("{:.17g}", 8.0 * pi / (k * k));
  for (const bool other_first : {false, true}) {
    SCOPED_TRACE(other_first);
    const Workshop folder;
    const Outcome outcome = outcome_of_two(
        folder,
        two_tubes("[flow_laws.row]\nlaw = \"rational\"\ndamping = 0\nstiffness = [[0, 0, 0, 0], [0, 0, 0, " +
                      kappa + "], [0, 0, 0, 0], [0, -" + kappa + ", 0, 0]]\n",
                  "row", "row", assessment("modes = 2\n"), other_first),
        "stability");
    const json found = json::parse(bytes_of(folder.path("out") / "summary.json"))["stability"];
    ASSERT_EQ(found.size(), 2u);
    EXPECT_FALSE(found[1].contains("law")) << "the diagram is of both tubes, with the first";
    const json law = found[0]["law"];
    // frequencies of 40 and 25 elements differ by 1e-6
    EXPECT_TRUE(close_to(law["critical_velocity_m_s"], closed, 1e-6));
    EXPECT_EQ(law["tubes"], json::parse(other_first ? R"(["other", "tube"])" : R"(["tube", "other"])"));
    ASSERT_EQ(law["modes"].size(), 4u);
    for (const std::size_t mode : {0u, 2u}) {
      EXPECT_EQ(law["modes"][mode]["tube"], mode == 0 ? "tube" : "other") << "in the order of structures";
      EXPECT_EQ(law["modes"][mode]["mode"], 1);
    }
    EXPECT_TRUE(says(outcome.out, "fluidelastic law of 2 tubes, factors 0 to 2 of 4 m/s"));
    EXPECT_TRUE(says(outcome.out, "other:2"));
  }
}

/// Two tubes, the first of which is moved: standard deviations of both.
std::array<double, 2> motion_of_two(const std::string& laws, const std::string& of_first,
                                    const std::string& of_second, const std::string& scheme) {
  const Workshop folder;
  (void)outcome_of_two(folder,
                       two_tubes(laws, of_first, of_second,
                                 "[[initial]]\ngroup = \"tube\"\nvelocity = [0, 0, 0.01]\n"
                                 "[output]\nnodes = [\"middle\", \"of_other\"]\n"
                                 "[transient]\nduration = 0.5\nstep = 2e-4\n" +
                                     scheme),
                       "run");
  const json nodes = json::parse(bytes_of(folder.path("out") / "summary.json"))["nodes"];
  return {nodes[0]["displacement"]["z"]["std"], nodes[1]["displacement"]["z"]["std"]};
}

TEST(Fluidelastic, TubesThatALawDoesNotCoupleMoveAsWithLawsOfTheirOwn) {
  constexpr double round_off = 1e-9;
  const std::string of_each = "[flow_laws.row]\nlaw = \"rational\"\nstiffness = [[0, 0, 0, 0], [0, -4, 0, "
                              "0], [0, 0, 0, 0], [0, 0, 0, "
                              "-4]]\ndamping = -0.4\nlags = [0.4]\nlag_forces = [4]\n";
  const auto [first, second] = motion_of_two(s1, "s1", "s1", "");
  const auto [coupled, still] = motion_of_two(of_each, "row", "row", "");
  EXPECT_GT(first, 1e-5);
  EXPECT_TRUE(close_to(coupled, first, round_off));
  EXPECT_EQ(second, 0.0);
  EXPECT_EQ(still, 0.0);
}

/// The tube at rest is moved by its neighbour, as the reference scheme has it.
TEST(Fluidelastic, TubesThatALawCouplesMoveEachOther) {
  constexpr double of_outputs = 1e-4; // the reference integrates the mean square over its own steps
  const std::string row = "[flow_laws.row]\nlaw = \"rational\"\nstiffness = [[0, 0, 0, 0], [0, -4, 0, 2], "
                          "[0, 0, 0, 0], [0, 1, 0, "
                          "-4]]\ndamping = -0.4\nlags = [0.4]\n"
                          "lag_forces = [[[0, 0, 0, 0], [0, 4, 0, 1], [0, 0, 0, 0], [0, 0, 0, 4]]]\n";
  const auto [first, second] = motion_of_two(row, "row", "row", "");
  const auto [of_first, of_second] = motion_of_two(row, "row", "row", "scheme = \"runge_kutta_54\"\n");
  EXPECT_GT(second, 0.1 * first);
  EXPECT_TRUE(close_to(first, of_first, of_outputs));
  EXPECT_TRUE(close_to(second, of_second, of_outputs));
}

TEST(FluidelasticStability, OfMoreUnknownsThanCanBeFollowedIsRefused) {
  const Workshop folder;
  folder.write("mesh.msh", straight_line("tube", {0, 0, 0}, {1, 0, 0}, 40).text());
  std::string lags, forces;
  for (int i = 1; i <= 60; ++i) {
    lags += fmt::format("{}, ", 0.1 * i);
    forces += "1, ";
  }
  const Outcome outcome = folder.fretwork(
      {"stability",
       folder
           .write("study.toml",
                  tube("[flow_laws.many]\nlaw = \"rational\"\nstiffness = -4\ndamping = -0.4\nlags = [" +
                       lags + "]\nlag_forces = [" + forces + "]\n" +
                       flow("many", zone(0.0, 1.0, 40.0, 300.0, 0.0)) + assessment("modes = 12\n")))
           .string()});
  EXPECT_EQ(outcome.status, 1);
  EXPECT_TRUE(
      says(outcome.err, "744 unknowns of modes and lags, more than 600; give a smaller modes (now 12)"));
}

} // namespace
} // namespace fretwork::app::test::fluidelastic_test
