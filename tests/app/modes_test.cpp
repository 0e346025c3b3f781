// SPDX-License-Identifier: GPL-3.0-or-later
// `fretwork modes` as its users meet it: copies, the error of the mesh, effective masses, spans.
#include "mesh_text.hpp"
#include "program.hpp"
#include "study_text.hpp"
#include <cmath>
#include <fmt/format.h>

namespace fretwork::app::test::modes_test {
namespace {

/// Clamped tubes side by side, of the given lengths.
std::string tubes(const Workshop& folder, const std::vector<double>& lengths, int elements, int count) {
  MeshText mesh;
  std::string study = steel_pipe("tubes.msh") + fmt::format("[modes]\ncount = {}\n", count);
  for (std::size_t i = 0; i < lengths.size(); ++i) {
    const double y = 0.07 * static_cast<double>(i);
    mesh = together(mesh,
                    straight_line(fmt::format("tube{}", i), {0.0, y, 0.0}, {lengths[i], y, 0.0}, elements));
    study += tube_between(fmt::format("tube{}", i), "\"all\"", "");
  }
  folder.write("tubes.msh", mesh.text());
  return folder.write("study.toml", study).string();
}

nlohmann::json summary_of(const Workshop& folder) {
  return nlohmann::json::parse(bytes_of(folder.path("study.results") / "summary.json"));
}

TEST(ModesCommand, WarnsOfAListWithUnequalRatiosOfModesOfOneFrequency) {
  const Workshop folder;
  const std::string study = tubes(folder, {1.0, 1.1}, 20, 4); // two planes each
  const auto warnings = [&](const char* damping) {
    const Outcome outcome =
        folder.fretwork({"modes", study, "--force", "--set", std::string("modes.damping=") + damping});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return summary_of(folder)["warnings"].dump();
  };
  const std::string unequal = warnings("[0.01, 0.02, 0.03, 0.03]");
  EXPECT_TRUE(says(unequal, "the list gives 0.01 to mode 1 and 0.02 to mode 2 of structure 0, both at "));
  EXPECT_TRUE(says(unequal, "lie along fixed axes (of a straight tube along x along y, then z)"));
  EXPECT_TRUE(says(unequal, "(and 1 more such pair)")); // of the second tube, where the list begins anew
  EXPECT_FALSE(says(warnings("[0.01, 0.01, 0.03, 0.03]"), "the list gives"));
  EXPECT_FALSE(says(warnings("{ table = [[10, 0.01], [100, 0.02]] }"), "the list gives"));
}

TEST(ModesCommand, NamesAStructureWithoutModes) {
  const Workshop folder;
  const std::string study = tubes(folder, {1.0, 0.1}, 20, 6);
  const Outcome outcome = folder.fretwork({"modes", study, "--set", "modes={ up_to_hz = 100.0 }"});
  EXPECT_EQ(outcome.status, 1);
  EXPECT_TRUE(says(outcome.err, "the structure that starts at node (0, 0.07, 0) has no mode up to "
                                "modes.up_to_hz = 100: its lowest is at 17")) // hundred: clamped, 0.1 m
      << outcome.err;
  EXPECT_TRUE(
      says(outcome.err, "give a higher limit, or, where it may count as rigid, hold it by [[restraints]]"));
}

// A tube between a clamp and a pin, with a spring at its contact: that of K_N across, that of K_T along.
TEST(ModesCommand, TellsTheFrequenciesWithContactsClosed) {
  const Workshop folder;
  const auto modes = [&](const std::string& study) {
    folder.write("study.toml", study);
    const Outcome outcome = folder.fretwork({"modes", folder.path("study.toml").string()});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return std::pair{summary_of(folder), outcome.out};
  };
  std::string study = bundle(folder, 1, "[transient]\nduration = 0.01\n");
  const auto [with_contact, told] = modes(study);
  const std::size_t contact = study.find("[[contacts]]");
  study.replace(contact, study.find("[[loads]]") - contact,
                "[[springs]]\ngroup = \"support0\"\nstiffness = [1.0e6, 1.0e6, 1.0e6, 0, 0, 0]\n");
  const auto with_spring = modes(study).first["modes"]["frequencies_hz"].get<std::vector<double>>(),
             closed = with_contact["closed_contacts_hz"].get<std::vector<double>>();
  ASSERT_GE(closed.size(), 6u);
  for (std::size_t k = 0; k < 6; ++k)
    EXPECT_NEAR(closed[k] / with_spring[k], 1.0, 1e-6) << k;
  EXPECT_GT(closed[0], 1.5 * with_contact["modes"]["frequencies_hz"][0].get<double>());
  EXPECT_TRUE(says(told, "on contacts " + fmt::format("{:.5g}", closed[0])));
}

TEST(ModesCommand, SolvesEqualTubesOnce) {
  const Workshop folder;
  const Outcome outcome = folder.fretwork({"modes", tubes(folder, {1.0, 1.3, 1.0, 1.0, 1.3}, 20, 6)});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const auto summary = summary_of(folder);
  EXPECT_EQ(summary["model"]["different_structures"], 2);
  EXPECT_TRUE(says(summary["notes"].dump(), "5 structures, 2 different ones"));
  const auto& frequencies =
      summary["modes"]["frequencies_hz"]; // ascending: two planes of the three longer ...
  EXPECT_EQ(frequencies.size(), 30u);
  EXPECT_EQ(frequencies[0], frequencies[3]);
  EXPECT_EQ(frequencies[4], frequencies[9]);
  EXPECT_LT(frequencies[3], frequencies[4]);
}

TEST(ModesCommand, SaysWhereAStructureHasFewerModesThanTheStudyAsksFor) {
  const Workshop folder;
  const auto notes = [&](int count) {
    const Outcome outcome = folder.fretwork({"modes", tubes(folder, {1.0}, 2, count)});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return summary_of(folder)["notes"].dump();
  };
  EXPECT_TRUE(says(notes(40), "modes.count = 40 is more than the "));
  EXPECT_FALSE(says(notes(2), "is more than the "));
}

TEST(ModesCommand, PrintsErrorsAndEffectiveMasses) {
  const Workshop folder;
  const Outcome outcome = folder.fretwork({"modes", tubes(folder, {1.0}, 16, 8)});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_TRUE(says(outcome.out, "mesh error"));
  EXPECT_TRUE(says(outcome.out, "61.3")); // per cent of its mass in the first mode of a cantilever: 61.31
  EXPECT_TRUE(says(outcome.out, "all modes together"));
  const auto modes = summary_of(folder)["modes"];
  ASSERT_EQ(modes["error_estimate"].size(), 8u);
  // (beta L / n)^4 / 1440 of the first mode
  EXPECT_TRUE(close_to(modes["error_estimate"][0], std::pow(1.8751 / 16, 4) / 1440, 0.02));
  ASSERT_EQ(modes["effective_mass_kg"].size(), 8u);
  for (const std::size_t direction : {0u, 1u, 2u}) {
    double sum = 0.0;
    for (const auto& masses : modes["effective_mass_kg"])
      sum += masses[direction].get<double>();
    EXPECT_TRUE(close_to(modes["effective_mass_sum_kg"][direction], sum, 1e-12));
    EXPECT_LE(sum, modes["moving_mass_kg"][direction].get<double>());
  }
}

TEST(ModesCommand, WarnsOfMeshesTooCoarseForTheirModes) {
  const Workshop folder;
  ASSERT_EQ(folder.fretwork({"modes", tubes(folder, {1.0}, 3, 12)}).status, 0);
  EXPECT_TRUE(says(summary_of(folder)["warnings"].dump(), "the mesh is coarse for"));
}

TEST(ModesCommand, WarnsOfSpansOfTooManyElementsAndRefusesMore) {
  const Workshop folder;
  ASSERT_EQ(folder.fretwork({"modes", tubes(folder, {1.0}, 1001, 2)}).status, 0);
  EXPECT_TRUE(says(summary_of(folder)["warnings"].dump(), "has 1001 elements between supports or branches"));
  const Outcome outcome = folder.fretwork({"modes", tubes(folder, {1.0}, 3001, 2)});
  EXPECT_EQ(outcome.status, 1);
  EXPECT_TRUE(says(outcome.err, "the span that starts at (0, 0, 0) has 3001 elements"));
}

// A mode of torsion is below the 20th pair of bending, which a count of 40 would part.
TEST(ModesCommand, TakesWholeGroupsOfEqualFrequenciesByDefault) {
  const Workshop folder;
  const std::string study = bytes_of(tubes(folder, {20.0}, 120, 40));
  const auto summary = [&](const std::string& count) {
    std::string text = study;
    text.replace(text.find("count = 40"), std::string("count = 40").size(), count);
    const Outcome outcome = folder.fretwork({"modes", folder.write("study.toml", text).string(), "--force"});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return summary_of(folder);
  };
  const auto of_default = summary(""), cut = summary("count = 40");
  const auto& f = of_default["modes"]["frequencies_hz"];
  ASSERT_EQ(f.size(), 41u);
  EXPECT_EQ(f[40], f[39]);
  EXPECT_EQ(of_default["warnings"].dump().find("cuts a group"), std::string::npos);
  EXPECT_TRUE(says(cut["warnings"].dump(), "modes.count = 40 cuts a group of equal frequencies"));
}

} // namespace
} // namespace fretwork::app::test::modes_test
