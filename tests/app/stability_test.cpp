// SPDX-License-Identifier: GPL-3.0-or-later
// Damping by the flow and fluid-elastic stability: closed forms, modes pinned at supports, what scripts and terminals get.
#include "mesh_text.hpp"
#include "program.hpp"
#include "study_text.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace fretwork::app::test::stability_test {
namespace {

using nlohmann::json;
constexpr double pi = std::numbers::pi, outer = 0.01905, bore = outer - 2.0 * 0.00109, density = 740.0,
                 viscosity = 1.23e-7, pitch_ratio = 1.44, velocity = 1.5;
constexpr double of_mesh =
    1e-7; // (pi/40)^4/1440 of the first frequency, and the digits of a residual of 1e-8
constexpr double of_pins = 1e-6; // a rod of 1000 times the stiffness of the beams: pinned_model.hpp
const double bore_area = pi / 4.0 * bore * bore, displaced = pi / 4.0 * outer * outer,
             bending = 2.0e11 * pi / 64.0 * (std::pow(outer, 4) - std::pow(bore, 4)),
             ratio = (1.07 + 0.56 * pitch_ratio) * pitch_ratio, // De/D of squares
    mass = 8000.0 * (displaced - bore_area) + 700.0 * bore_area +
           (ratio * ratio + 1.0) / (ratio * ratio - 1.0) * density * displaced;

/// A pinned tube of 1 m along x, 40 elements, in uniform flow. @param held  components restrained all along it
std::string tube(const std::string& held, const std::string& more) {
  return steel_pipe("mesh.msh") + "[[beams]]\ngroup = \"tube\"\nmaterial = \"steel\"\nsection = \"tube\"\n" +
         fmt::format(R"([[restraints]]
group = "tube"
fixed = {}
[[restraints]]
group = "tube_begin"
fixed = ["uy", "uz"]
[[restraints]]
group = "tube_end"
fixed = ["uy", "uz"]
)",
                     held) +
         more;
}
const std::string in_one_plane = R"(["ux", "uy", "rx", "rz"])", across = R"(["ux", "rx"])";
/// @param more  keys before the zones
std::string flow(const std::string& more = {}, const std::string& zone = "velocity = 1.5\n") {
  return "[[flow]]\nname = \"T1\"\ngroup = \"tube\"\nfrom = \"tube_begin\"\n" + more +
         "[[flow.zones]]\nname = \"water\"\ndensity = 740.0\nviscosity = 1.23e-7\nfluid_inside = 700.0\n"
         "arrangement = \"square\"\npitch = 0.027432\n" +
         zone;
}
std::string contact(const std::string& name, const std::string& keys) {
  return fmt::format("[[contacts]]\ngroup = \"{}\"\nnormal_stiffness = 1e6\ngap = 1e-3\n{}", name, keys);
}
std::string modes(int count, const std::string& more = {}) {
  return fmt::format("[modes]\ncount = {}\n{}", count, more);
}

MeshText mesh() {
  MeshText text = straight_line("tube", {0, 0, 0}, {1, 0, 0}, 40);
  text.points.emplace_back("middle", 20);
  text.points.emplace_back("third", 14);
  return text;
}

