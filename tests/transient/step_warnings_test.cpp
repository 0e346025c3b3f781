// SPDX-License-Identifier: GPL-3.0-or-later
// Fixed steps, and what is said of rates that a step does not resolve.
#include "step_rule_scenes.hpp"
#include <cmath>

namespace step_warnings_test {

using namespace fretwork;
using namespace fretwork::tests;
using namespace fretwork::tests::step_rule;
using contact::Circle;

TEST(StepWarnings, KeepsAFixedStepAndCoversTheDuration) {
  const Scene scene = scene_with({Circle{0.1}, {8e4}, {}}, 1.0);
  const StepChoice choice = choose_step(scene, splitting(1e-3));
  EXPECT_EQ(choice.step, 1e-3);
  EXPECT_EQ(choice.steps, 1000);
  EXPECT_EQ(choice.reason, "given in the study");
  EXPECT_TRUE(choice.warnings.empty());
  EXPECT_EQ(choose_step(scene, splitting(0.3e-3)).steps, 3334);
}

TEST(StepWarnings, WarnsWhereAFixedStepDoesNotResolve) {
  const auto warnings = [](const Scene& scene, const StepOptions& options) {
    return choose_step(scene, options).warnings;
  };
  const auto only = [](const std::vector<std::string>& list, const std::string& what) {
    ASSERT_EQ(list.size(), 1u);
    EXPECT_TRUE(mentions(list[0], what)) << list[0];
    EXPECT_TRUE(mentions(list[0], "take a smaller step or leave it out"));
  };
  only(warnings(scene_with({Circle{0.1}, {8e4}, {}}), splitting(15.5e-3)),
       "the contact frequency: w_c h = 3.1");
  const Scene dampers = scene_with({Circle{0.1}, {2.0}, {2.0, 4e3, 0.3, 0.3}});
  only(warnings(dampers, splitting(0.25)), "the tangential dampers' rate: r_t h = 500, at most 403.2");
  EXPECT_TRUE(warnings(dampers, splitting(3.25e-3)).empty()); // 2
  only(warnings(dampers, collocation(2.25e-3)), "the tangential dampers' rate: r_t h = 4.5");
  only(warnings(dampers, euler(0.6e-3)), "the tangential dampers' rate: r_t h = 1.2");
  const Scene mode = scene_with({Circle{0.1}, {2.0}, {}}, 1.0, Vec3(0, 2.0 * 1e6, 0));
  only(warnings(mode, splitting(3.1e-3)), "the highest mode: w_max h = 3.1");
  EXPECT_TRUE(warnings(mode, splitting(2.01e-3)).empty()); // rounded
  only(warnings(mode, euler(1.9e-3)), "the highest mode: w_max h = 1.9");
  only(warnings(scene_with({Circle{0.1}, {2.0, 4e3}, {}}), euler(0.6e-3)), "the dampers' rate: r_e h = 1.2");
  Scene excited = mass_point(mass, Vec3::Zero(), 1.0);
  excited.loads = {force_on(mass, Vec3(1, 0, 0), signals::Harmonic{1.0, 25.0})};
  only(warnings(excited, splitting(5e-3)), "the excitation: 8 steps a period, at least 10 for results");
}

// A step that is too long is so for much at once: one message, with the step that would do.
TEST(StepWarnings, SayOnceWhichStepResolvesEverything) {
  const auto given = [](const Scene& scene, double step) { return choose_step(scene, splitting(step)); };
  Scene scene = scene_with({Circle{0.1}, {8e4}, {8e4, 0.0, 0.3, 0.3}}, 1.0, Vec3(0, 2.0 * 1e6, 0));
  scene.loads = {force_on(mass, Vec3(1, 0, 0), signals::Harmonic{1.0, 25.0})};
  const StepChoice choice = given(scene, 0.016);
  ASSERT_EQ(choice.warnings.size(), 1u);
  EXPECT_EQ(choice.warnings[0].find(
                "the step 0.016 s does not resolve the contact frequency: w_c h = 3.2, at most 3; "),
            0u)
      << choice.warnings[0];
  for (const char* part :
       {"; the frequency of sticking contacts: w_t h = ", "; the highest mode: w_max h = 16, at most 2; ",
        "the excitation: 2.5 steps a period, at least 10 for results that can be trusted; ",
        "take a smaller step or leave it out; 0.002 s would do for all of them"})
    EXPECT_TRUE(mentions(choice.warnings[0], part)) << part << " in " << choice.warnings[0];
  EXPECT_TRUE(given(scene, 0.002).warnings.empty());
  // one thing alone
  const Scene near = scene_with({Circle{0.1}, {8e4}, {}}, 1.0, Vec3(0, mass * std::pow(0.2 * 200.0, 2), 0));
  const StepChoice one = given(near, 15.5e-3);
  ASSERT_EQ(one.warnings.size(), 1u);
  EXPECT_TRUE(mentions(one.warnings[0], "leave it out; 0.015 s would do")) << one.warnings[0];
  EXPECT_FALSE(mentions(one.warnings[0], "of them"));
  EXPECT_TRUE(given(near, 15e-3).warnings.empty());
  // no step need be shorter for the structure than w_c h = 1.75
  for (const auto& [own, longest] : {std::pair(0.45, 1e-2), {0.9, 8.75e-3}}) {
    const Scene beside =
        scene_with({Circle{0.1}, {8e4}, {}}, 1.0, Vec3(0, mass * std::pow(own * 200.0, 2), 0));
    EXPECT_TRUE(given(beside, longest).warnings.empty()) << own;
    const StepChoice above = given(beside, 1.05 * longest);
    ASSERT_EQ(above.warnings.size(), 1u) << own;
    EXPECT_TRUE(mentions(above.warnings[0], "the structure's frequency at contacts: w_s h = "));
    EXPECT_TRUE(mentions(above.warnings[0], own < 0.5 ? "0.01 s would do" : "0.00875 s would do"))
        << above.warnings[0];
  }
}

TEST(StepWarnings, ResolvesNormalDampersThatActImplicitly) {
  // w_c = 200 rad/s, r_n = C_N/m
  const Scene damped = scene_with({Circle{0.1}, {8e4, 3200.0 * mass}, {}});
  for (const auto scheme : {SchemeKind::collocation, SchemeKind::energy_conserving})
    expect_governed(damped, {scheme, {}}, 2.0 / 3200.0, "the normal dampers' rate 3200 1/s");
  expect_governed(damped, splitting(), share / 200.0, "the contact frequency 200 rad/s");
  const StepChoice intervals = choose_step(damped, splitting());
  EXPECT_EQ(intervals.parts, std::ceil(3200.0 * intervals.step / 1.8));
  expect_governed(scene_with({Circle{0.1}, {8e4, 20.0}, {}}), splitting(), share / 200.0,
                  "the contact frequency 200 rad/s");
  EXPECT_EQ(choose_step(scene_with({Circle{0.1}, {8e4, 0.0, 5.0}, {}}), splitting()).normal_damper_rate, 0.0);
}

// Their rate grows with penetrations that no one knows before the run: no mode is made heavier, at any step.
TEST(StepWarnings, FollowAllModesBesideHuntAndCrossleysDampers) {
  Scene scene = scene_with({Circle{0.1}, {8e4, 0.0, 5.0}, {}});
  scene.system.stiffness.setConstant(1e6); // 1000 rad/s, above 2.25 w_c = 450
  expect_governed(scene, splitting(), mode_share / 1000.0, "the highest mode 1000 rad/s");
  EXPECT_EQ(choose_step(scene, splitting()).scaled, 0);
  const StepChoice given = choose_step(scene, splitting(2.3e-3));
  ASSERT_EQ(given.warnings.size(), 1u);
  EXPECT_TRUE(mentions(given.warnings[0], "the highest mode: w_max h = 2.3"));
}

TEST(StepWarnings, NamesNormalDampersThatNoStepResolves) {
  // one that leaves no rebound does not ask for steps without end
  const Scene scene = scene_with({Circle{0.1}, {8e4, 1e9}, {}}, 1.0);
  for (const auto scheme : {SchemeKind::splitting, SchemeKind::collocation, SchemeKind::energy_conserving}) {
    const StepChoice choice = choose_step(scene, {scheme, {}});
    EXPECT_EQ(choice.steps, 20000) << choice.reason; // a third of 0.03/w_c
    ASSERT_EQ(choice.warnings.size(), 1u);
    EXPECT_TRUE(
        mentions(choice.warnings[0], "does not resolve the normal dampers' rate: r_n h = 2.5e+04, at most "));
    const bool keeps = scheme == SchemeKind::energy_conserving;
    EXPECT_EQ(mentions(choice.warnings[0], "rebounds are right at any step"), keeps);
    EXPECT_EQ(mentions(choice.warnings[0], "take scheme = \"energy_conserving\""),
              scheme == SchemeKind::collocation);
    const StepChoice given = choose_step(scene, {scheme, 1e-3});
    ASSERT_EQ(given.warnings.size(), 1u);
    EXPECT_TRUE(mentions(given.warnings[0], "r_n h = 5e+05")) << given.warnings[0];
    EXPECT_TRUE(mentions(given.warnings[0], "take a smaller step or leave it out"));
  }
  const double slow = 2.0 * mass; // r_n = 2
  EXPECT_TRUE(choose_step(scene_with({Circle{0.1}, {8e4, slow}, {}}), splitting(4e-3)).warnings.empty());
}

TEST(StepWarnings, WarnsOfLargestForcesThatEnergyConservingHasTooLow) {
  const Scene scene = scene_with({Circle{0.1}, {8e4}, {}}); // w_c = 200 rad/s
  EXPECT_TRUE(choose_step(scene, energy_conserving(2.4e-3)).warnings.empty());
  EXPECT_EQ(choose_step(scene, energy_conserving(5e-3)).warnings.size(), 1u); // 14 % at w_c h = 1
}

} // namespace step_warnings_test
