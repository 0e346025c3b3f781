// SPDX-License-Identifier: GPL-3.0-or-later
// Values in other units than the SI's: one question for all of them, from check and from run.
#include "study_text.hpp"
#include "tubes.hpp"
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sstream>

namespace fretwork::app::test::unit_slips_test {
namespace {

std::string supports(const std::string& keys) {
  std::string text;
  for (int i = 0; i < 15; ++i)
    text +=
        fmt::format("[[contacts]]\nname = \"h{}\"\ngroup = \"mid0\"\nnormal_stiffness = 1.0e6\n{}", i, keys);
  return text;
}

/// The lines of `check` that ask about units.
std::vector<std::string> asked(const Workshop& folder, const std::string& study,
                               const std::vector<std::string>& set) {
  std::vector<std::string> arguments{"check", folder.write("study.toml", study).string()};
  for (const std::string& key : set) {
    arguments.emplace_back("--set");
    arguments.push_back(key);
  }
  const Outcome outcome = folder.fretwork(arguments);
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  std::vector<std::string> out;
  std::istringstream lines(outcome.out);
  for (std::string line; std::getline(lines, line);)
    if (line.find("units: ") != std::string::npos)
      out.push_back(line);
  return out;
}

/// Fluid round the tube of `tubes`. @param zone  its density and viscosity
std::string water(const std::string& zone) {
  return "[[flow]]\nname = \"w\"\ngroup = \"tube0\"\nfrom = \"tube0_begin\"\n[[flow.zones]]\n"
         "name = \"z\"\n" +
         zone;
}

} // namespace

TEST(UnitSlips, OfSizesAreOneQuestion) {
  const Workshop folder;
  const auto found = asked(folder, tubes(folder, 1) + supports("gap = 0.2\n"),
                           {"sections.tube.outer_diameter=19.05", "sections.tube.thickness=1.09"});
  ASSERT_EQ(found.size(), 1u);
  for (const char* part : {"sections.tube.outer_diameter = 19.05 m", "sections.tube.thickness = 1.09 m",
                           "gap = 0.2 m of contact \"h0\" ... \"h14\" (15)", "are these mm?"})
    EXPECT_TRUE(says(found[0], part));
}

// 0.05 mm about a tube of 19 mm.
TEST(UnitSlips, OfGapsAreAskedAboutFromTheSizeOfTheTubeOn) {
  const Workshop folder;
  const auto found = [&](const std::string& keys) {
    return fmt::format("{}", fmt::join(asked(folder, tubes(folder, 1) + supports(keys), {}), "; "));
  };
  EXPECT_TRUE(says(found("gap = 0.05\n"), "gap = 0.05 m of contact \"h0\" ... \"h14\" (15): are these mm?"));
  EXPECT_TRUE(says(found("obstacle = \"plane_y\"\ny_axis = [0, 0, 1]\ngap = 0.05\n"), "gap = 0.05 m"));
  EXPECT_EQ(found("obstacle = \"stop_y\"\ny_axis = [0, 0, 1]\ngap = 0.05\n"), ""); // far from the tube
  EXPECT_EQ(found("gap = 5e-4\n"), "");
}

TEST(UnitSlips, OfStiffnessesOfContactsAreAskedAbout) {
  const Workshop folder;
  const std::string study = tubes(folder, 1) + supports("gap = 2.0e-4\n");
  const auto found = asked(folder, study, {"contacts.h3.normal_stiffness=1000"});
  ASSERT_EQ(found.size(), 1u);
  EXPECT_TRUE(says(found[0], "normal_stiffness = 1000 N/m of contact \"h3\": are these N/mm?"));
}

TEST(UnitSlips, OfAccelerationsAreAskedAboutAndCheckSaysTheLargest) {
  const Workshop folder;
  const std::string study =
      tubes(folder, 1) +
      "[[base_motion]]\ndirection = [0.0, 1.0, 0.0]\ntable = [[0, 0], [0.01, 3], [0.02, 0]]\n";
  EXPECT_TRUE(asked(folder, study, {}).empty());
  const auto found = asked(folder, study, {"base_motion.0.scale=1000"});
  ASSERT_EQ(found.size(), 1u);
  EXPECT_TRUE(
      says(found[0],
           "acceleration of 3000 m/s2 in [[base_motion]] entry 1 (earthquakes: below 30): are these mm?"));
  const Outcome check = folder.fretwork({"check", folder.path("study.toml").string()});
  EXPECT_TRUE(says(check.out, "[[base_motion]] along (0, 1, 0): largest acceleration 3 m/s2 (0.306 g) at "
                              "0.01 s, largest displacement "));
}

TEST(UnitSlips, OfFrictionMaterialsAndStepAreAskedAbout) {
  const Workshop folder;
  const std::string study =
      tubes(folder, 1) + supports("gap = 2.0e-4\nfriction = 0.3\ntangential_stiffness = 1.0e6\n");
  EXPECT_TRUE(asked(folder, study, {}).empty());
  const auto friction = asked(folder, study, {"contacts.h3.friction=30"});
  ASSERT_EQ(friction.size(), 1u);
  EXPECT_TRUE(says(friction[0], "friction = 30 of contact \"h3\": is this per cent?"));
  const auto material =
      asked(folder, study, {"materials.steel.young_modulus=200e3", "materials.steel.density=8.0"});
  ASSERT_EQ(material.size(), 1u);
  EXPECT_TRUE(
      says(material[0], "young_modulus = 200000 Pa (steel: 2e11), materials.steel.density = 8 kg/m3"));
  const auto damping = asked(folder, study, {"modes.damping=0.5"});
  ASSERT_EQ(damping.size(), 1u);
  EXPECT_TRUE(says(damping[0], "modes.damping = 0.5: is this per cent?"));
  for (const auto& [given, question] :
       {std::pair("modes.damping=[2.0, 1.5]", "modes.damping = [2, ...]: is this per cent?"),
        std::pair("modes.damping={ table = [[1, 2.0], [1000, 1.0]] }",
                  "modes.damping table of 2 and more: is this per cent?")}) {
    const auto ratios = asked(folder, study, {given, "modes.count=2"});
    ASSERT_EQ(ratios.size(), 1u) << given;
    EXPECT_TRUE(says(ratios[0], question));
  }
  EXPECT_TRUE(asked(folder, study, {"modes.damping={ table = [[1, 0.02], [1000, 1.0]] }"}).empty());
  const auto length = asked(folder, study + "[[wear]]\ncoefficient = 1.0e-14\nlength = 30\n", {});
  ASSERT_EQ(length.size(), 1u);
  EXPECT_TRUE(says(length[0], "wear.0.length = 30 m: are these mm?"));
  const auto step = asked(folder, study, {"transient.duration=2", "transient.step=0.1"});
  ASSERT_EQ(step.size(), 1u);
  EXPECT_TRUE(
      says(step[0], "transient.step = 0.1 s is longer than the slowest vibration on a contact can be"));
}

// The ratio is the cause, the damper what follows from it.
TEST(UnitSlips, OfDampingComeBeforeTheAutomaticTangentialDamperThatTheySpoil) {
  const Workshop folder;
  const std::string study =
      tubes(folder, 1) + supports("gap = 2.0e-4\nfriction = 0.3\ntangential_stiffness = 1.0e4\n");
  folder.write("study.toml", study);
  const auto refused = [&](const std::string& damping) {
    const Outcome outcome =
        folder.fretwork({"check", folder.path("study.toml").string(), "--set", "modes.damping=" + damping});
    EXPECT_EQ(outcome.status, 1);
    return outcome.err;
  };
  const std::string percent = refused("5.0");
  EXPECT_TRUE(percent.starts_with("fretwork: units: modes.damping = 5: is this per cent?")) << percent;
  EXPECT_TRUE(says(percent, "modes.damping: the mode at "));
  const std::string rayleigh = refused("{ mass = 1e4 }"); // no per cent
  EXPECT_TRUE(rayleigh.starts_with("fretwork: modes.damping: the mode at ")) << rayleigh;
  EXPECT_TRUE(says(rayleigh, " and does not oscillate (0.02 is 2 % of critical damping); it moves contact "
                             "\"h0\" most, whose automatic "
                             "tangential damping would be -"));
  EXPECT_TRUE(says(rayleigh, "lower the ratio, or give tangential_damping a value"));
}

TEST(UnitSlips, OfWearWeightAndOffsetsAreAskedAbout) {
  const Workshop folder;
  const std::string study =
      tubes(folder, 1) + supports("gap = 2.0e-4\n") +
      "[[wear]]\ncoefficient = 1.0e-14\nlength = 0.03\n[gravity]\nacceleration = [0, 0, -9.81]\n";
  EXPECT_TRUE(asked(folder, study, {}).empty());
  const auto only = [&](const char* key) {
    const auto found = asked(folder, study, {key});
    return found.size() == 1 ? found[0] : "";
  };
  EXPECT_TRUE(says(only("wear.0.coefficient=1e-5"),
                   "wear.0.coefficient = 1e-05 m2/N: are these mm3/(N m), or without a unit?"));
  EXPECT_TRUE(says(only("wear.0.support_coefficient=1e-5"), "wear.0.support_coefficient = 1e-05 m2/N: "));
  EXPECT_TRUE(says(only("gravity.acceleration=[0, 0, -9810]"),
                   "gravity.acceleration of 9810 m/s2 (weight: 9.81): are these mm?"));
  EXPECT_TRUE(
      says(only("contacts.h3.offset=[0.3, 0]"), "offset = [0.3, 0] m of contact \"h3\": are these mm?"));
  EXPECT_TRUE(says(only("beams.0.added_mass=200"),
                   "added_mass = 200 kg/m of beams \"tube0\" (their material: 0.492 kg/m): are these g/m?"));
  EXPECT_TRUE(says(only("mesh.scale=500"), "a mesh 500 m long, of sections up to 0.01905 m (mesh.scale"));
}

// A tube in mm hardly resists its weight: no equilibrium of it is found.
TEST(UnitSlips, BeginTheMessageOfAComputationThatFails) {
  const Workshop folder;
  const Outcome outcome =
      folder.fretwork({"check", example("straight_tube").string(), "--set", "mesh.scale=1000", "--set",
                       "transient.start=static", "--set", "gravity.acceleration=[0,0,-9.81]"});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_TRUE(says(outcome.err, "no equilibrium found"));
  EXPECT_TRUE(says(outcome.err, "units: a mesh 9000 m long, of sections up to 0.01905 m (mesh.scale = 1e-3 "
                                "turns mm into m): are these mm?"));
  EXPECT_LT(outcome.err.find("are these mm?"), outcome.err.find("no equilibrium found"));
}

TEST(UnitSlips, AreSaidByTheRunToo) {
  const Workshop folder;
  const Results run = folder.run_text(
      tubes(folder, 1) + supports("gap = 2.0e-4\nfriction = 30\ntangential_stiffness = 1.0e6\n"));
  EXPECT_TRUE(
      says(run.summary["warnings"].dump(), "friction = 30 of contact \\\"h0\\\" ... \\\"h14\\\" (15)"));
}

TEST(UnitSlips, AreSaidOnceByCheckWhateverLimitsTheModes) {
  const Workshop folder;
  const std::string study =
      tubes(folder, 1) + supports("gap = 2.0e-4\nfriction = 30\ntangential_stiffness = 1.0e6\n");
  const auto count = study.find("count = ");
  ASSERT_NE(count, std::string::npos);
  std::string by_accuracy = study;
  by_accuracy.erase(count, study.find('\n', count) - count);
  EXPECT_EQ(asked(folder, by_accuracy, {}).size(), 1u); // told before its modes are computed
  EXPECT_EQ(asked(folder, study, {}).size(), 1u);
}

TEST(UnitSlips, OfLiquidsAreAskedAbout) {
  const Workshop folder;
  const std::string study = tubes(folder, 1);
  EXPECT_TRUE(asked(folder, study + water("density = 740.0\nviscosity = 1.2e-7\n"), {}).empty());
  const auto dynamic = asked(folder, study + water("density = 0.74\nviscosity = 9.0e-5\n"), {});
  ASSERT_EQ(dynamic.size(), 1u);
  EXPECT_TRUE(says(dynamic[0], "flow.w.zones.z.density = 0.74 kg/m3, flow.w.zones.z.viscosity = 9e-05 m2/s: "
                               "units are SI: kg/m3, and m2/s of the kinematic viscosity"));
  const std::string gas = "phase = \"gas\"\ndensity = 1.2\nviscosity = 5.0e-5\nconnors_constant = 3\n";
  EXPECT_TRUE(asked(folder, study + water(gas), {}).empty());
}

// The cause may be the unit: zones in m are off a tube in mm.
TEST(UnitSlips, EndTheMessageOfWhatIsRefused) {
  const Workshop folder;
  const fs::path study = folder.write(
      "study.toml", tubes(folder, 1) + water("density = 740.0\nviscosity = 1.2e-7\nfrom = 6000.0\n"));
  const Outcome outcome = folder.fretwork({"check", study.string(), "--set", "mesh.scale=5000"});
  EXPECT_EQ(outcome.status, 1);
  EXPECT_TRUE(says(outcome.err, "zone \"z\" goes from"));
  EXPECT_TRUE(says(outcome.err, "units: a mesh 5000 m long, of sections up to 0.01905 m (mesh.scale = 1e-3 "
                                "turns mm into m): are these mm?"));
}

TEST(Check, WarnsOfAStepFarBelowTheAutomaticOne) {
  const Workshop folder;
  const std::string study =
      folder.write("study.toml", tubes(folder, 1) + supports("gap = 2.0e-4\n")).string();
  const auto checked = [&](const char* step) {
    return folder.fretwork({"check", study, "--set", std::string("transient.step=") + step}).out;
  };
  EXPECT_TRUE(says(checked("1e-9"), "is 10 000 times shorter than the automatic step, 1e-05 s"));
  EXPECT_FALSE(says(checked("2e-5"), "times shorter than"));
}

} // namespace fretwork::app::test::unit_slips_test