Outcome outcome_of(const Workshop& folder, const std::string& study, const std::string& command = "stability",
                   const std::vector<std::string>& more = {}, int ranks = 0) {
  folder.write("mesh.msh", mesh().text());
  folder.write("study.toml", study);
  std::vector<std::string> arguments{command, folder.path("study.toml").string(), "-o",
                                     folder.path("out").string(), "--force"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return folder.fretwork(arguments, ranks);
}

json summary_of(const Workshop& folder, const std::string& study, const std::string& command = "stability",
                const std::vector<std::string>& more = {}) {
  const Outcome outcome = outcome_of(folder, study, command, more);
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  return json::parse(bytes_of(folder.path("out") / "summary.json"));
}

std::vector<double> frequencies(const json& assessment) {
  std::vector<double> out;
  for (const json& mode : assessment["modes"])
    out.push_back(mode["frequency_hz"]);
  return out;
}

double viscous_ratio(double hertz) {
  const double confinement = (1.0 + std::pow(ratio, -3)) / std::pow(1.0 - std::pow(ratio, -2), 2);
  return pi / std::sqrt(8.0) * density * outer * outer / mass *
         std::sqrt(2.0 * viscosity / (pi * hertz * outer * outer)) * confinement;
}

TEST(Stability, OfUniformFlowHasTheClosedForm) {
  const Workshop folder;
  const json summary = summary_of(
      folder, tube(in_one_plane, modes(3) + flow() + "[[stability]]\ndamping = 0.02\nsweep = [1, 2]\n"));
  const json& found = summary["stability"][0];
  const json& one = found["cases"][0];
  const double constant = 4.76 * (pitch_ratio - 1.0) + 0.76,
               decrement = 2.0 * pi * 0.02 / std::sqrt(1.0 - 4e-4);
  EXPECT_TRUE(close_to(one["connors_constants"]["water"], constant, 1e-12));
  const double f = pi / 2.0 * std::sqrt(bending / mass),
               critical = constant * f * outer * std::sqrt(mass * decrement / (density * outer * outer));
  EXPECT_TRUE(close_to(found["modes"][0]["frequency_hz"], f, of_mesh));
  EXPECT_TRUE(close_to(one["critical_velocities_m_s"][0], critical, of_mesh));
  EXPECT_TRUE(close_to(one["ratios"][0], velocity / critical, of_mesh));
  EXPECT_TRUE(close_to(one["critical_scale"], critical / velocity, of_mesh));
  EXPECT_TRUE(close_to(one["margin"], 1.0 - velocity / critical, 1e-6));
  EXPECT_EQ(one["critical_mode"], 1);
  EXPECT_EQ(one["sweep"][1]["factor"], 2.0);
  EXPECT_TRUE(close_to(one["sweep"][1]["largest_ratio"], 2.0 * velocity / critical, of_mesh));
}

TEST(Stability, TabulatesEveryCombinationOfConstants) {
  const Workshop folder;
  const std::string zones = flow({}, "velocity = 1.5\nto = 0.5\nconnors_constant = [2.4, 3.0]\n") +
                            "[[flow.zones]]\nname = \"rest\"\nfrom = 0.5\nvelocity = 1\ndensity = 740\n"
                            "viscosity = 1e-7\nconnors_constant = [3.0, 4.0]\n";
  const Outcome outcome = outcome_of(folder, tube(in_one_plane, modes(2) + zones));
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  for (const char* part : {"Stability \"all contacts pinned\" of tube \"T1\", nothing pinned",
                           "water 2.4, rest 3", "water 3, rest 4", "modes of case 1", "velocities times 0.5"})
    EXPECT_TRUE(says(outcome.out, part));
  const std::string csv = bytes_of(folder.path("out") / "stability.csv");
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + 4 * 2) << csv;
  EXPECT_TRUE(says(csv, "\"all contacts pinned\",\"T1\",4,\"water 3; rest 4\",2,"));
}

TEST(Stability, ListsTheAssessmentsByWhatIsNearestToInstability) {
  const Workshop folder;
  const std::string given = "[[stability]]\nname = \"damped\"\ndamping = 0.04\n";
  const std::string by_flow =
      "[[stability]]\nname = \"by flow\"\ndamping = 0.002\n[[stability]]\nname = \"film\"\n";
  const Outcome outcome = outcome_of(folder, tube(in_one_plane, modes(2) + flow() + given + by_flow));
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const std::string table = outcome.out.substr(0, outcome.out.find("Stability \"damped\""));
  EXPECT_TRUE(says(table, "the critical mode of each assessment and tube"));
  EXPECT_LT(table.find("by flow, T1"), table.find("damped, T1")) << table;
  const std::string details = outcome.out.substr(table.size());
  const std::size_t film = details.find("Stability \"film\"");
  EXPECT_FALSE(says(details.substr(0, film), "two-phase")); // of a ratio that is given
  EXPECT_TRUE(says(details.substr(film), "viscous two-phase  squeeze friction      gas"));
  const json summary = json::parse(bytes_of(folder.path("out") / "summary.json"));
  const double viscous = summary["stability"][2]["damping"]["modes"][0]["terms"]["viscous"];
  EXPECT_TRUE(says(bytes_of(folder.path("out") / "stability.csv"), fmt::format(",{},0,0,0,0\n", viscous)));
}

