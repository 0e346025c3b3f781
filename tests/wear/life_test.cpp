// SPDX-License-Identifier: GPL-3.0-or-later
#include "refusal.hpp"
#include "wear/life.hpp"
#include <array>
#include <cmath>

namespace life_test {

using namespace fretwork::wear;

namespace {

constexpr double radius = 9.525e-3, clearance = 2e-4, length = 8e-3, wall = 1.09e-3;
constexpr double bracketed = 1e-9; ///< of a time from a depth: some times the relative 1e-11 of the depth

const Pairing bar = SharedScar{FlatBar{radius, length}};
const Pairing hole = SharedScar{DrilledHole{radius, clearance, length}};

std::vector<OperatingState> always(double work_rate) { return {{1.0, work_rate}}; }

double tube_depth(const WornSupport& place, double work_rate, double time) {
  return depth_history(place, always(work_rate), std::array{time}).at(0).depth->tube;
}

} // namespace

TEST(DepthHistory, IsThatOfTheVolumes) {
  const WornSupport place{hole, Archard{2e-14}, wall, Archard{1e-14}};
  const std::array times{0.0, year, 10.0 * year};
  const auto history = depth_history(place, always(1e-3), times);
  ASSERT_EQ(history.size(), 3u);
  EXPECT_EQ(history[0].depth->total(), 0.0);
  for (std::size_t k = 1; k < 3; ++k) {
    EXPECT_EQ(history[k].time, times[k]);
    EXPECT_NEAR(history[k].tube_volume / (2e-17 * times[k]), 1.0, 1e-14);
    EXPECT_NEAR(history[k].support_volume / (1e-17 * times[k]), 1.0, 1e-14);
    EXPECT_NEAR(history[k].depth->tube / history[k].depth->support, 2.0, 1e-12);
    EXPECT_GT(history[k].depth->tube, history[k - 1].depth->tube);
  }
}

TEST(DepthHistory, SaysWhereTheGeometryEnds) {
  const WornSupport place{bar, Archard{2e-14}, wall};
  const auto history = depth_history(place, always(1e3), std::array{year, 1e6 * year});
  EXPECT_TRUE(history[0].depth.has_value() || history[0].tube_volume > 1e-6);
  EXPECT_FALSE(history[1].depth);
  EXPECT_GT(history[1].tube_volume, 0.0);
}

TEST(DepthHistory, CarriesTheInterval) {
  const WornSupport place{bar, Archard{2e-14}, wall};
  const std::array states{UncertainState{0.5, work_rate_with_error(2e-3, 5e-4)},
                          UncertainState{0.5, work_rate_between(1e-3, 2e-3, 4e-3)}};
  const DepthHistory history = depth_history(place, states, std::array{5.0 * year});
  EXPECT_FALSE(history.outside);
  EXPECT_EQ(history.value[0].depth->tube, tube_depth(place, 2e-3, 5.0 * year));
  EXPECT_NEAR(history.low[0].depth->tube, tube_depth(place, 1.25e-3, 5.0 * year), 1e-15);
  EXPECT_NEAR(history.high[0].depth->tube, tube_depth(place, 3.25e-3, 5.0 * year), 1e-15);
}

TEST(DepthHistory, SaysWhereALawDoesNotApply) {
  const WornSupport place{bar, EdfMz{}, wall};
  std::optional<OutsideLaw> outside;
  EXPECT_TRUE(depth_history(place, always(2e-3), std::array{year}, &outside).empty());
  ASSERT_TRUE(outside);
  EXPECT_EQ(outside->law, "edf_mz");
  EXPECT_TRUE(depth_history(place, always(2e-3), std::array{year}).empty()); // unasked
  const std::array low_end{UncertainState{1.0, work_rate_with_error(5e-3, 4e-3)}};
  const DepthHistory history = depth_history(place, low_end, std::array{year});
  EXPECT_EQ(history.value.size(), 1u);
  EXPECT_TRUE(history.low.empty());
  EXPECT_EQ(history.high.size(), 1u);
  EXPECT_TRUE(history.outside);
}

TEST(TimeToLimit, OfArchardIsTheVolumeOverTheRate) {
  for (const auto& pairing : {bar, hole, Pairing(SectorPair{{radius, length, 0.5}, {radius, length, 0.5}})})
    for (const double limit : {0.1, 0.4, 1.0}) {
      const WornSupport place{pairing, Archard{2e-14}, wall, Archard{0.0}, limit};
      const auto life = time_to_limit(place, always(2e-3)).tube;
      EXPECT_EQ(life.end, LifeEnd::reached);
      EXPECT_NEAR(tube_depth(place, 2e-3, life.time) / (limit * wall), 1.0, bracketed);
      // twice the work: half the life
      EXPECT_NEAR(time_to_limit(place, always(4e-3)).tube.time / life.time, 0.5, bracketed);
    }
}

TEST(TimeToLimit, OfBothBodiesIsReachedByTheTubesShare) {
  // equal coefficients: at p_t = limit the scar is twice as deep
  const WornSupport both{bar, Archard{2e-14}, wall, Archard{2e-14}};
  const double twice = volume(FlatBar{radius, length}, 0.8 * wall) / (2.0 * 2e-14 * 2e-3);
  EXPECT_NEAR(time_to_limit(both, always(2e-3)).tube.time / twice, 1.0, bracketed);
  const WornSupport mixed{hole, EdfMz{}, wall, Archard{1e-15}};
  const auto life = time_to_limit(mixed, always(5e-3)).tube;
  ASSERT_EQ(life.end, LifeEnd::reached);
  EXPECT_NEAR(tube_depth(mixed, 5e-3, life.time) / (0.4 * wall), 1.0, bracketed);
  EXPECT_LT(tube_depth(mixed, 5e-3, 0.99 * life.time), 0.4 * wall);
}

TEST(TimeToLimit, OfTheSupportIsLikewise) {
  WornSupport place{bar, Archard{2e-14}, wall, Archard{1e-14}};
  EXPECT_FALSE(time_to_limit(place, always(2e-3)).support);
  place.support_limit = 0.2 * wall; // half of the tube's: reached at the same time
  const auto lives = time_to_limit(place, always(2e-3));
  ASSERT_TRUE(lives.support);
  EXPECT_NEAR(lives.support->time / lives.tube.time, 1.0, bracketed);
  place.support = Archard{0.0};
  EXPECT_EQ(time_to_limit(place, always(2e-3)).support->end, LifeEnd::never);
}

TEST(TimeToLimit, MayBeNever) {
  const WornSupport place{bar, Archard{2e-14}, wall};
  const auto idle = time_to_limit(place, always(0.0)).tube;
  EXPECT_EQ(idle.end, LifeEnd::never);
  EXPECT_TRUE(std::isinf(idle.years()));
  const EdfMz ending{1e-13, 1.2, 2.44e-8, 0.0}; // wears 1e-13 W^1.2/n in all
  const auto all = [&](double work_rate) { return 1e-13 * std::pow(work_rate, 1.2) / 2.44e-8; };
  const double wanted = volume(FlatBar{radius, length}, 0.4 * wall);
  ASSERT_LT(all(5e-3), wanted);
  ASSERT_GT(all(5e-2), wanted);
  EXPECT_EQ(time_to_limit({bar, ending, wall}, always(5e-3)).tube.end, LifeEnd::never);
  EXPECT_EQ(time_to_limit({bar, ending, wall}, always(5e-2)).tube.end, LifeEnd::reached);
  // alone the tube would reach it, with a support that takes its share it stops short
  const WornSupport shared{bar, EdfMz{4e-13, 1.2, 2.44e-8, 0.0}, wall, EdfMz{4e-13, 1.2, 2.44e-8, 0.0}};
  const double work_rate =
      5e-3 * std::pow(wanted / all(5e-3) / 4.0 * 1.01, 1.0 / 1.2); // 1 % more than the tube needs
  EXPECT_EQ(time_to_limit({bar, EdfMz{4e-13, 1.2, 2.44e-8, 0.0}, wall}, always(work_rate)).tube.end,
            LifeEnd::reached);
  EXPECT_EQ(time_to_limit(shared, always(work_rate)).tube.end, LifeEnd::never);
}

TEST(TimeToLimit, MayBeBeyondTheGeometry) {
  // a support that wears 1000 times faster than the tube: the scar is as deep as the tube's radius before
  const WornSupport place{bar, Archard{1e-16}, wall, Archard{1e-13}};
  const auto life = time_to_limit(place, always(2e-3)).tube;
  EXPECT_EQ(life.end, LifeEnd::beyond_geometry);
  EXPECT_TRUE(std::isnan(life.time));
}

TEST(TimeToLimit, OutsideTheLawHasNoTime) {
  const WornSupport place{bar, EdfMz{}, wall, Archard{0.0}, 0.4, 1e-4};
  const auto lives = time_to_limit(place, always(2e-3));
  EXPECT_EQ(lives.tube.end, LifeEnd::outside_law);
  EXPECT_EQ(lives.support->end, LifeEnd::outside_law);
  ASSERT_TRUE(lives.tube.outside);
  EXPECT_NE(lives.tube.outside->text.find("edf_mz does not apply"), std::string::npos);
  EXPECT_TRUE(std::isnan(lives.tube.time));
  const WornSupport support_outside{bar, Archard{1e-14}, wall, EdfMz{}};
  EXPECT_EQ(time_to_limit(support_outside, always(2e-3)).tube.end, LifeEnd::outside_law);
}

TEST(TimeToLimit, CarriesTheInterval) {
  const WornSupport place{bar, Archard{2e-14}, wall};
  const std::array states{UncertainState{1.0, work_rate_with_error(2e-3, 1e-3)}};
  const Life life = time_to_limit(place, states);
  EXPECT_NEAR(life.at_low.tube.time / life.value.tube.time, 2.0, bracketed);
  EXPECT_NEAR(life.at_high.tube.time / life.value.tube.time, 2.0 / 3.0, bracketed);
  const std::array down_to_zero{UncertainState{1.0, work_rate_with_error(1e-3, 2e-3)}};
  EXPECT_EQ(time_to_limit(place, down_to_zero).at_low.tube.end, LifeEnd::never);
}

// From its initial depth a tube goes on as one of the age at which the same work rates have worn it as deep.
TEST(InitialWear, IsOnTheCurveOfTheWorkRates) {
  const WornSupport places[] = {
      {bar, Archard{2e-14}, wall},
      {hole, Archard{2e-14}, wall, Archard{1e-14}, 0.4, 0.2 * wall},
      {hole, EdfMz{}, wall, Archard{1e-15}},
      {SectorPair{{radius, length, 0.5}, {radius, length, 0.5}}, Archard{2e-14}, wall}};
  for (const WornSupport& fresh : places) {
    const BodyLives from_new = time_to_limit(fresh, always(5e-3));
    WornSupport worn = fresh;
    worn.initial_depth = 0.2 * wall;
    WornSupport to_initial = fresh;
    to_initial.limit = 0.2;
    const double age = time_to_limit(to_initial, always(5e-3)).tube.time;
    const BodyLives lives = time_to_limit(worn, always(5e-3));
    EXPECT_EQ(lives.tube.end, LifeEnd::reached);
    EXPECT_NEAR((age + lives.tube.time) / from_new.tube.time, 1.0, bracketed);
    if (lives.support) {
      EXPECT_NEAR((age + lives.support->time) / from_new.support->time, 1.0, bracketed);
    }
    const auto history = depth_history(worn, always(5e-3), std::array{0.0, year, 3.0 * year});
    EXPECT_NEAR(history[0].depth->tube / (0.2 * wall), 1.0, bracketed);
    for (const DepthAt& at : history) {
      const DepthAt then = depth_history(fresh, always(5e-3), std::array{age + at.time}).at(0);
      EXPECT_NEAR(at.tube_volume / then.tube_volume, 1.0, bracketed);
      EXPECT_NEAR(at.depth->tube / then.depth->tube, 1.0, bracketed);
      EXPECT_NEAR(at.depth->support, then.depth->support, bracketed * wall);
    }
  }
}

TEST(InitialWear, StaysWhereNothingWears) {
  WornSupport place{bar, Archard{2e-14}, wall};
  place.initial_depth = 0.2 * wall;
  const auto history = depth_history(place, always(0.0), std::array{0.0, 40.0 * year});
  EXPECT_NEAR(history[1].depth->tube / (0.2 * wall), 1.0, bracketed);
  EXPECT_EQ(history[1].tube_volume, volume(FlatBar{radius, length}, 0.2 * wall));
  EXPECT_EQ(time_to_limit(place, always(0.0)).tube.end, LifeEnd::never);
  // a law that ends before: the tube wears on from the volume of its depth
  place.tube = EdfMz{1e-14, 1.2, 2.44e-8, 0.0};
  const double in_all = 1e-14 * std::pow(5e-3, 1.2) / 2.44e-8,
               before = volume(FlatBar{radius, length}, 0.2 * wall);
  ASSERT_LT(in_all, before);
  EXPECT_NEAR(depth_history(place, always(5e-3), std::array{1e4 * year})[0].tube_volume / (before + in_all),
              1.0, bracketed);
}

TEST(InitialWear, AtTheLimitLeavesNoLife) {
  WornSupport place{bar, Archard{2e-14}, wall, Archard{1e-14}};
  for (const double depth : {0.4, 0.5}) {
    place.initial_depth = depth * wall;
    const TimeToLimit life = time_to_limit(place, always(2e-3)).tube;
    EXPECT_EQ(life.end, LifeEnd::reached) << depth;
    EXPECT_EQ(life.time, 0.0) << depth;
  }
  place.tube = EdfMz{}; // outside its law too
  EXPECT_EQ(time_to_limit(place, always(2e-3)).tube.time, 0.0);
}

TEST(InitialWear, IsThatOfEachEndOfTheInterval) {
  WornSupport place{bar, Archard{2e-14}, wall};
  place.initial_depth = 0.1 * wall;
  const std::array states{UncertainState{1.0, work_rate_with_error(2e-3, 1e-3)}};
  const DepthHistory history = depth_history(place, states, std::array{0.0, year});
  EXPECT_NEAR(history.low[0].depth->tube / history.high[0].depth->tube, 1.0, bracketed);
  EXPECT_LT(history.low[1].depth->tube, history.value[1].depth->tube);
  EXPECT_LT(history.value[1].depth->tube, history.high[1].depth->tube);
  const Life life = time_to_limit(place, states);
  EXPECT_NEAR(life.at_low.tube.time / life.value.tube.time, 2.0, bracketed);
  EXPECT_NEAR(initial_wear(place, states)->age, volume(FlatBar{radius, length}, 0.1 * wall) / (2e-14 * 2e-3),
              bracketed * year);
}

TEST(WornSupport, IsRefusedWhereItMakesNoSense) {
  const auto refused = [](const WornSupport& place, std::initializer_list<const char*> parts) {
    expect_refused([&] { check(place); }, parts);
  };
  refused({bar, Archard{1e-14}, 0.0}, {"wear: wall thickness = 0 m"});
  refused({bar, Archard{1e-14}, wall, Archard{0.0}, 0.0}, {"limit = 0 is no share of the wall", "at most 1"});
  refused({bar, Archard{1e-14}, wall, Archard{0.0}, 1.1}, {"limit = 1.1"});
  refused({bar, Archard{1e-14}, wall, Archard{0.0}, 0.4, 0.0}, {"limit of the support = 0 m"});
  refused({bar, Archard{1e-14}, 0.03}, {"a limit of 0.012 m is beyond the 0.009525 m"});
  refused({bar, Archard{1e-14}, wall, Archard{0.0}, 0.4, 0.02}, {"a limit of 0.02 m is beyond"});
  refused({SharedScar{DrilledHole{radius, clearance, length, 0.01}, Form::reference}, Archard{1e-14}, wall},
          {"beyond the 8e-05 m", "exact form"});
  refused({bar, Archard{1e-14}, wall, Archard{0.0}, 0.4, {}, -1e-4}, {"initial depth = -0.0001 m"});
  refused({bar, Archard{1e-14}, wall, Archard{0.0}, 0.4, {}, 0.02},
          {"an initial depth of 0.02 m is beyond the 0.009525 m"});
  refused({bar, Archard{-1.0}, wall}, {"archard: coefficient"});
  refused({bar, Archard{1.0}, wall, Archard{-1.0}}, {"archard: coefficient"});
  refused({SharedScar{FlatBar{0.0, 1.0}}, Archard{1.0}, wall}, {"flat bar"});
  const WornSupport place{bar, Archard{1e-14}, wall};
  expect_refused([&] { (void)depth_history(place, always(1.0), std::array{-1.0}); }, {"time = -1 s"});
  expect_refused([&] { (void)time_to_limit(place, std::span<const OperatingState>{}); },
                 {"no operating state"});
}

} // namespace life_test
