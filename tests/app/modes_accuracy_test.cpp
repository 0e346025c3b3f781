// SPDX-License-Identifier: GPL-3.0-or-later
// modes.accuracy: as many modes as the forces of contacts need.
#include "mesh_text.hpp"
#include "paths.hpp"
#include "program.hpp"
#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace fretwork::app::test::modes_accuracy_test {
namespace {

constexpr double bending = 496.0, mass = 1.0; // N m2, kg/m of a span of 1 m

/// The span of bench/span, which is thrown against a stop; overrides as key=value.
Results span(const Workshop& folder, std::vector<std::string> overrides) {
  overrides.emplace_back("transient.duration=0.015");
  std::vector<std::string> arguments{"--force"};
  for (const std::string& override : overrides) {
    arguments.emplace_back("--set");
    arguments.push_back(override);
  }
  return folder.run(test_paths::source_dir() / "bench" / "span" / "study.toml", "span", arguments);
}

std::string stiffness_of(double value) { return fmt::format("contacts.stop.normal_stiffness={}", value); }

double largest_force(const Results& run) { return run.statistics("stop")["normal_force"]["max"]; }

TEST(ModesAccuracy, ImpactsOfASpanAreWithinIt) {
  constexpr double accuracy = 0.01;
  const Workshop folder;
  const std::string place = "contacts.stop.group=at_21";
  for (const double stiffness : {1e5, 1e6, 1e7}) {
    const double exact = largest_force(
        span(folder, {place, stiffness_of(stiffness), "modes.count=60", "modes.static_modes=auto"}));
    for (const char* static_modes : {"none", "auto", "all"}) {
      const Results run =
          span(folder, {place, stiffness_of(stiffness), fmt::format("modes.accuracy={}", accuracy),
                        fmt::format("modes.static_modes={}", static_modes)});
      const double error = largest_force(run) / exact - 1.0;
      fmt::print("| K_N {:.0e} | {} | {} modes | error {:.2f} % |\n", stiffness, static_modes,
                 run.summary["modes"]["frequencies_hz"].size(), 100.0 * error);
      EXPECT_LT(std::abs(error), accuracy) << stiffness << " " << static_modes;
      // and not by many modes more than it takes
      EXPECT_LT(run.summary["modes"]["frequencies_hz"].back().get<double>(),
                run.summary["modes"]["limit"]["up_to_hz"].get<double>());
    }
  }
}

TEST(ModesAccuracy, SaysWhatItTakesAndFollowsTheContacts) {
  constexpr double six_digits = 1e-6; // of the root of the clamped span
  const Workshop folder;
  std::size_t before = 0;
  for (const double stiffness : {1e5, 1e6}) {
    const Results run = span(folder, {stiffness_of(stiffness), "modes.accuracy=0.01"});
    const double contact =
        std::sqrt(bending / mass) * std::pow(stiffness / (2.0 * std::numbers::sqrt2 * bending), 2.0 / 3.0);
    const double root = std::sqrt(7.0 * contact) + 4.7300407 * std::pow(bending / mass, 0.25);
    const auto& limit = run.summary["modes"]["limit"];
    EXPECT_EQ(limit["contact"], "stop");
    EXPECT_EQ(limit["accuracy"], 0.01);
    EXPECT_TRUE(close_to(limit["contact_frequency_hz"], contact / (2.0 * std::numbers::pi), six_digits));
    EXPECT_TRUE(close_to(limit["up_to_hz"], root * root / (2.0 * std::numbers::pi), six_digits));
    EXPECT_TRUE(says(run.summary["notes"].dump(), "for contact forces within modes.accuracy = 0.01"));
    const std::size_t modes = run.summary["modes"]["frequencies_hz"].size();
    EXPECT_GT(modes, before) << "the modes of another stiffness are not read again";
    before = modes;
  }
}

TEST(ModesAccuracy, OfAPercentIsTheDefaultWhereContactsAreAtBeams) {
  const Workshop folder;
  const Results given = span(folder, {"modes.accuracy=0.01"}), by_default = span(folder, {});
  EXPECT_EQ(by_default.summary["modes"]["limit"], given.summary["modes"]["limit"]);
  EXPECT_EQ(by_default.summary["modes"]["frequencies_hz"], given.summary["modes"]["frequencies_hz"]);
  EXPECT_EQ(largest_force(by_default), largest_force(given));
  EXPECT_TRUE(says(by_default.summary["notes"].dump(),
                   "within modes.accuracy = 0.01 (the default; modes.count takes a number)"));
  const Results with_residual = span(folder, {"modes.static_modes=auto"});
  EXPECT_LT(with_residual.summary["modes"]["limit"]["up_to_hz"],
            by_default.summary["modes"]["limit"]["up_to_hz"]);
  EXPECT_FALSE(span(folder, {"modes.count=12"}).summary["modes"].contains("limit"));
}

TEST(ModesAccuracy, TheDefaultHasACeiling) {
  const Workshop folder;
  folder.write("line.msh", straight_line("tube", {0, 0, 0}, {1, 0, 0}, 600).text());
  const fs::path study = folder.write("study.toml", steel_pipe("line.msh") + R"([[beams]]
group = "tube"
material = "steel"
section = "tube"
[[restraints]]
group = "tube_begin"
fixed = "all"
[[contacts]]
group = "tube_end"
gap = 1e-3
normal_stiffness = 1e14
[transient]
duration = 1e-4
)");
  const Outcome checked = folder.fretwork({"check", study.string()});
  ASSERT_EQ(checked.status, 0) << checked.err;
  const std::string told = "the default takes 1000 at most, up to ";
  EXPECT_TRUE(says(checked.out, "warning: modes: contact \"tube_end\" asks for modes up to "))
      << "before they are computed";
  EXPECT_TRUE(says(checked.out, told));
  const auto computed = [&](const std::string& more) {
    const Outcome done =
        folder.fretwork({"modes", study.string(), "-o", folder.path("out").string(), "--set", more});
    EXPECT_EQ(done.status, 0) << done.err;
    return nlohmann::json::parse(bytes_of(folder.path("out") / "summary.json"));
  };
  const auto capped = computed("transient.duration=1e-5"), asked = computed("modes.count=10");
  constexpr double of_the_count = 0.2; // by waves: half the shortest ones have an element and a half
  EXPECT_NEAR(static_cast<double>(capped["modes"]["frequencies_hz"].size()), 1000.0, 1000.0 * of_the_count);
  EXPECT_TRUE(says(capped["warnings"].dump(), "forces of impacts may be wrong by "));
  EXPECT_FALSE(says(asked["warnings"].dump(), told));
}

TEST(ModesAccuracy, WithoutContactsAtBeamsTheDefaultIsANumber) {
  const Workshop folder;
  const Results run = folder.run(example("oscillator"), "results", {"--set", "transient.duration=0.01"});
  EXPECT_FALSE(run.summary["modes"].contains("limit"));
  EXPECT_FALSE(run.summary["modes"]["frequencies_hz"].empty());
}

TEST(ModesAccuracy, TakesModesUpToTwiceTheFrequenciesOfLoads) {
  const Workshop folder;
  const fs::path scene = test_paths::source_dir() / "bench" / "span";
  fs::copy_file(scene / "span.geo", folder.path("span.geo"));
  const Results run = folder.run_text(bytes_of(scene / "study.toml") + R"([[loads]]
group = "at_47"
direction = [0.0, 1.0, 0.0]
harmonic = { amplitude = 1.0, frequency = 5000.0 }
)",
                                      {"--set", "modes.accuracy=0.1", "--set", stiffness_of(1e5)});
  EXPECT_EQ(run.summary["modes"]["limit"]["up_to_hz"], 10000.0);
  EXPECT_GT(run.summary["modes"]["frequencies_hz"].back(), 5000.0);
  EXPECT_TRUE(
      says(run.summary["notes"].dump(), "modes up to 1e+04 Hz, twice the highest frequency of loads"));
  EXPECT_EQ(run.summary["warnings"].dump().find("acts with up to"), std::string::npos);
}