TEST(Stability, NotesSupportsWithoutLength) {
  const Workshop folder;
  const auto notes = [&](const std::string& keys) {
    return summary_of(folder, tube(across, modes(4) + flow() + "[[stability]]\n" +
                                               contact("third", "obstacle = \"circle\"\n" + keys)))["notes"]
        .dump();
  };
  EXPECT_TRUE(says(notes(""), "flow \\\"T1\\\": 1 of 1 supports have no length"));
  EXPECT_FALSE(says(notes("thickness = 0.02\n"), "have no length"));
}

TEST(Stability, ShowsTheModesNearestToInstability) {
  const Workshop folder;
  const Outcome outcome =
      outcome_of(folder, tube(across, modes(30) + flow() + "[[stability]]\ndamping = 0.02\n"));
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_TRUE(says(outcome.out, "modes of case 1, the 20 nearest to instability"));
  EXPECT_TRUE(says(outcome.out, "... 10 more in stability.csv"));
}

TEST(Stability, IsAssessedOnModesPinnedAtTheSupports) {
  const Workshop folder;
  const std::string more = modes(4) + flow();
  const json held = summary_of(
      folder, tube(across, more + "[[restraints]]\ngroup = \"third\"\nfixed = [\"uy\", \"uz\"]\n"));
  const std::string support = contact("third", "obstacle = \"circle\"\n");
  const json pinned = summary_of(folder, tube(across, more + support));
  EXPECT_EQ(pinned["stability"][0]["pinned"], json({"third"}));
  const auto expected = frequencies(held["stability"][0]), found = frequencies(pinned["stability"][0]);
  for (std::size_t i = 0; i < expected.size(); ++i)
    EXPECT_TRUE(close_to(found[i], expected[i], of_pins)) << i;
  EXPECT_LT(pinned["modes"]["frequencies_hz"][0].get<double>(), 0.5 * found[0])
      << "in the transient the tube hangs in its clearance";
}

TEST(Stability, LeavesOutContactsThatAreNotActive) {
  const Workshop folder;
  const std::string more =
      modes(2) + flow() + contact("third", "obstacle = \"circle\"\nactive = false\n") +
      "[[stability]]\n[[stability]]\nname = \"named\"\npinned = [\"third\"]\n"
      "[[stability]]\nname = \"free\"\npinned = \"none\"\n[transient]\nduration = 0.001\n";
  const json summary = summary_of(folder, tube(across, more), "transient");
  const auto active = frequencies(summary["stability"][0]), named = frequencies(summary["stability"][1]),
             free = frequencies(summary["stability"][2]);
  EXPECT_EQ(active, free);
  EXPECT_GT(named[0], 2.0 * free[0]) << "an assessment may name it all the same";
  EXPECT_TRUE(summary["contacts"].empty()) << "nor is it in the transient";
}

/// Bars hold the tube across them alone, whatever their direction.
TEST(Stability, PinsAlongTheNormalOfBars) {
  const Workshop folder;
  const json held = summary_of(
      folder, tube(across, modes(4) + flow() + "[[restraints]]\ngroup = \"third\"\nfixed = [\"uy\"]\n"));
  const auto expected = frequencies(held["stability"][0]);
  for (const char* normal : {"[0, 1, 0]", "[0, 0, 1]", "[0, 3, 4]"}) {
    const json pinned = summary_of(
        folder,
        tube(across, modes(4) + flow() +
                         contact("third", fmt::format("obstacle = \"plane_y\"\ny_axis = {}\n", normal))));
    const auto found = frequencies(pinned["stability"][0]);
    for (std::size_t i = 0; i < expected.size(); ++i)
      EXPECT_TRUE(close_to(found[i], expected[i], of_pins)) << normal << i;
  }
}

