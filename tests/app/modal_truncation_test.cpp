// SPDX-License-Identifier: GPL-3.0-or-later
// What is said of modes that are too few: the first of the warnings, with the size of the error and the cure.
#include "mesh_text.hpp"
#include "study_text.hpp"
#include "tubes.hpp"
#include <cmath>
#include <fmt/format.h>

namespace fretwork::app::test::modal_truncation_test {
namespace {

/// A clamped tube of 1 m, first modes at 113 Hz and 312 Hz, with a stiff support in the middle.
std::string supported(const Workshop& folder, const std::string& modes, double highest) {
  return tubes(folder, 1) +
         fmt::format(R"([[contacts]]
name = "plate"
group = "mid0"
gap = 2.0e-4
normal_stiffness = 1.0e7
[[loads]]
group = "mid0"
direction = [0.0, 1.0, 0.3]
random = {{ rms = 20.0, band = [20.0, {:.1f}] }}
)",
                     highest) +
         modes;
}

std::string first_warning(const Results& run) {
  const auto& warnings = run.summary["warnings"];
  return warnings.empty() ? "" : warnings[0].get<std::string>();
}

const std::string two = "modes.count=2", many = "modes.count=80";

TEST(ModalTruncation, ALoadAboveTheModesIsWarnedAboutWithItsShareAndTheCure) {
  const Workshop folder;
  const std::string study = supported(folder, "", 220.0);
  const std::string few =
      first_warning(folder.run_text(study, {"--set", two, "--set", "modes.static_modes=all"}));
  EXPECT_TRUE(says(few, "modal truncation: "));
  EXPECT_TRUE(says(few, "acts with up to 220 Hz, but the modes end at 113"));
  EXPECT_TRUE(says(few, "53 % of its power excites no mode")); // (220 - 113) / (220 - 20)
  EXPECT_TRUE(says(few, "set modes.up_to_hz = 440"));
  EXPECT_EQ(first_warning(folder.run_text(study, {"--set", many})).find("acts with up to"),
            std::string::npos);
}

// A mass that moves along x and y, with 1.6 and 3.2 Hz.
TEST(ModalTruncation, AStructureWithoutMoreModesIsNotWarnedAbout) {
  const Workshop folder;
  folder.write("mesh.msh", lone_points({"mass"}).text());
  const std::string study = R"([mesh]
file = "mesh.msh"
[[masses]]
group = "mass"
mass = 1.0
[[springs]]
group = "mass"
stiffness = [100.0, 400.0, 0, 0, 0, 0]
[[restraints]]
group = "mass"
fixed = ["uz", "rx", "ry", "rz"]
[[loads]]
group = "mass"
direction = [1.0, 1.0, 0.0]
harmonic = { amplitude = 1.0, frequency = 10.0 }
[transient]
duration = 1.0
)";
  const auto warned = [&](const char* modes) {
    return says(folder.run_text(study, {"--set", modes}).summary["warnings"].dump(), "excites no mode");
  };
  for (const char* all : {"modes.count=2", "modes.count=3", "modes.up_to_hz=4"})
    EXPECT_FALSE(warned(all)) << all;
  for (const char* first : {"modes.count=1", "modes.up_to_hz=2"})
    EXPECT_TRUE(warned(first)) << first;
}

TEST(ModalTruncation, FlexibilityThatTheModesLackIsAWarningWithItsFactor) {
  const Workshop folder;
  const std::string study = supported(folder, "", 100.0);
  const Results few = folder.run_text(study, {"--set", two});
  const std::string said = first_warning(few);
  EXPECT_TRUE(says(said, "modal truncation: the modes lack flexibility at 1 of 1 contact, up to "));
  EXPECT_TRUE(says(said, "set modes.static_modes = \"all\", or ask for more modes (modes.accuracy = 0.01"));
  const double missing = few.statistics("plate")["static_flexibility"]["missing"];
  EXPECT_TRUE(says(said, fmt::format("up to a factor {:.2g};", std::sqrt(1.0 + 1.0e7 * missing))));
  EXPECT_GT(1.0e7 * missing, 0.3);
  const auto warnings =
      folder.run_text(study, {"--set", two, "--set", "modes.static_modes=all"}).summary["warnings"];
  EXPECT_EQ(warnings.dump().find("lack flex"), std::string::npos);
}

// 22 supports on 6 and on 20 modes, which end below 9 Hz: contacts share up to 94/K_N of flexibility that these lack.
TEST(ModalTruncation, StaticModesHoldContactsThatShareALargeFlexibility) {
  constexpr double balance = 5e-3; // of the energy put in
  const Workshop folder;
  for (const char* modes : {"modes.count=6", "modes.count=20"}) {
    const Results run = folder.run(example("u_bend"), "results",
                                   {"--set", modes, "--set", "modes.static_modes=all", "--set",
                                    "transient.duration=0.6", "--set", "transient.scheme=splitting"});
    EXPECT_EQ(run.summary["transient"]["unconverged_steps"], 0) << modes;
    EXPECT_LT(run.summary["energy"]["residual_relative"], balance) << modes;
  }
}

