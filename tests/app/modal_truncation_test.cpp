// SPDX-License-Identifier: GPL-3.0-or-later
// What is said of modes that are too few: the first of the warnings, with the size of the error and the cure.
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
      first_warning(folder.run_text(study, {"--set", two, "--set", "modes.static_modes=auto"}));
  EXPECT_TRUE(says(few, "modal truncation: "));
  EXPECT_TRUE(says(few, "acts with up to 220 Hz, but the modes end at 113"));
  EXPECT_TRUE(says(few, "53 % of its power excites no mode")); // (220 - 113) / (220 - 20)
  EXPECT_TRUE(says(few, "set modes.up_to_hz = 440"));
  EXPECT_EQ(first_warning(folder.run_text(study, {"--set", many})).find("acts with up to"),
            std::string::npos);
}

TEST(ModalTruncation, FlexibilityThatTheModesLackIsAWarningWithItsFactor) {
  const Workshop folder;
  const std::string study = supported(folder, "", 100.0);
  const Results few = folder.run_text(study, {"--set", two});
  const std::string said = first_warning(few);
  EXPECT_TRUE(says(said, "modal truncation: the modes lack flexibility at 1 of 1 contact, up to "));
  EXPECT_TRUE(says(said, "set modes.static_modes = \"auto\", or ask for more modes (modes.accuracy = 0.01"));
  const double missing = few.statistics("plate")["static_flexibility"]["missing"];
  EXPECT_TRUE(says(said, fmt::format("up to a factor {:.2g};", std::sqrt(1.0 + 1.0e7 * missing))));
  EXPECT_GT(1.0e7 * missing, 0.3);
  for (const char* cure : {"modes.static_modes=auto", "modes.static_modes=all"})
    EXPECT_EQ(
        folder.run_text(study, {"--set", two, "--set", cure}).summary["warnings"].dump().find("lack flex"),
        std::string::npos)
        << cure;
}

// 22 supports on 20 modes that end at 9 Hz: the equations of the contacts in series are stiff.
/// u_bend with so many modes and residual flexibility.
Results with_few_modes(const Workshop& folder, const char* modes) {
  std::vector<std::string> arguments;
  for (const char* key :
       {"transient.duration=0.6", "transient.step=3e-4", modes, "modes.static_modes=auto"}) {
    arguments.emplace_back("--set");
    arguments.emplace_back(key);
  }
  return folder.run(example("u_bend"), "results", arguments);
}

TEST(ModalTruncation, FindsTheForcesOfContactsThatShareALargeResidualFlexibility) {
  const Workshop folder;
  EXPECT_EQ(with_few_modes(folder, "modes.count=20").summary["transient"]["unconverged_steps"],
            0); // K_N R = 94
}

// Its statics and its equations are right, its impacts are not: the work rate of 20 modes is 2.9 times that of 358.
TEST(ModalTruncation, ModesThatEndBelowTheContactsAreWarnedAboutWithResidualFlexibility) {
  const Workshop folder;
  const auto said = [&](const char* modes) {
    return with_few_modes(folder, modes).summary["warnings"].dump();
  };
  const std::string few = said("modes.count=20");
  EXPECT_TRUE(says(few, "modal truncation: the modes end at 9.081 Hz; contact "));
  EXPECT_TRUE(says(few, "impacts within 10 % need modes up to"));
  EXPECT_TRUE(says(few, "with residual flexibility; work rates and forces may be wrong by tens of per cent, "
                        "with very few modes by factors; ask for more modes (modes.accuracy = 0.01"));
  EXPECT_EQ(said("modes.count=200").find("the modes end at"), std::string::npos);
}

TEST(ModalTruncation, ResidualFlexibilityThatIsTooLargeAsksForModesNotForASmallerStep) {
  const Workshop folder;
  const Results run = with_few_modes(folder, "modes.count=6");
  ASSERT_GT(run.summary["transient"]["unconverged_steps"], 10);
  const std::string said = first_warning(run);
  EXPECT_TRUE(
      says(said, "the coupled contact forces missed their tolerance: the residual flexibility in series"));
  EXPECT_TRUE(says(said, "ask for more modes (modes.accuracy = 0.01"));
  EXPECT_EQ(said.find("smaller step"), std::string::npos);
}

} // namespace
} // namespace fretwork::app::test::modal_truncation_test