TEST(FlowDamping, OfATubeWithoutSupportsIsThatOfItsLiquid) {
  const Workshop folder;
  const json summary = summary_of(
      folder, tube(in_one_plane, modes(3, "damping = \"flow\"\n") + flow("structural_damping = 0.003\n")),
      "modes");
  for (std::size_t i = 0; i < 3; ++i) {
    const json& mode = summary["flow"][0]["modes"][i];
    const double viscous = viscous_ratio(mode["frequency_hz"]);
    EXPECT_TRUE(close_to(mode["terms"]["viscous"], viscous, 1e-10));
    EXPECT_TRUE(close_to(mode["transient"], 0.003 + viscous, 1e-10));
    EXPECT_EQ(mode["stability"], 0.006) << "the floor";
    EXPECT_EQ(mode["transient"], summary["modes"]["damping"][i]);
  }
  EXPECT_TRUE(says(summary["notes"].dump(), "raised to 0.6 %"));
}

TEST(FlowDamping, OfSupportsIsLeftToTheContacts) {
  const Workshop folder;
  const auto damping = [&](const std::string& flow_keys, const std::string& contacts) {
    return summary_of(folder,
                      tube(in_one_plane, modes(2, "damping = \"flow\"\n") + flow(flow_keys) + contacts),
                      "modes")["flow"][0]["modes"][0];
  };
  const std::string listed = "supports = [{ group = \"middle\", length = 0.03 }]\n",
                    bar = contact("middle", "obstacle = \"plane_z\"\naxis = [1, 0, 0]\nthickness = 0.03\n");
  const json rigid = damping(listed, ""), modelled = damping("", bar), both = damping(listed, bar);
  const double factor = 0.5 * std::sqrt(0.03 / 0.5), f = rigid["frequency_hz"],
               film = factor * 14.60 / f * density * outer * outer / mass;
  EXPECT_TRUE(close_to(rigid["terms"]["squeeze_film"], film, 1e-10));
  EXPECT_TRUE(close_to(rigid["terms"]["friction"], 0.005 * factor, 1e-10));
  EXPECT_EQ(rigid["left_to_contacts"]["friction"], 0.0);
  EXPECT_EQ(modelled, both) << "a contact has its thickness as length";
  EXPECT_EQ(modelled["stability"], rigid["stability"]);
  EXPECT_EQ(modelled["left_to_contacts"],
            modelled["terms"].get<json>().patch(R"([{"op":"replace","path":"/viscous","value":0.0}])"_json));
  EXPECT_TRUE(close_to(rigid["transient"].get<double>() - modelled["transient"].get<double>(),
                       film + 0.005 * factor, 1e-9));
  const json out_of_use = damping(listed, bar + "active = false\n");
  EXPECT_EQ(out_of_use["terms"]["friction"], 0.0) << "a support that does nothing damps nothing";
}

TEST(FlowDamping, IsPrintedByModes) {
  const Workshop folder;
  const Outcome outcome =
      outcome_of(folder, tube(in_one_plane, modes(2, "damping = \"flow\"\n") + flow()), "modes");
  for (const char* part : {"Damping of tube \"T1\" by its flow, %: 1 spans", "squeeze", "transient"})
    EXPECT_TRUE(says(outcome.out, part));
}

TEST(Stability, MarksModesThatTheFlowDoesNotMove) {
  const Workshop folder;
  const Outcome outcome =
      folder.fretwork({"stability", example("tube_in_flow").string(), "-o", folder.path("out").string()});
  EXPECT_TRUE(says(outcome.out, " 1034          -          -         -          -  not in the flow"));
}

TEST(Stability, GivesTheSameBytesOnTwoRanks) {
  const Workshop folder;
  const std::string study = tube(across, modes(4) + flow() + contact("third", "obstacle = \"circle\"\n"));
  ASSERT_EQ(outcome_of(folder, study).status, 0);
  const std::string one = bytes_of(folder.path("out") / "stability.csv");
  ASSERT_EQ(outcome_of(folder, study, "stability", {}, 2).status, 0);
  EXPECT_EQ(bytes_of(folder.path("out") / "stability.csv"), one);
}

TEST(Stability, WarnsOfATubeThatIsUnstable) {
  const Workshop folder;
  const auto warnings = [&](const std::string& speed) {
    return summary_of(folder,
                      tube(in_one_plane, modes(2) + flow({}, "velocity = " + speed + "\n")))["warnings"]
        .dump();
  };
  EXPECT_TRUE(
      says(warnings("20.0"), "fluid-elastically unstable, which no force of the transient stands for"));
  EXPECT_EQ(warnings("0.1"), "[]");
}

