// SPDX-License-Identifier: GPL-3.0-or-later
// Fluid-elastic stability: closed forms, modes pinned at supports, what scripts and terminals get.
#include "study_text.hpp"
#include "tube_in_water.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace fretwork::app::test::stability_test {
namespace {

using namespace tube_in_water;
using nlohmann::json;

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
    return summary_of(folder,
                      tube(in_two_planes, modes(4) + flow() + "[[stability]]\n" +
                                              contact("third", "obstacle = \"circle\"\n" + keys)))["notes"]
        .dump();
  };
  EXPECT_TRUE(
      says(notes(""), "flow \\\"T1\\\": 1 of 1 supports have no length (\\\"third\\\"), and so no damping"));
  EXPECT_FALSE(says(notes("thickness = 0.02\n"), "have no length"));
}

TEST(Stability, ShowsTheModesNearestToInstability) {
  const Workshop folder;
  const Outcome outcome =
      outcome_of(folder, tube(in_two_planes, modes(30) + flow() + "[[stability]]\ndamping = 0.02\n"));
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_TRUE(says(outcome.out, "modes of case 1, the 20 nearest to instability"));
  EXPECT_TRUE(says(outcome.out, "... 10 more in stability.csv"));
}

TEST(Stability, IsAssessedOnModesPinnedAtTheSupports) {
  const Workshop folder;
  const std::string more = modes(4) + flow();
  const json held = summary_of(
      folder, tube(in_two_planes, more + "[[restraints]]\ngroup = \"third\"\nfixed = [\"uy\", \"uz\"]\n"));
  const std::string support = contact("third", "obstacle = \"circle\"\n");
  const json pinned = summary_of(folder, tube(in_two_planes, more + support));
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
  const json summary = summary_of(folder, tube(in_two_planes, more), "transient");
  const auto active = frequencies(summary["stability"][0]), named = frequencies(summary["stability"][1]),
             free = frequencies(summary["stability"][2]);
  EXPECT_EQ(active, free);
  EXPECT_GT(named[0], 2.0 * free[0]) << "an assessment may name it all the same";
  EXPECT_TRUE(summary["contacts"].empty()) << "nor is it in the transient";
}

/// Bars hold the tube across them alone, whatever their direction.
TEST(Stability, PinsAlongTheNormalOfBars) {
  const Workshop folder;
  const json held =
      summary_of(folder, tube(in_two_planes,
                              modes(4) + flow() + "[[restraints]]\ngroup = \"third\"\nfixed = [\"uy\"]\n"));
  const auto expected = frequencies(held["stability"][0]);
  for (const char* normal : {"[0, 1, 0]", "[0, 0, 1]", "[0, 3, 4]"}) {
    const json pinned = summary_of(
        folder, tube(in_two_planes,
                     modes(4) + flow() +
                         contact("third", fmt::format("obstacle = \"plane_y\"\ny_axis = {}\n", normal))));
    const auto found = frequencies(pinned["stability"][0]);
    for (std::size_t i = 0; i < expected.size(); ++i)
      EXPECT_TRUE(close_to(found[i], expected[i], of_pins)) << normal << i;
  }
}

TEST(Stability, MarksModesThatTheFlowDoesNotMove) {
  const Workshop folder;
  const Outcome outcome =
      folder.fretwork({"stability", example("tube_in_flow").string(), "-o", folder.path("out").string()});
  EXPECT_TRUE(
      says(outcome.out, " 1034            -          -          -         -          -  not in the flow"));
}

TEST(Stability, GivesTheSameBytesOnTwoRanks) {
  const Workshop folder;
  const std::string study =
      tube(in_two_planes, modes(4) + flow() + contact("third", "obstacle = \"circle\"\n"));
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

// The damping of the transient has no least value.
TEST(Stability, NotesLimitsAsThoseOfItsOwnSet) {
  const Workshop folder;
  EXPECT_TRUE(says(summary_of(folder, tube(in_one_plane, modes(2) + flow()))["notes"].dump(),
                   "damping of the stability set, "));
}

TEST(Stability, SaysThatAxialFlowIsNotAssessed) {
  const Workshop folder;
  const std::string study = tube(in_two_planes, modes(4) + flow({}, "velocity = [5.0, 0.0, 0.0]\n"));
  const Outcome outcome = outcome_of(folder, study);
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_TRUE(says(outcome.out, "1   not assessed: no mode moves in a velocity across the tube"));
  EXPECT_FALSE(says(outcome.out, "V/Vc 0.0000"));
  EXPECT_FALSE(says(outcome.out, "1.0000"));
  const std::string notes = summary_of(folder, study)["notes"].dump();
  EXPECT_TRUE(says(notes, "not assessed, because no mode moves in a velocity across the tube "
                          "(Connors' criterion is not one of axial flow)"));
  EXPECT_FALSE(says(notes, "V/Vc = 0"));
  const std::string two =
      "[[stability]]\nname = \"damped\"\ndamping = 0.04\n[[stability]]\nname = \"film\"\n";
  const Outcome both = outcome_of(folder, study + two);
  EXPECT_EQ(both.status, 0) << both.err;
  for (const char* name : {"damped, T1", "film, T1"}) {
    const std::size_t row = both.out.find(name);
    ASSERT_NE(row, std::string::npos) << both.out;
    EXPECT_TRUE(says(both.out.substr(row, both.out.find('\n', row) - row), "not assessed")) << name;
  }
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
  const Outcome outcome =
      outcome_of(folder, tube(in_two_planes, "[modes]\nup_to_hz = 60\n" + flow() +
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
      {tube(in_two_planes, ""), "the study has no [[flow]] to be stable in"},
      {tube(in_two_planes, flow() + two_nodes + "[[stability]]\npinned = [\"pair\"]\n"),
       "contact \"pair\" is between two nodes that move and pins nothing; leave it out of pinned"},
      {tube(in_two_planes,
            flow("supports = [{ group = \"tube_end\", length = 0.1 }, { group = \"lone\", length = 1 }]\n")),
       "lone"},
      {tube(in_two_planes, flow({}, "velocity = 1\nphase = \"gas\"\n")),
       "damping ratio = 0; stability needs a ratio above 0 and below 1 (a ratio may be given by "
       "[[stability]] damping)"},
      {tube(in_two_planes, flow({}, "velocity = 1\nphase = \"gas\"\n") + "[[stability]]\ndamping = 0.01\n"),
       "give its connors_constant (K)"}};
  for (const auto& [study, expected] : cases) {
    const Outcome outcome = outcome_of(folder, study);
    EXPECT_EQ(outcome.status, 1);
    EXPECT_TRUE(says(outcome.err, expected));
  }
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
