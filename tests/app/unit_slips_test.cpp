// SPDX-License-Identifier: GPL-3.0-or-later
// Values in other units than the SI's: one question for all of them, from check and from run.
#include "study_text.hpp"
#include "tubes.hpp"
#include <fmt/format.h>
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
  const auto length = asked(folder, study + "[[wear]]\ncoefficient = 1.0e-14\nlength = 30\n", {});
  ASSERT_EQ(length.size(), 1u);
  EXPECT_TRUE(says(length[0], "wear.0.length = 30 m: are these mm?"));
  const auto step = asked(folder, study, {"transient.duration=2", "transient.step=0.1"});
  ASSERT_EQ(step.size(), 1u);
  EXPECT_TRUE(
      says(step[0], "transient.step = 0.1 s is longer than the slowest vibration on a contact can be"));
}

TEST(UnitSlips, AreSaidByTheRunToo) {
  const Workshop folder;
  const Results run = folder.run_text(
      tubes(folder, 1) + supports("gap = 2.0e-4\nfriction = 30\ntangential_stiffness = 1.0e6\n"));
  EXPECT_TRUE(
      says(run.summary["warnings"].dump(), "friction = 30 of contact \\\"h0\\\" ... \\\"h14\\\" (15)"));
}

} // namespace fretwork::app::test::unit_slips_test