TEST(Stability, ScreensForVortexShedding) {
  const Workshop folder;
  const double f = pi / 2.0 * std::sqrt(bending / mass), coincident = f * outer / velocity;
  const auto warnings = [&](double strouhal) {
    return summary_of(folder, tube(in_one_plane,
                                   modes(1) + flow() +
                                       fmt::format("[[stability]]\nstrouhal = {}\n", strouhal)))["warnings"]
        .dump();
  };
  EXPECT_TRUE(says(warnings(1.1 * coincident), "vortices are shed at"));
  EXPECT_FALSE(says(warnings(1.3 * coincident), "vortices"));
}

TEST(Stability, SaysThatThereAreNoModes) {
  const Workshop folder;
  const Outcome outcome = outcome_of(folder, tube(across, "[modes]\nup_to_hz = 60\n" + flow() +
                                                              contact("third", "obstacle = \"circle\"\n")));
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_TRUE(says(outcome.out, "no modes up to the limit of [modes]"));
}

/// Two legs and a bend of arcs, in vertical flow: one tube of three curves, its abscissa from the hot foot.
TEST(Stability, OfAUBendFollowsTheLocalTangent) {
  constexpr double round_off = 1e-9;
  const Workshop folder;
  folder.write("tube.geo", bytes_of(example("u_bend").parent_path() / "tube.geo"));
  const auto beams = [](const char* group) {
    return fmt::format("[[beams]]\ngroup = \"{}\"\nmaterial = \"steel\"\nsection = \"tube\"\n", group);
  };
  std::string study = steel_pipe("tube.geo") + beams("hot_leg") + beams("bend") + beams("cold_leg") +
                      "[[restraints]]\ngroup = \"feet\"\nfixed = \"all\"\n" + modes(6);
  study.replace(study.find("tube.geo\""), 9, "tube.geo\"\norder = 2");
  for (int k = 1; k <= 9; ++k)
    study += contact(fmt::format("hot_tsp{}", k), "") + contact(fmt::format("cold_tsp{}", k), "");
  study += R"([[flow]]
name = "tube"
group = ["bend", "cold_leg", "hot_leg"]
from = "hot_leg"
[[flow.zones]]
density = 740.0
viscosity = 1.23e-7
velocity = [0, 0, 1.0]
connors_constant = 3.0
)";
  for (const char* component : {"\"normal\"", "\"drag\"", "\"lift\"", "[0, 1, 0]"})
    study += fmt::format("[[stability]]\ndamping = 0.01\ncomponent = {}\n", component);
  const json summary = summary_of(folder, study);
  const json& all = summary["stability"];
  EXPECT_TRUE(close_to(all[0]["damping"]["length_m"], 18.0 + pi, round_off));
  for (std::size_t i = 0; i < 6; ++i) {
    const auto ratio_of = [&](std::size_t a) { return all[a]["cases"][0]["ratios"][i].get<double>(); };
    EXPECT_NEAR(std::hypot(ratio_of(1), ratio_of(2)), ratio_of(0), round_off);
    EXPECT_NEAR(ratio_of(3), ratio_of(2), round_off) << "lift is across the plane of the bend";
  }
  EXPECT_GT(all[0]["cases"][0]["ratios"][0].get<double>(), 0.0);
}

TEST(Stability, RefusesWhatCannotBeAssessed) {
  const Workshop folder;
  const std::string two_nodes =
      "[[contacts]]\nname = \"pair\"\ngroup = \"third\"\nother = \"middle\"\n"
      "distance_1 = 0.01\ndistance_2 = 0.01\nnormal_stiffness = 1e6\naxis = [0, 1, 0]\n";
  const std::pair<std::string, std::string> cases[] = {
      {tube(across, ""), "the study has no [[flow]] to be stable in"},
      {tube(across, flow() + two_nodes + "[[stability]]\npinned = [\"pair\"]\n"),
       "contact \"pair\" is between two nodes that move and pins nothing; leave it out of pinned"},
      {tube(across,
            flow("supports = [{ group = \"tube_end\", length = 0.1 }, { group = \"lone\", length = 1 }]\n")),
       "lone"},
      {tube(across, flow({}, "velocity = 1\nphase = \"gas\"\n")),
       "damping ratio = 0; stability needs a ratio above 0 and below 1 (a ratio may be given by "
       "[[stability]] damping)"},
      {tube(across, flow({}, "velocity = 1\nphase = \"gas\"\n") + "[[stability]]\ndamping = 0.01\n"),
       "give its connors_constant (K)"}};
  for (const auto& [study, expected] : cases) {
    const Outcome outcome = outcome_of(folder, study);
    EXPECT_EQ(outcome.status, 1);
    EXPECT_TRUE(says(outcome.err, expected));
  }
}

