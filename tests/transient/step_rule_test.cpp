// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/error.hpp"
#include "step_rule_scenes.hpp"
#include <gtest/gtest.h>
#include <string>

namespace step_rule_test {

using namespace fretwork;
using namespace fretwork::tests;
using namespace fretwork::tests::step_rule;
using namespace fretwork::signals;
using namespace fretwork::transient;
using contact::Circle;
using contact::PlaneAxis;
using contact::PlanePair;

TEST(StepRule, ResolvesTheContactFrequency) {
  expect_governed(scene_with({Circle{0.1}, {8e4}, {}}), splitting(), share / std::sqrt(8e4 / mass),
                  "the contact frequency 200 rad/s");
}

TEST(StepRule, TakesNoStepAboveTheLongestShareOfTheContactFrequency) {
  StepOptions coarse = splitting();
  coarse.accuracy = 0.5;
  expect_governed(scene_with({Circle{0.1}, {8e4}, {}}), coarse, share / 200.0,
                  "the contact frequency 200 rad/s");
}

TEST(StepRule, GivesCollocationALongerStepWhateverTheModes) {
  expect_governed(scene_with({Circle{0.1}, {8e4}, {}}, 1000.0, Vec3(0, 1e12, 0)), collocation(),
                  0.5 / std::sqrt(8e4 / mass), "the contact frequency 200 rad/s");
}

TEST(StepRule, ResolvesTheFrequencyOfStickingContacts) {
  Scene scene = scene_with({Circle{0.1}, {2.0}, {8e4, 0.0, 0.3, 0.3}});
  expect_governed(scene, splitting(), share / 200.0, "the frequency of sticking contacts 200 rad/s");
  EXPECT_EQ(choose_step(scene, splitting()).parts, 3); // w_t dt up to 1
  EXPECT_EQ(choose_step(scene, splitting(3.5 / 200.0)).parts, 4);
}

TEST(StepRule, ResolvesTheTangentialDampers) {
  const Scene scene = scene_with({Circle{0.1}, {2.0}, {2.0, 4e3, 0.3, 0.3}});
  expect_governed(scene, euler(), eps / 2000.0, "the tangential dampers' rate 2000 1/s");
  expect_governed(scene, collocation(), 2.0 / 2000.0, "the tangential dampers' rate 2000 1/s");
  const std::string reason = choose_step(scene, collocation()).reason;
  EXPECT_TRUE(mentions(reason, "a smaller tangential_damping makes the step longer (scheme = \"splitting\""))
      << reason;
}

TEST(StepRule, ResolvesTheTangentialDampersOfSplittingInItsIntervals) {
  Scene scene = scene_with({Circle{0.1}, {8e4}, {2.0, 4e4, 0.3, 0.3}}); // r_t = 2e4 1/s
  expect_governed(scene, splitting(), share / 200.0, "the contact frequency 200 rad/s");
  EXPECT_EQ(choose_step(scene, splitting()).parts, 48); // r_t dt below 6.3
  EXPECT_EQ(choose_step(scene, splitting(share / 400.0)).parts, 24);
  scene = scene_with({Circle{0.1}, {2.0}, {2.0, 4e3, 0.3, 0.3}}, 1e5);
  expect_governed(scene, splitting(), 64 * 6.3 / 2000.0, "the tangential dampers' rate 2000 1/s");
  EXPECT_EQ(choose_step(scene, splitting()).parts, 64);
}

TEST(StepRule, ResolvesTheHighestModeWhereContactsAct) {
  const Scene scene = vibrating(scene_with({Circle{0.1}, {2.0}, {}}, 1000.0, Vec3(0, 2.0 * 1e6, 0)));
  expect_governed(scene, splitting(), mode_share / 1000.0, "the highest mode 1000 rad/s");
  Scene damped = scene; // whatever the dampers: r_t h = 35
  damped.contacts.front().support.friction = {1.0, 2e4 * mass, 0.3, 0.3};
  expect_governed(damped, splitting(), mode_share / 1000.0, "the highest mode 1000 rad/s");
  expect_governed(scene, euler(), eps / 1000.0, "the highest mode 1000 rad/s");
}

TEST(StepRule, ResolvesWithEulerTheDampersThatItTakesExplicitly) {
  Scene scene = scene_with({Circle{0.1}, {2.0, 4e3}, {}});
  expect_governed(scene, euler(), eps / 2000.0, "the dampers' rate 2000 1/s");
  EXPECT_EQ(choose_step(scene, splitting()).explicit_rate, 0.0);
  scene.system.damping.setConstant(3000.0);
  expect_governed(scene, euler(), eps / 3000.0, "the dampers' rate 3000 1/s");
  scene.system.damping_matrix =
      Eigen::Matrix3d{{5000.0, 3000.0, 0.0}, {3000.0, 5000.0, 0.0}, {0.0, 0.0, 1.0}};
  expect_governed(scene, euler(), eps / 8000.0, "the dampers' rate 8000 1/s");
}

TEST(StepRule, ResolvesWithEulerTheDamperOfAnOverlapAtTheStart) {
  Scene scene = scene_with({Circle{0.1}, {2.0, 0.0, 1e5}, {}}); // c(p) = 2e5 p
  EXPECT_EQ(choose_step(scene, euler()).explicit_rate, 0.0);
  start(scene, mass, Vec3(0, 0.12, 0), Vec3::Zero());
  expect_governed(scene, euler(), eps / 2000.0, "the dampers' rate 2000 1/s");
}

TEST(StepRule, GivesPointsAPeriodToTheExcitationByWhatLinesBetweenThemLose) {
  Scene linear = mass_point(mass, Vec3(2e6, 0, 0), 1000.0),
        soft = scene_with({Circle{0.1}, {2.0}, {}}, 1000.0);
  linear.loads = soft.loads = {force_on(mass, Vec3(1, 0, 0), Harmonic{1.0, 25.0})};
  expect_governed(linear, splitting(), 1.0 / (200.0 * 25.0), "excitation (25 Hz)");
  expect_governed(soft, splitting(), 1.0 / (10.0 * 25.0), "excitation (25 Hz)");
  expect_governed(soft, collocation(), 1.0 / (30.0 * 25.0), "excitation (25 Hz)");
  linear.loads = {force_on(mass, Vec3(1, 0, 0), Random{1.0, 1.0, 40.0})};
  expect_governed(linear, splitting(), 1.0 / (200.0 * 40.0), "excitation (40 Hz)");
}

TEST(StepRule, LetsSplittingMakeMacroStepsWhereModesAndLoadsAreSlow) {
  const double at_rate = share / 200.0; // s, the step that the contact asks for
  const auto macro_steps = [&](double slow, const TimeFunction& function) {
    Scene scene = scene_with({Circle{0.1}, {8e4}, {}}, 1000.0, Vec3(0, mass * slow * slow, 0));
    scene.loads = {force_on(mass, Vec3(0, 1, 0), function)};
    return choose_step(scene, splitting()).macro_steps;
  };
  EXPECT_EQ(macro_steps(0.0, Constant{1.0}), 12);
  EXPECT_EQ(macro_steps(0.5 / (5.1 * at_rate), Constant{1.0}), 5);
  EXPECT_EQ(macro_steps(0.5 / (0.9 * at_rate), Constant{1.0}), 1);
  EXPECT_EQ(macro_steps(0.0, Harmonic{1.0, 1.0 / (30.0 * 3.1 * at_rate)}), 3);
  EXPECT_EQ(macro_steps(0.0, Table{{0.0, 500.0, 1000.0}, {0.0, 1.0, 0.0}}), 1);
  Scene scene = scene_with({Circle{0.1}, {8e4}, {}});
  EXPECT_EQ(choose_step(scene, splitting(at_rate)).macro_steps, 1) << "a given step is kept to the letter";
  EXPECT_EQ(choose_step(scene, collocation()).macro_steps, 1);
  EXPECT_EQ(choose_step(scene, splitting()).macro_steps, 12);
  EXPECT_TRUE(mentions(choose_step(scene, splitting()).reason, "up to 12 of them at once"));
  scene.contacts[0].support.normal.damping = 1.0;
  EXPECT_EQ(choose_step(scene, splitting()).macro_steps, 1);
  EXPECT_FALSE(mentions(choose_step(scene, splitting()).reason, "at once"));
}

TEST(StepRule, LeavesOutLoadsThatDoNotActOnTheScene) {
  Scene scene = scene_with({Circle{0.1}, {2.0}, {}}, 1000.0);
  scene.loads = {force_on(mass, Vec3(1, 0, 0), Harmonic{1.0, 25.0})};
  const double step = choose_step(scene, splitting()).step;
  const Vec3 elsewhere = Vec3::Zero();
  scene.loads.push_back(force_on(mass, elsewhere, Harmonic{1.0, 2e4}));
  scene.loads.push_back(force_on(mass, elsewhere, Table{{0.0, 1e-3, 1000.0}, {0.0, 1.0, 1.0}}));
  EXPECT_EQ(choose_step(scene, splitting()).step, step);
}

TEST(StepRule, TakesTwentyThousandStepsAtLeastAndTwoThousandWhereTheyAreExpensive) {
  const auto expect_least = [](const Scene& scene, const char* steps) {
    const StepChoice choice = choose_step(scene, splitting());
    EXPECT_NEAR(static_cast<double>(choice.steps), std::stod(steps), 1.0);
    EXPECT_TRUE(mentions(choice.reason, std::string("at least ") + steps + " steps")) << choice.reason;
  };
  const Scene linear = mass_point(mass, Vec3(2.0, 0, 0), 3.0);
  Scene soft = scene_with({Circle{0.1}, {2.0}, {}}, 3.0);
  expect_least(linear, "20000");
  expect_least(soft, "20000");
  soft.contacts.resize(2, soft.contacts.front());
  expect_least(soft, "20000"); // s = 83
  soft.contacts.resize(5, soft.contacts.front());
  expect_least(soft, "4853"); // 2e8/203^2
  soft.contacts.resize(100, soft.contacts.front());
  expect_least(soft, "2000");
}

TEST(StepRule, LetsStatisticsSeeTheModesWithoutContacts) {
  const Scene linear = mass_point(mass, Vec3(2e6, 0, 0), 1000.0);
  expect_governed(linear, splitting(), eps * 0.6 / std::sqrt(2e6 / mass), "the highest mode");
}

TEST(StepRule, FollowsTheIntervalsOfATableButNotItsJumps) {
  Scene scene = scene_with({Circle{0.1}, {2.0}, {}}, 1000.0);
  scene.loads = {force_on(mass, Vec3(1, 0, 0), Table{{0.0, 3.0, 3.01, 3.01, 9.0}, {0, 0, 1, 2, 0}})};
  expect_governed(scene, splitting(), 0.01, "the shortest interval of a table");
  scene.loads = {
      force_on(mass, Vec3(1, 0, 0), Table{{0.0, 3.0, 3.0 + 1e-5, 9.0}, {0, 0, 1, 0}})}; // all but a jump
  EXPECT_TRUE(mentions(choose_step(scene, splitting()).reason, "at least 20000 steps"));
}

/// Sampled evenly: differences of its times are shorter and longer than the interval by round-off.
Table sine_record(double interval, double angle) {
  Table table;
  for (int k = 0; k <= 1000; ++k) {
    table.time.push_back(interval * k);
    table.value.push_back(std::sin(angle * k));
  }
  return table;
}

TEST(StepRule, ResolvesWhatTheModesSeeOfARecordHoweverCloseItsPoints) {
  Scene scene = scene_with({Circle{0.1}, {2e6}, {}}); // w_c = 1000 rad/s
  const auto choice = [&](const StepOptions& options) { return choose_step(scene, options); };
  scene.loads = {force_on(mass, Vec3(1, 0, 0), sine_record(1e-3, 0.5))}; // 500 rad/s
  EXPECT_NEAR(choice(splitting()).record_rate, 500.0, 15.0);
  EXPECT_TRUE(mentions(choice(splitting()).reason, "the band of a record"));
  scene.loads = {force_on(mass, Vec3(1, 0, 0), sine_record(1e-3, 0.3))}; // 300 rad/s
  EXPECT_TRUE(mentions(choice(splitting()).reason, "the contact frequency"));
  scene.loads = {force_on(mass, Vec3(1, 0, 0), sine_record(1e-5, 0.02))}; // 2000 rad/s
  const StepChoice fast = choice(splitting());
  EXPECT_TRUE(mentions(fast.reason, "the band of a record")) << fast.reason;
  EXPECT_EQ(fast.record_rate, fast.contact_frequency) << "faster ones move no mode and no contact";
  EXPECT_NEAR(fast.step, 1e-3, 1e-8);
  EXPECT_NEAR(choice(energy_conserving()).step, 2e-3 * 3.14159265 / 30.0, 1e-8) << "lines between values";
}

TEST(StepRule, TakesGivenStepsOfTheIntervalsOfATable) {
  Scene scene = scene_with({Circle{0.1}, {2.0}, {}}, 1.0);
  constexpr double interval = 1e-3;
  const auto warnings = [&](double step) { return choose_step(scene, splitting(step)).warnings; };
  Table few = sine_record(interval, 0.1);
  few.time.resize(20);
  few.value.resize(20);
  scene.loads = {force_on(mass, Vec3(1, 0, 0), few)};
  EXPECT_TRUE(warnings(interval * (1.0 - 1e-12)).empty());
  ASSERT_EQ(warnings(1.01 * interval).size(), 1u);
  EXPECT_TRUE(mentions(warnings(1.01 * interval)[0], "the shortest interval of a table"));
  scene = scene_with({Circle{0.1}, {2e6}, {}}, 1.0);
  scene.loads = {force_on(mass, Vec3(1, 0, 0), sine_record(interval, 0.9))};
  for (const std::string& warning : warnings(interval))
    EXPECT_FALSE(mentions(warning, "record")) << warning;
  ASSERT_FALSE(warnings(2.0 * interval).empty());
  EXPECT_TRUE(mentions(warnings(2.0 * interval).back(), "the band of a record"));
}

TEST(StepRule, RefusesStepsWithoutNumber) {
  const Scene stiff = scene_with({Circle{0.1}, {1e40}, {}});
  EXPECT_THROW((void)choose_step(stiff, splitting()), fretwork::core::Error);
  StepOptions tiny = splitting();
  tiny.step = 1e-20;
  EXPECT_THROW((void)choose_step(scene_with({Circle{0.1}, {2.0}, {}}), tiny), fretwork::core::Error);
}

/// The message of a scene that is refused.
std::string refused(const Scene& scene) {
  try {
    (void)choose_step(scene, {});
  } catch (const fretwork::core::Error& error) {
    return error.what();
  }
  return "nothing is refused";
}

// Of the scheme that would be taken: collocation, whose steps tangential dampers make short, is only weighed.
TEST(StepRule, NamesTheDurationThatIsTooLong) {
  constexpr double ten_years = 3.15e8;
  const std::string said = refused(scene_with({Circle{0.1}, {8e8}, {8e8, 3e6, 0.3, 0.3}}, ten_years));
  EXPECT_TRUE(mentions(said, "transient.duration = 3.15e+08 s (3.65e+03 days) would take ")) << said;
  EXPECT_FALSE(mentions(said, "splitting")) << said;
  EXPECT_TRUE(mentions(refused(scene_with({Circle{0.1}, {1e40}, {}})),
                       "check what the step follows from (the contact frequency"));
}

TEST(StepRule, FollowsTheAccuracyByItsSquareRoot) {
  const Scene scene = scene_with({Circle{0.1}, {8e4}, {}});
  StepOptions coarse = splitting(), fine = splitting();
  coarse.accuracy = 0.01;
  fine.accuracy = 0.000625;
  EXPECT_NEAR(choose_step(scene, coarse).step / choose_step(scene, fine).step, 4.0, 1e-4); // to whole steps
}

TEST(StepRule, SaysWhereASmallerAccuracyChangesNothing) {
  const Scene scene = scene_with({Circle{0.1}, {2.0}, {}}, 1.0); // w_c = 1 rad/s
  StepOptions fine = splitting();
  EXPECT_FALSE(mentions(choose_step(scene, fine).reason, "accuracy"));
  fine.accuracy = 1e-3;
  EXPECT_TRUE(
      mentions(choose_step(scene, fine).reason, "steps; an accuracy of 0.001 asks for no shorter ones"))
      << choose_step(scene, fine).reason;
  fine.accuracy = 1e-14;
  EXPECT_FALSE(mentions(choose_step(scene, fine).reason, "no shorter ones"));
}

TEST(StepRule, TakesNoLongerStepThanThatOfTwoPercent) {
  const Scene scene = scene_with({Circle{0.1}, {8e4}, {}});
  StepOptions two = splitting(), fifty = splitting();
  two.accuracy = 0.02;
  fifty.accuracy = 0.5;
  const StepChoice choice = choose_step(scene, fifty);
  EXPECT_EQ(choice.step, choose_step(scene, two).step);
  EXPECT_TRUE(mentions(choice.reason, "no step is longer than that of 0.02")) << choice.reason;
  EXPECT_FALSE(mentions(choose_step(scene, two).reason, "longer"));
}

TEST(StepRule, KeepsAwayFromTheResonanceOfSplitting) {
  const Scene scene = vibrating(scene_with({Circle{0.1}, {2.0}, {}}, 1000.0, Vec3(0, 2.0 * 1e6, 0)));
  for (const double accuracy : {0.001, 0.01, 0.04, 0.9}) {
    StepOptions options = splitting();
    options.accuracy = accuracy;
    EXPECT_LE(choose_step(scene, options).step * 1000.0, mode_share * (1.0 + round_off)) << accuracy;
  }
}

TEST(StepRule, MakesModesHeavierThatOnlyContactsMove) {
  const Scene scene = scene_with({Circle{0.1}, {8e4}, {}}, 1000.0, Vec3(0, 8e8, 0));
  expect_governed(scene, splitting(), beside_scaled / 200.0, "1 of 3 modes, those above");
  const StepChoice choice = choose_step(scene, splitting());
  EXPECT_NEAR(choice.fastest * choice.step, mode_share, round_off);
  EXPECT_NEAR(halved(choice).fastest * halved(choice).step, mode_share, round_off);
  EXPECT_EQ(choose_step(vibrating(scene), splitting()).fastest, 0.0);
  StepOptions fine = splitting();
  fine.accuracy = 0.0025; // half of the step: twice the frequency
  EXPECT_NEAR(choose_step(scene, fine).step / choice.step, 0.5, 1e-4);
  EXPECT_NEAR(choose_step(scene, fine).fastest * choose_step(scene, fine).step, mode_share, round_off);
  EXPECT_EQ(choose_step(scene, splitting(choice.step)).fastest, 0.0) << "a given step is kept to the letter";
  EXPECT_EQ(choose_step(scene, collocation()).fastest, 0.0);
}

/// Nothing is scaled that need not be.
TEST(StepRule, FollowsModesNotFarAboveTheContacts) {
  const auto above = [](double times) {
    return scene_with({Circle{0.1}, {8e4}, {}}, 1000.0, Vec3(0, mass * std::pow(times * 200.0, 2), 0));
  };
  expect_governed(above(0.99 * structure_at_contacts.share / share), splitting(), share / 200.0,
                  "the contact frequency 200 rad/s resolved");
  expect_governed(above(0.45), splitting(), structure_at_contacts.share / 90.0,
                  "the structure's frequency at contacts 90 rad/s resolved");
  expect_governed(above(0.99 * mode_share / contact_beside_structure.share), splitting(),
                  contact_beside_structure.share / 200.0, "the structure's frequency at contacts");
  expect_governed(above(2.1), splitting(), mode_share / 420.0, "the highest mode 420 rad/s");
  EXPECT_EQ(choose_step(above(2.1), splitting()).scaled, 0);
  const double just = scaled_above * least_gain_of_scaling;
  expect_governed(above(0.99 * just), splitting(), mode_share / (0.99 * just * 200.0), "the highest mode");
  EXPECT_EQ(choose_step(above(0.99 * just), splitting()).scaled, 0);
  expect_governed(above(1.01 * just), splitting(), beside_scaled / 200.0,
                  "modes up to 2.25 times the contact frequency 200 rad/s");
  EXPECT_EQ(choose_step(above(1.01 * just), splitting()).scaled, 1);
  const Scene sticking = scene_with({Circle{0.1}, {2.0}, {8e4, 0.0, 0.3, 0.3}}, 1000.0, Vec3(0, 8e8, 0));
  expect_governed(sticking, splitting(), beside_scaled / 200.0,
                  "modes up to 2.25 times the frequency of sticking contacts 200 rad/s");
  // a normal damper is a cause only where modes could be made heavier without it
  for (const auto& [times, rate] : {std::pair{1.9, 3200.0}, {2.5, 3200.0}, {3.0, 800.0}, {40.0, 3200.0}}) {
    Scene damped = above(times);
    damped.contacts.front().support.normal.damping = rate * mass;
    const StepChoice choice = choose_step(damped, splitting());
    EXPECT_EQ(choice.scaled, times > 10.0 ? 1 : 0) << times;
    EXPECT_EQ(mentions(choice.reason, "a smaller normal_damping"), times > just)
        << times << ": " << choice.reason;
  }
  // at a finer accuracy modes are made heavier from higher frequencies on; steps in which all are followed are no shorter for it
  StepOptions fine = splitting();
  fine.accuracy = 0.0025;
  for (const auto& [times, step] : {std::pair{2.5, 0.5 * beside_scaled / 200.0},
                                    {4.4, 0.5 * beside_scaled / 200.0},
                                    {5.0, mode_share / 1000.0},
                                    {6.0, 0.5 * beside_scaled / 200.0}}) {
    EXPECT_NEAR(choose_step(above(times), fine).step / step, 1.0, 1e-4) << times;
    EXPECT_EQ(choose_step(above(times), fine).scaled, times > 5.5 ? 1 : 0) << times;
  }
  Scene damped = above(6.0); // a damper shortens no step in which none would be made heavier
  damped.contacts.front().support.normal.damping = 2500.0 * mass;
  EXPECT_NEAR(choose_step(damped, fine).step * 1200.0 / mode_share, 1.0, 1e-4);
}

/// No automatic step is one that is warned about where it is given, whatever the accuracy.
TEST(StepRule, TakesNoStepBesideModesThatIsWarnedAbout) {
  for (const double times : {0.6, 0.9, 1.0, 1.5, 1.9, 2.2, 2.5}) {
    const Scene scene =
        scene_with({Circle{0.1}, {8e4}, {}}, 1000.0, Vec3(0, mass * std::pow(times * 200.0, 2), 0));
    for (const double accuracy : {0.001, 0.01, 0.02, 0.5}) {
      SCOPED_TRACE(testing::Message() << times << " w_c, accuracy " << accuracy);
      StepOptions options = splitting();
      options.accuracy = accuracy;
      EXPECT_TRUE(choose_step(scene, splitting(choose_step(scene, options).step)).warnings.empty());
    }
  }
}

TEST(StepRule, TakesSplittingWhereContactsLimitTheStep) {
  const StepChoice choice = choose_step(scene_with({Circle{0.1}, {8e4}, {}}), {});
  EXPECT_EQ(choice.scheme, SchemeKind::splitting);
  EXPECT_TRUE(mentions(choice.scheme_reason, "splitting; collocation would take about 3 times as long"))
      << choice.scheme_reason;
}

TEST(StepRule, TakesCollocationWhereOnlyModesFarAboveTheContactsLimitSplitting) {
  const auto above = [](double times) {
    return choose_step(
        vibrating(scene_with({Circle{0.1}, {8e4}, {}}, 1000.0, Vec3(0, 8e4 * times * times, 0))), {});
  };
  EXPECT_EQ(above(5.0).scheme, SchemeKind::splitting);
  const StepChoice far = above(100.0);
  EXPECT_EQ(far.scheme, SchemeKind::collocation);
  EXPECT_TRUE(mentions(far.scheme_reason, "collocation, which takes about 0.0")) << far.scheme_reason;
  EXPECT_TRUE(mentions(far.reason, "the contact frequency"));
  const auto beside_hunt_crossley = [](double times) {
    return choose_step(
        vibrating(scene_with({Circle{0.1}, {8e4, 0.0, 5.0}, {}}, 1000.0, Vec3(0, 8e4 * times * times, 0))),
        {});
  };
  EXPECT_EQ(beside_hunt_crossley(5.0).scheme, SchemeKind::splitting);
  EXPECT_EQ(beside_hunt_crossley(100.0).scheme, SchemeKind::collocation);
}

TEST(StepRule, TakesSplittingWhereCollocationCannotTakeTheScene) {
  Scene scene = vibrating(scene_with({Circle{0.1}, {8e4}, {}}, 1000.0, Vec3(0, 8e8, 0)));
  ASSERT_EQ(choose_step(scene, {}).scheme, SchemeKind::collocation);
  core::MotionForces& fluid = scene.system.motion;
  fluid.stiffness = fluid.damping = fluid.input = fluid.output = Eigen::MatrixXd::Zero(3, 3);
  fluid.rates = -Eigen::MatrixXd::Identity(3, 3);
  const StepChoice choice = choose_step(scene, {});
  EXPECT_EQ(choice.scheme, SchemeKind::splitting);
  EXPECT_TRUE(mentions(choice.scheme_reason,
                       "splitting, because collocation does not take forces that depend on the motion"));
}

TEST(StepRule, TakesCollocationOnlyWhereItSavesMuch) {
  // a step of both takes about as long; collocation does not measure its error
  for (const double highest : {1e6, 4e6, 8e6, 4e7, 8e8}) {
    const Scene scene = vibrating(scene_with({Circle{0.1}, {8e4}, {}}, 1000.0, Vec3(0, highest, 0)));
    StepOptions with_collocation;
    with_collocation.scheme = SchemeKind::collocation;
    const double share = static_cast<double>(choose_step(scene, with_collocation).steps) /
                         static_cast<double>(choose_step(scene, splitting()).steps);
    const SchemeKind chosen = choose_step(scene, {}).scheme;
    if (share < 0.5) {
      EXPECT_EQ(chosen, SchemeKind::collocation) << share;
    }
    if (share > 0.9) {
      EXPECT_EQ(chosen, SchemeKind::splitting) << share;
    }
  }
}

TEST(StepRule, GivesNoReasonForASchemeThatWasGiven) {
  const Scene scene = scene_with({Circle{0.1}, {8e4}, {}});
  EXPECT_TRUE(choose_step(scene, splitting()).scheme_reason.empty());
  StepOptions fixed;
  fixed.step = 1e-3;
  EXPECT_EQ(choose_step(scene, fixed).scheme, SchemeKind::splitting);
}

TEST(StepRule, HalvesAStepOrATolerance) {
  const Scene scene = scene_with({Circle{0.1}, {8e4}, {}});
  const StepChoice whole = choose_step(scene, splitting()), half = halved(whole);
  EXPECT_EQ(half.step, 0.5 * whole.step);
  EXPECT_EQ(half.steps, 2 * whole.steps);
  const StepChoice adaptive = choose_step(scene, {SchemeKind::runge_kutta_54, {}});
  EXPECT_EQ(halved(adaptive).step, adaptive.step);
  EXPECT_EQ(halved(adaptive).tolerance, 0.5 * adaptive.tolerance);
}

TEST(StepRule, NeverTakesAStepThatItWouldWarnOf) {
  for (const double damping : {0.0, 600.0, 5000.0, 5e4})
    for (const double accuracy : {0.01, 0.02, 0.04}) {
      const Scene scene = scene_with({Circle{0.1}, {8e4}, {8e4, damping, 0.3, 0.3}});
      StepOptions options = splitting();
      options.accuracy = accuracy;
      EXPECT_TRUE(choose_step(scene, splitting(choose_step(scene, options).step)).warnings.empty())
          << damping << " " << accuracy;
    }
}

TEST(StepRule, CountsAllContactsTogether) {
  // two contacts of one node act as one of twice the stiffness
  Scene scene = scene_with({Circle{0.1}, {8e4}, {8e4, 10.0, 0.3, 0.3}});
  const StepChoice one = choose_step(scene, {});
  scene.contacts.push_back(scene.contacts[0]);
  const StepChoice two = choose_step(scene, {});
  EXPECT_NEAR(two.contact_frequency / one.contact_frequency, std::sqrt(2.0), round_off);
  EXPECT_NEAR(two.stick_frequency / one.stick_frequency, std::sqrt(2.0), round_off);
  EXPECT_NEAR(two.damper_rate / one.damper_rate, 2.0, round_off);
}

TEST(StepRule, KnowsTheFrequencyOfTheStructureAtItsContacts) {
  const auto of = [](const Scene& scene) { return choose_step(scene, splitting()).structure_frequency; };
  Scene scene = scene_with({Circle{0.1}, {8e4}, {}}, 1000.0, Vec3(0, mass * 900.0, 0)); // 30 rad/s along y
  EXPECT_NEAR(of(scene), 30.0, 1e-10);
  scene.contacts.resize(5, scene.contacts[0]); // of one node
  EXPECT_NEAR(of(scene), 30.0, 1e-10);
  scene.contacts.resize(1);
  scene.contacts.push_back(scene.contacts[0]); // slow, and alone along y
  scene.contacts[0].b.row(1).setZero();
  scene.contacts[1].b.row(2).setZero();
  scene.contacts[1].support.normal.stiffness = 0.24 * 8e4;
  EXPECT_EQ(of(scene), 0.0);
  scene.contacts[1].support.normal.stiffness = 0.26 * 8e4;
  EXPECT_NEAR(of(scene), 30.0, 1e-10);
  scene.contacts[1].support.normal.stiffness = 1.0;
  scene.contacts[1].support.friction = {8e4, 0.0, 0.3, 0.3}; // a tangent across x too
  EXPECT_NEAR(of(scene), 30.0, 1e-10);
}

TEST(StepRule, LooksOnlyAlongTheDirectionsThatTheObstacleUses) {
  Scene scene = scene_with({PlanePair{0.1, PlaneAxis::y}, {8e4}, {2e4, 0.0, 0.3, 0.3}});
  scene.contacts[0].b.row(1) *= 2.0; // y: the normal
  scene.contacts[0].b.row(2) *= 3.0; // z: a tangent
  const StepChoice choice = choose_step(scene, {});
  EXPECT_NEAR(choice.contact_frequency, 2.0 * 200.0, 1e-10);
  EXPECT_NEAR(choice.stick_frequency, 3.0 * 100.0, 1e-10);
  scene.contacts[0].support.friction = {};
  EXPECT_EQ(choose_step(scene, {}).stick_frequency, 0.0);
}

TEST(StepRule, LooksOnlyAlongTheDirectionsOfFriction) {
  // a damper along x that would be fast across it, where the contact moves more easily
  Scene scene = scene_with({PlanePair{0.1, PlaneAxis::y}, {8e4}, {2e4, 100.0, 0.3, 0.3}});
  scene.contacts[0].b.row(0) *= 0.1;
  scene.contacts[0].b.row(1) *= 5.0; // the normal
  scene.contacts[0].b.row(2) *= 3.0;
  const double rate = 100.0 / mass;
  const auto along = [&](double x, double t) {
    scene.contacts[0].support.friction.along = {x, t};
    return choose_step(scene, {});
  };
  EXPECT_NEAR(along(1.0, 1.0).damper_rate, 9.0 * rate, round_off * rate);
  EXPECT_NEAR(along(0.0, 1.0).damper_rate, 9.0 * rate, round_off * rate);
  EXPECT_NEAR(along(1.0, 0.0).damper_rate, 0.01 * rate, round_off * rate);
  EXPECT_NEAR(along(1.0, 0.0).stick_frequency, 0.1 * 100.0, 1e-10);
}

TEST(StepRule, TakesSplittingForAFullDampingMatrixToo) {
  Scene scene = scene_with({Circle{0.1}, {8e4}, {}}, 1.0);
  EXPECT_EQ(choose_step(scene, {}).scheme, SchemeKind::splitting);
  scene.system.damping_matrix = Eigen::Matrix3d{{5.0, 3.0, 0.0}, {3.0, 5.0, 0.0}, {0.0, 0.0, 1.0}};
  EXPECT_EQ(choose_step(scene, {}).scheme, SchemeKind::splitting);
  EXPECT_EQ(choose_step(scene, {}).explicit_rate, 0.0);
}

TEST(StepRule, NamesItsSchemes) {
  EXPECT_EQ(name_of(SchemeKind::splitting), "splitting");
  EXPECT_EQ(name_of(SchemeKind::euler), "euler");
  EXPECT_EQ(name_of(SchemeKind::energy_conserving), "energy_conserving");
}

} // namespace step_rule_test