/// u_bend with so many modes and static modes.
Results with_few_modes(const Workshop& folder, const char* modes) {
  return folder.run(example("u_bend"), "few",
                    {"--set", modes, "--set", "modes.static_modes=all", "--set", "transient.duration=0.6",
                     "--set", "transient.scheme=splitting", "--force"});
}

// Its statics and its equations are right, its impacts are not: the work rate of 25 modes is 1.3 times that of 300.
TEST(ModalTruncation, ModesThatEndBelowTheContactsAreWarnedAboutWithStaticModes) {
  const Workshop folder;
  const auto said = [&](const char* modes) {
    return with_few_modes(folder, modes).summary["warnings"].dump();
  };
  const std::string few = said("modes.count=20");
  EXPECT_TRUE(says(few, "modal truncation: the modes end at 9.081 Hz; contact "));
  EXPECT_TRUE(says(few, "impacts within 10 % need modes up to"));
  EXPECT_TRUE(says(few, "with static modes; work rates and forces may be wrong by tens of per cent, "
                        "with very few modes by factors; ask for more modes (modes.accuracy = 0.01"));
  EXPECT_EQ(said("modes.count=200").find("the modes end at"), std::string::npos);
}

// The first 8 modes bend the tube: none has a part of its deflection under a force along it.
TEST(ModalTruncation, ALoadAlongTheTubeLacksDeflection) {
  const Workshop folder;
  const auto warnings = [&](const char* direction, const char* count) {
    const Results run = folder.run_text(tubes(folder, 1) +
                                            "[[loads]]\nname = \"pull\"\ngroup = \"mid0\"\n"
                                            "constant = 100.0\ndirection = " +
                                            std::string(direction) + "\n",
                                        {"--set", count});
    return run.summary["warnings"].dump();
  };
  EXPECT_TRUE(
      says(warnings("[1, 0, 0]", "modes.count=8"),
           "modal truncation: the modes lack up to 100 % of the static deflection under load \\\"pull"));
  EXPECT_EQ(warnings("[1, 0, 0]", "modes.count=48").find("static deflection"), std::string::npos);
  EXPECT_EQ(warnings("[0, 1, 0]", "modes.count=8").find("static deflection"), std::string::npos);
}

/// A rod of 4 m along z that rests on its lower end; five grids of dimples and springs, or nothing, hold it across.
std::string rod(const Workshop& folder, bool grids, const char* direction) {
  MeshText mesh = straight_line("rod", {0.0, 0.0, 0.0}, {0.0, 0.0, 4.0}, 64);
  std::string study = steel_pipe("mesh.msh") + tube_between("rod", R"(["uz", "rz"])", "");
  for (int i = 0; i < 5; ++i) {
    mesh.points.emplace_back(fmt::format("grid{}", i), 4 + 14 * i);
    if (grids)
      study += fmt::format("[[contacts]]\ngroup = \"grid{}\"\nobstacle = \"circle\"\ngap = 0.0\n"
                           "normal_stiffness = 1.0e5\n",
                           i);
  }
  folder.write("mesh.msh", mesh.text());
  return study +
         "[transient]\nduration = 0.02\n[[loads]]\nname = \"flow\"\ngroup = \"rod\"\nper_length = "
         "true\ndirection = " +
         direction + "\nrandom = { rms = 0.5, band = [5.0, 20.0] }\n";
}

// Without its contacts the rod only moves along under an even load: what its modes lack then is a share of round-off.
TEST(ModalTruncation, OfARodOnContactsAloneTheDeflectionIsThatOnItsContacts) {
  const Workshop folder;
  const auto warnings = [&](const std::string& study, const std::vector<std::string>& set) {
    return folder.run_text(study, set).summary["warnings"].dump();
  };
  const std::string held = rod(folder, true, "[0, 1, 0]");
  EXPECT_EQ(warnings(held, {}).find("static deflection"), std::string::npos);
  const std::string few = warnings(held, {"--set", "modes.count=8"});
  EXPECT_TRUE(says(few, "% of the static deflection under load \\\"flow\\\" (with closed contacts, where "
                        "these alone hold the structure)"));
  EXPECT_EQ(warnings(rod(folder, false, "[0, 1, 0]"), {}).find("static deflection"), std::string::npos);
}

} // namespace
} // namespace fretwork::app::test::modal_truncation_test