TEST(FlowDamping, NeedsAFlowOnEveryStructure) {
  const Workshop folder;
  MeshText text = together(mesh(), straight_line("other", {0, 1, 0}, {1, 1, 0}, 10));
  folder.write("mesh.msh", text.text());
  folder.write("study.toml", tube(across, modes(2, "damping = \"flow\"\n") + flow() + tube_between("other")));
  const Outcome outcome =
      folder.fretwork({"modes", folder.path("study.toml").string(), "-o", folder.path("out").string()});
  EXPECT_EQ(outcome.status, 1);
  EXPECT_TRUE(says(outcome.err, "the structure that starts at node (0, 1, 0) has no [[flow]]"));
  folder.write("study.toml",
               tube(across, modes(2) + flow("supports = [{ group = \"other_begin\", length = 0.1 }]\n") +
                                tube_between("other")));
  EXPECT_TRUE(says(folder.fretwork({"stability", folder.path("study.toml").string()}).err,
                   "flow \"T1\": support \"other_begin\" has a node at (0, 1, 0) that is not on the tube"));
}

TEST(FlowDamping, MeetsTubesThatAreTiedTogetherByTheirShares) {
  const Workshop folder;
  MeshText text = together(mesh(), straight_line("other", {0, 1, 0}, {1, 1, 0}, 40));
  folder.write("mesh.msh", text.text());
  const std::string springs =
      "[[springs]]\ngroup = \"tube_begin\"\nother = \"other_begin\"\nstiffness = [1e-3, 0, 0, 0, 0, 0]\n";
  const std::string twin =
      "[[flow]]\ngroup = \"other\"\nfrom = \"other_begin\"\nstructural_damping = 0.01\n[[flow.zones]]\n"
      "density = 740.0\nviscosity = 1.23e-7\nfluid_inside = 700.0\n";
  folder.write("study.toml", tube(across, modes(8, "damping = \"flow\"\n") + flow() + twin + springs +
                                              tube_between("other")));
  const Outcome outcome =
      folder.fretwork({"modes", folder.path("study.toml").string(), "-o", folder.path("out").string()});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const json summary = json::parse(bytes_of(folder.path("out") / "summary.json"));
  int of_first = 0, of_second = 0;
  for (std::size_t i = 0; i < 8; ++i) {
    const json &one = summary["flow"][0]["modes"][i], &two = summary["flow"][1]["modes"][i];
    const double damping = summary["modes"]["damping"][i];
    if (one["assessed"] && !two["assessed"])
      of_first += damping == one["transient"].get<double>();
    if (two["assessed"] && !one["assessed"])
      of_second += damping == two["transient"].get<double>();
  }
  EXPECT_GE(of_first, 2);
  EXPECT_GE(of_second, 2);
}

TEST(Stability, SaysNothingOfCorrelationsWhereTheDampingIsGiven) {
  const Workshop folder;
  std::string viscous = flow();
  viscous.replace(viscous.find("1.23e-7"), 7, "1.23e-5");
  const auto notes = [&](const std::string& given) {
    return summary_of(folder, tube(in_one_plane, modes(1) + viscous + "[[stability]]\n" + given))["notes"]
        .dump();
  };
  EXPECT_TRUE(says(notes(""), "viscous damping is correlated"));
  EXPECT_EQ(notes("damping = 0.02\n").find("viscous damping is correlated"), std::string::npos);
}

} // namespace
} // namespace fretwork::app::test::stability_test
