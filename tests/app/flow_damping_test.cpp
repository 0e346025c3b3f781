// SPDX-License-Identifier: GPL-3.0-or-later
// Damping of the modes of a tube by its flow: closed forms, what is left to the contacts.
#include "study_text.hpp"
#include "tube_in_water.hpp"
#include <cmath>

namespace fretwork::app::test::flow_damping_test {
namespace {

using namespace tube_in_water;
using nlohmann::json;

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

TEST(FlowDamping, NeedsAFlowOnEveryStructure) {
  const Workshop folder;
  MeshText text = together(mesh(), straight_line("other", {0, 1, 0}, {1, 1, 0}, 10));
  folder.write("mesh.msh", text.text());
  folder.write("study.toml",
               tube(in_two_planes, modes(2, "damping = \"flow\"\n") + flow() + tube_between("other")));
  const Outcome outcome =
      folder.fretwork({"modes", folder.path("study.toml").string(), "-o", folder.path("out").string()});
  EXPECT_EQ(outcome.status, 1);
  EXPECT_TRUE(says(outcome.err, "the structure that starts at node (0, 1, 0) has no [[flow]]"));
  folder.write("study.toml",
               tube(in_two_planes, modes(2) +
                                       flow("supports = [{ group = \"other_begin\", length = 0.1 }]\n") +
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
  folder.write("study.toml", tube(in_two_planes, modes(8, "damping = \"flow\"\n") + flow() + twin + springs +
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

} // namespace
} // namespace fretwork::app::test::flow_damping_test