TEST(ModesAccuracy, TellsWhatHasTheFlexibilityOfTheOtherModes) {
  const Workshop folder;
  const Results run = span(folder, {"modes.accuracy=0.1", "modes.static_modes=all"});
  EXPECT_TRUE(says(run.summary["notes"].dump(), "times that is needed with static modes,"));
}

TEST(ModesAccuracy, NeedsContacts) {
  const Workshop folder;
  const fs::path study =
      folder.write("study.toml", "[mesh]\nfile = \"beam.msh\"\n[modes]\naccuracy = 0.01\n");
  const Outcome outcome = folder.fretwork({"check", study.string()});
  EXPECT_EQ(outcome.status, 1);
  EXPECT_TRUE(says(outcome.err, "modes.accuracy = 0.01: there are no [[contacts]]"));
  EXPECT_TRUE(says(outcome.err, "give count or up_to_hz"));
}

TEST(ModesAccuracy, NeedsAContactAtABeam) {
  const Workshop folder;
  folder.write("mass.msh", lone_points({"mass"}).text());
  const fs::path study = folder.write("study.toml", R"([mesh]
file = "mass.msh"
[[masses]]
group = "mass"
mass = 1.0
[[restraints]]
group = "mass"
fixed = ["uz", "rx", "ry", "rz"]
[modes]
accuracy = 0.01
[[contacts]]
name = "stop"
group = "mass"
obstacle = "circle"
axis = [0.0, 0.0, 1.0]
gap = 1.0e-4
normal_stiffness = 1.0e6
[transient]
duration = 0.01
)");
  for (const char* command : {"run", "check"}) {
    const Outcome outcome = folder.fretwork({command, study.string()});
    EXPECT_EQ(outcome.status, 1) << command;
    EXPECT_TRUE(says(outcome.err, "modes.accuracy = 0.01: no contact is at a beam with mass")) << command;
    EXPECT_TRUE(says(outcome.err, "give modes.count or modes.up_to_hz")) << command;
  }
}

} // namespace
} // namespace fretwork::app::test::modes_accuracy_test
