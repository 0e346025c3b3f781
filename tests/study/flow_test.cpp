// SPDX-License-Identifier: GPL-3.0-or-later
// [[flow]] and [[stability]] as values, and every message about them.
#include "folder.hpp"
#include <gtest/gtest.h>

namespace fretwork::study::flow_test {
namespace {

/// A flow with one zone. @param zone, flow  further lines of the zone and before it
std::string study_with(const std::string& zone, const std::string& flow = {}) {
  return "[mesh]\nfile = \"a.msh\"\n[[flow]]\ngroup = \"tube\"\nfrom = \"foot\"\n" + flow +
         "[[flow.zones]]\nname = \"water\"\n" + zone;
}
const std::string water = "density = 740\nviscosity = 1.23e-7\n";
const std::string steam = "phase = \"two_phase\"\nliquid = { density = 740, viscosity = 1.23e-7 }\n"
                          "gas = { density = 36.5, viscosity = 5.2e-7 }\n";

const flow::Zone& zone_of(const Study& study) { return study.flows.at(0).zones.at(0); }
using Rows = std::vector<double>;

TEST(FlowKeys, HaveTheirDefaults) {
  const Study study = read_text(study_with(water));
  const Flow& flow = study.flows.at(0);
  EXPECT_EQ(flow.name, "tube");
  EXPECT_EQ(flow.groups, std::vector<std::string>{"tube"});
  EXPECT_EQ(flow.from, "foot");
  EXPECT_EQ(flow.structural_damping, 0.002);
  EXPECT_EQ(flow.void_fraction, flow::DampingVoidFraction::of_the_zone);
  EXPECT_FALSE(flow.supports);
  const flow::Zone& zone = zone_of(study);
  EXPECT_EQ(zone.from, 0.0);
  EXPECT_EQ(zone.to, end_of_tube);
  EXPECT_EQ(std::get<flow::ScalarVelocity>(zone.velocity).speed.values, Rows{0.0});
  const auto& fluid = std::get<flow::SinglePhase>(zone.fluid);
  EXPECT_EQ(fluid.phase, flow::Phase::liquid);
  EXPECT_EQ(fluid.density.values, Rows{740.0});
  EXPECT_EQ(fluid.viscosity, 1.23e-7);
  EXPECT_EQ(zone.inner_density.values, Rows{0.0});
  EXPECT_EQ(zone.bundle, flow::Bundle{});
  EXPECT_TRUE(zone.connors_constants.empty());
}

TEST(FlowKeys, AreReadWithTheirValues) {
  const Study study = read_text(study_with(
      "from = 0.1\nto = 0.9\nvelocity = [[0.1, 1], [0.9, 2]]\ndirection = [0, 0, 2]\nfluid_inside = 700\n"
      "arrangement = \"rotated_square\"\npitch = 0.0274\nconnors_constant = [2.8, 4]\nquality = 0.2\n"
      "mass_flux = 400\nsurface_tension = 0.0176\n" +
          steam,
      "name = \"T1\"\nstructural_damping = 0.001\ndamping_void_fraction = \"homogeneous\"\n"
      "supports = [{ group = \"tsp1\", length = 0.03 }]\n"));
  const Flow& flow = study.flows.at(0);
  EXPECT_EQ(flow.name, "T1");
  EXPECT_EQ(flow.structural_damping, 0.001);
  EXPECT_EQ(flow.void_fraction, flow::DampingVoidFraction::homogeneous);
  ASSERT_EQ(flow.supports.value().size(), 1u);
  EXPECT_EQ(flow.supports->at(0).group, "tsp1");
  EXPECT_EQ(flow.supports->at(0).length, 0.03);
  const flow::Zone& zone = zone_of(study);
  const auto& velocity = std::get<flow::ScalarVelocity>(zone.velocity);
  EXPECT_EQ(velocity.speed.s, (Rows{0.1, 0.9}));
  EXPECT_EQ(velocity.speed.values, (Rows{1.0, 2.0}));
  EXPECT_EQ(velocity.direction, Vec3(0, 0, 2));
  EXPECT_EQ(zone.bundle, (flow::Bundle{flow::Arrangement::rotated_square, 0.0274}));
  EXPECT_EQ(zone.connors_constants, (Rows{2.8, 4.0}));
  const auto& fluid = std::get<flow::TwoPhase>(zone.fluid);
  EXPECT_EQ(fluid.phases.liquid_density, 740.0);
  EXPECT_EQ(fluid.phases.gas_viscosity, 5.2e-7);
  EXPECT_EQ(fluid.phases.surface_tension, 0.0176);
  const auto& quality = std::get<flow::Quality>(fluid.content);
  EXPECT_EQ(quality.x.values, Rows{0.2});
  EXPECT_EQ(quality.mass_flux.value().values, Rows{400.0});
}

TEST(FlowKeys, TakeVelocitiesAsVectors) {
  const auto vectors = [](const std::string& velocity) {
    return std::get<flow::VectorVelocity>(
               zone_of(read_text(study_with("velocity = " + velocity + "\n" + water))).velocity)
        .velocity;
  };
  EXPECT_EQ(vectors("[0, 1, 2]").values, (std::vector<Vec3>{{0, 1, 2}}));
  const auto rows = vectors("[[0, 0, 1, 2], [3, 4, 5, 6]]");
  EXPECT_EQ(rows.s, (Rows{0.0, 3.0}));
  EXPECT_EQ(rows.values, (std::vector<Vec3>{{0, 1, 2}, {4, 5, 6}}));
}

TEST(FlowKeys, ReadOneFileForAllQuantities) {
  const Folder folder;
  folder.write("profile.csv", "# from a thermohydraulic code\ns,density,velocity_x,velocity_y,velocity_z\n"
                              "0,740,0,0,1\n2,700,0.5,0,2\n");
  folder.write("inside.csv", "0,750\n2,720\n");
  const auto file = folder.write(
      "study.toml", study_with("velocity = \"profile.csv\"\ndensity = \"profile.csv\"\nviscosity = 1e-7\n"
                               "fluid_inside = \"inside.csv\"\n"));
  const Study study = read(file);
  const flow::Zone& zone = zone_of(study);
  EXPECT_EQ(std::get<flow::VectorVelocity>(zone.velocity).velocity.values,
            (std::vector<Vec3>{{0, 0, 1}, {0.5, 0, 2}}));
  EXPECT_EQ(std::get<flow::SinglePhase>(zone.fluid).density.values, (Rows{740.0, 700.0}));
  EXPECT_EQ(zone.inner_density.values, (Rows{750.0, 720.0}));
  const std::string before = canonical_text(file, {}, {"flow"});
  EXPECT_NE(before.find("[0, 740]"), std::string::npos) << before;
  folder.write("inside.csv", "0,750\n2,721\n");
  EXPECT_NE(canonical_text(file, {}, {"flow"}), before) << "the rows of files are a part of what is hashed";
}

TEST(FlowKeys, CanBeOverridden) {
  const Study study = read_text(study_with("velocity = 1\n" + water), {"flow.tube.zones.water.velocity=2"});
  EXPECT_EQ(std::get<flow::ScalarVelocity>(zone_of(study).velocity).speed.values, Rows{2.0});
}

TEST(StabilityKeys, HaveDefaultsAndValues) {
  const std::string contacts =
      "[[contacts]]\ngroup = \"p\"\ngap = 0.1\nnormal_stiffness = 1e6\nactive = false\n";
  const Study study = read_text(study_with(water) + contacts +
                                "[[stability]]\n[[stability]]\nname = \"bar out\"\npinned = [\"p\"]\n"
                                "component = \"lift\"\nsweep = [1, 1.2]\ndamping = 0.01\nstrouhal = 0.2\n"
                                "[[stability]]\nname = \"x\"\npinned = \"none\"\ncomponent = [1, 0, 0]\n");
  EXPECT_FALSE(study.contacts.at(0).active);
  ASSERT_EQ(study.stabilities.size(), 3u);
  EXPECT_EQ(study.stabilities[0].name, "assessment 1");
  EXPECT_EQ(study.stabilities[0].pinned, Pinned::contacts);
  EXPECT_EQ(study.stabilities[0].sweep, (Rows{0.5, 1.0, 1.5, 2.0}));
  EXPECT_FALSE(study.stabilities[0].damping);
  EXPECT_EQ(study.stabilities[1].name, "bar out");
  EXPECT_EQ(study.stabilities[1].contacts, std::vector<std::string>{"p"});
  EXPECT_EQ(study.stabilities[1].component.kind, flow::Component::Kind::lift);
  EXPECT_EQ(study.stabilities[1].sweep, (Rows{1.0, 1.2}));
  EXPECT_EQ(study.stabilities[1].damping, 0.01);
  EXPECT_EQ(study.stabilities[1].strouhal, 0.2);
  EXPECT_EQ(study.stabilities[2].pinned, Pinned::none);
  EXPECT_FALSE(study.stabilities[0].elastic || study.stabilities[0].sticking);
  EXPECT_EQ(study.stabilities[2].component.axis, Vec3(1, 0, 0));
}

TEST(FlowKeys, DampingFollowsFromTheFlow) {
  EXPECT_TRUE(read_text(study_with(water) + "[modes]\ndamping = \"flow\"\n").modes.flow_damping);
  EXPECT_FALSE(read_text(study_with(water)).modes.flow_damping);
}

TEST(FlowKeys, DeclareZonesThatAreDry) {
  const Study study = read_text(
      study_with(water + "to = 0.6\n[[flow.zones]]\nphase = \"none\"\nfrom = 0.6\nto = 0.9\n[[flow.zones]]\n"
                         "name = \"top\"\nphase = \"none\"\nfrom = 0.9\n"));
  const Flow& flow = study.flows.at(0);
  EXPECT_EQ(flow.zones.size(), 1u);
  ASSERT_EQ(flow.dry.size(), 2u);
  EXPECT_EQ(flow.dry[0].name, "2");
  EXPECT_EQ(flow.dry[0].from, 0.6);
  EXPECT_EQ(flow.dry[0].to, 0.9);
  EXPECT_EQ(flow.dry[1].name, "top");
  EXPECT_EQ(flow.dry[1].to, end_of_tube);
}

TEST(FlowMessages, NameTheKeyAndTheCure) {
  const std::string at = "flow.tube.zones.water.",
                    bar = "[[contacts]]\ngroup = \"p\"\ngap = 0.1\nnormal_stiffness = 1e6\n";
  const std::pair<std::string, std::string> cases[] = {
      {study_with(water + "velocty = 1\n"), at + "velocty = 1: unknown key; did you mean \"velocity\"?"},
      {study_with(water + "velocity = -1\n"),
       at + "velocity = -1: a number >= 0 in m/s is expected; a direction"},
      {study_with(water + "velocity = [1, 2]\n"), at + "velocity = [1, 2]: an array of numbers (3 in m/s)"},
      {study_with(water + "velocity = [[0, 1], [1, 2, 3, 4]]\n"),
       at + "velocity[1] = [1, 2, 3, 4]: a row [s, value] or [s, x, y, z] is expected, all rows alike"},
      {study_with(water + "velocity = [[0, 1], [0, 2]]\n"), "row 2 is not beyond the one before"},
      {study_with(water + "velocity = [[0, -1], [1, 2]]\n"), at + "velocity[0] = -1: a number >= 0 in m/s"},
      {study_with(water + "velocity = [1, 0, 0]\ndirection = [1, 0, 0]\n"),
       at + "direction = [1, 0, 0]: the velocity is a vector, which has a direction; keep one"},
      {study_with("viscosity = 1e-7\n"), at + "density: this required key is missing; give a number, rows"},
      {study_with("viscosity = 1e-7\ndensity = [[0, 1, 2]]\n"),
       at + "density[0] = [0, 1, 2]: a row [s, value] is expected"},
      {study_with("viscosity = 1e-7\ndensity = true\n"),
       at + "density = true: a number > 0 in kg/m3 is expected, not true or false"},
      {study_with("density = 740\n"), at + "viscosity: this required key is missing"},
      {study_with(water + "quality = 0.1\n"), at + "quality = 0.1: belongs to phase = \"two_phase\""},
      {study_with(water + "phase = \"steam\"\n"), at + "phase = \"steam\": unknown; available"},
      {study_with(steam),
       "flow.tube.zones.water: void_fraction or quality says how much of the flow is gas; give one"},
      {study_with(steam + "quality = 0.1\nvoid_fraction = 0.5\n"), "give one of them"},
      {study_with(steam + "void_fraction = 1.5\n"),
       at + "void_fraction = 1.5: a share from 0 to 1 is expected"},
      {study_with(steam + "void_fraction = 0.5\nmass_flux = 1\n"), at + "mass_flux = 1: belongs to quality"},
      {study_with(steam + "quality = 0.5\nsurface_tension = 1\n"),
       at + "surface_tension = 1: belongs to mass_flux"},
      {study_with(steam + "quality = 2\n"), at + "quality = 2: a share from 0 to 1"},
      {study_with(steam + "quality = 0.5\nmass_flux = 400\n"),
       at + "surface_tension: this required key is missing"},
      {study_with(steam + "quality = 0.5\nmass_flux = 400\nsurface_tension = 0.02\n"),
       at + "mass_flux = 400: the void fraction that follows from it is that of a bundle"},
      {study_with(steam + "quality = 0.5\ndensity = 1\n"),
       at + "density = 1: two-phase flow has those of its phases"},
      {study_with("phase = \"two_phase\"\nvoid_fraction = 0.5\nliquid = { density = 1, viscosity = 1 }\n"),
       at + "gas: this required key is missing"},
      {study_with(
           "phase = \"two_phase\"\nvoid_fraction = 0.5\nliquid = { density = 1, viscosity = 1 }\ngas = { "
           "density = 2, viscosity = 1 }\n"),
       at + "liquid: its density is not above that of the gas"},
      {study_with(water + "from = 2\nto = 1\n"), at + "to = 1: a zone from 2"},
      {study_with("phase = \"none\"\nfrom = 2\nto = 1\n"), at + "to = 1: a zone from 2"},
      {study_with(water + "phase = \"none\"\n"),
       at + "density = 740: phase = \"none\" is a zone without fluid inside and outside; leave it out"},
      {study_with("phase = \"none\"\nfluid_inside = 700\n"), at + "fluid_inside = 700: phase = \"none\""},
      {study_with("phase = \"none\"\n"), "no zone has a fluid; give one a phase, or leave the [[flow]] out"},
      {study_with(water + "arrangement = \"square\"\n"), at + "pitch: this required key is missing"},
      {study_with(water + "pitch = 0.02\n"), at + "pitch = 0.02: a single tube has none"},
      {study_with(water + "connors_constant = 0\n"), at + "connors_constant = 0: a number > 0 is expected"},
      {study_with(water, "structural_damping = 1\n"),
       "flow.tube.structural_damping = 1: a ratio to critical below 1"},
      {study_with(water, "supports = [{ group = \"p\" }]\n"),
       "flow.tube.supports.p.length: this required key is missing"},
      {study_with(water, "group_ = 1\n"), "flow.tube.group_ = 1: unknown key; did you mean \"group\"?"},
      {"[mesh]\nfile = \"a\"\n[[flow]]\ngroup = \"tube\"\nfrom = \"foot\"\n",
       "flow.tube.zones: this required key is missing; give [[flow.zones]]"},
      {study_with(water) + "[[flow]]\ngroup = \"tube\"\nfrom = \"a\"\n[[flow.zones]]\n" + water,
       "a second flow called \"tube\""},
      {"[mesh]\nfile = \"a\"\n[[stability]]\n", "stability.0: there is no [[flow]] to be stable in"},
      {study_with(water) + "[[stability]]\npinned = [\"tsp\"]\n",
       "stability.0.pinned = \"tsp\": no contact is called so"},
      {study_with(water) + bar + "[[stability]]\npinned = [\"p[x]\"]\n",
       "stability.0.pinned = \"p[x]\": no contact is called so; existing: \"p\""},
      {study_with(water) + bar + "inactive = [\"q[0]\"]\n",
       "contacts.p.inactive = \"q[0]\": no support of this contact; they are called \"p[0]\" ..."},
      {study_with(water) + bar + "inactive = [\"p\"]\n", "active = false is for all"},
      {study_with(water) + bar + "inactive = [\"p[0]\"]\nactive = false\n",
       "contacts.p.inactive = [\"p[0]\"]: with active = false"},
      {study_with(water) + "[[stability]]\npinned = \"all\"\n",
       "stability.0.pinned = \"all\": unknown; available"},
      {study_with(water) + "[[stability]]\nsweep = [-1]\n", "stability.0.sweep[0] = -1: a number >= 0"},
      {study_with(water) + "[[stability]]\ndamping = 1\n",
       "stability.0.damping = 1: a ratio to critical below 1"},
      {study_with(water) + "[[stability]]\nstrouhal = 0\n", "stability.0.strouhal = 0: a number > 0"},
      {study_with(water) + "[[stability]]\ncomponent = [0, 0, 0]\n", "a zero vector has no direction"},
      {study_with(water) + "[[stability]]\nelastic = 1\n", "stability.0.elastic"},
      {study_with(water) + "[[stability]]\nmodes = 4\n",
       "stability.0.modes = 4: it is of the stability diagram of a [[flow]] with a law, and none has one"},
      {study_with(water) + "[[stability]]\nname = \"a\"\n[[stability]]\nname = \"a\"\n",
       "a second assessment called \"a\""},
      {"[mesh]\nfile = \"a\"\n[modes]\ndamping = \"flow\"\n",
       "modes.damping = \"flow\": there is no [[flow]] that it would follow from"},
      {study_with(water) + "[modes]\ndamping = \"flo\"\n",
       "modes.damping = \"flo\": unknown; did you mean \"flow\"?"}};
  for (const auto& [text, expected] : cases)
    EXPECT_NE(message_of(text).find(expected), std::string::npos) << expected << "\n" << message_of(text);
}

TEST(FlowMessages, NameFilesAndTheirLines) {
  const std::pair<std::string, std::string> cases[] = {
      {"s,rho\n0,1\n", "its header has no column \"density\""},
      {"x,density\n0,1\n", "its header has no column \"s\""},
      {"0,1,2\n", "it has 3 columns and no header; give a header with s and density"},
      {"0,1\n1\n", "p.csv:2: \"1\": 1 numbers, the others have 2; give every row as many"},
      {"s,density\n0,a\n", "p.csv:2: \"0,a\": a row of finite numbers is expected"},
      {"s,density\n", "p.csv has no row"},
      {"0,0\n", "density[0] = 0: a number > 0 in kg/m3 is expected"},
      {"1,1\n0,1\n", "row 2 is not beyond the one before"}};
  for (const auto& [text, expected] : cases) {
    const Folder folder;
    folder.write("p.csv", text);
    const auto file = folder.write("study.toml", study_with("viscosity = 1e-7\ndensity = \"p.csv\"\n"));
    try {
      (void)read(file);
      ADD_FAILURE() << text << " is accepted";
    } catch (const core::Error& error) {
      EXPECT_NE(std::string(error.what()).find(expected), std::string::npos) << error.what();
    }
  }
  EXPECT_NE(
      message_of(study_with("viscosity = 1e-7\ndensity = \"none.csv\"\n")).find("none.csv does not exist"),
      std::string::npos);
}

} // namespace
} // namespace fretwork::study::flow_test
