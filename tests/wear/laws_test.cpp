// SPDX-License-Identifier: GPL-3.0-or-later
#include "refusal.hpp"
#include "wear/laws.hpp"
#include <array>
#include <cmath>
#include <limits>

namespace laws_test {

using namespace fretwork::wear;

namespace {

constexpr double round_off = 1e-14;
constexpr double inverted = 1e-12; ///< of a time from its volume
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

void expect_states_refused(std::initializer_list<OperatingState> states,
                           std::initializer_list<const char*> parts) {
  const std::vector<OperatingState> list(states);
  expect_refused([&] { check(list); }, parts);
}

} // namespace

TEST(Archard, IsProportionalToWorkAndTime) {
  const WornVolume worn = *worn_volume(Archard{2e-14}, 3e-3).volume;
  EXPECT_NEAR(worn.at(year), 2e-14 * 3e-3 * year, round_off * worn.at(year));
  EXPECT_EQ(worn.at(0.0), 0.0);
  EXPECT_NEAR(*worn.time_of(worn.at(7.0 * year)), 7.0 * year, round_off * year * 10.0);
}

TEST(Archard, WithoutWorkOrCoefficientNeverWears) {
  for (const auto& result : {worn_volume(Archard{2e-14}, 0.0), worn_volume(Archard{0.0}, 1.0)}) {
    ASSERT_TRUE(result.volume);
    EXPECT_EQ(result.volume->at(40.0 * year), 0.0);
    EXPECT_FALSE(result.volume->time_of(1e-12));
    EXPECT_EQ(result.volume->time_of(0.0), 0.0);
  }
}

TEST(Archard, TakesTheMeanOfItsStates) {
  const std::array states{OperatingState{0.5, 1e-3}, OperatingState{0.3, 4e-3}, OperatingState{0.2, 0.0}};
  EXPECT_NEAR(worn_volume(Archard{1e-14}, states).volume->at(1.0) / 1.7e-17, 1.0, round_off);
}

TEST(EdfMz, GoesFromItsInitialToItsFinalRate) {
  const EdfMz law;
  const WornVolume worn = *worn_volume(law, 5e-3).volume;
  const double v0 = 1e-13 * std::pow(5e-3, 1.2);
  constexpr double expanded = 1e-6; // n t/2 at the first, exp(-n t) n t at the second
  EXPECT_NEAR(worn.at(1.0) / v0, 1.0, expanded);
  const double late = 1e4 * year;
  EXPECT_NEAR((worn.at(2.0 * late) - worn.at(late)) / (law.s * late), 1.0, expanded);
  EXPECT_NEAR(worn.at(1e-200) / (v0 * 1e-200), 1.0, round_off);
}

TEST(EdfMz, IsInvertedOverDecades) {
  const WornVolume worn = *worn_volume(EdfMz{}, 5e-3).volume;
  for (double time = 1e-6; time < 1e6 * year; time *= 10.0)
    EXPECT_NEAR(*worn.time_of(worn.at(time)) / time, 1.0, inverted) << time;
  // on its own limit, rates that do not change
  const WornVolume steady = *worn_volume(EdfMz{1e-13, 1.0, 2e-8, 1e-13}, 1.0).volume;
  EXPECT_NEAR(*steady.time_of(steady.at(year)) / year, 1.0, inverted);
}

TEST(EdfMz, WithoutFinalRateNeverPassesItsLimit) {
  const WornVolume worn = *worn_volume(EdfMz{1e-13, 1.2, 2.44e-8, 0.0}, 0.5).volume;
  const double all = 1e-13 * std::pow(0.5, 1.2) / 2.44e-8;
  EXPECT_NEAR(worn.at(1e5 * year) / all, 1.0, round_off);
  EXPECT_FALSE(worn.time_of(all * (1.0 + 1e-12)));
  EXPECT_NEAR(worn.at(*worn.time_of(0.5 * all)) / all, 0.5, inverted);
}

TEST(EdfMz, DoesNotApplyBelowItsLeastWorkRate) {
  const EdfMz law;
  const double least = least_work_rate(law);
  EXPECT_TRUE(worn_volume(law, least * 1.000001).volume);
  const LawResult below = worn_volume(law, least * 0.999999);
  EXPECT_FALSE(below.volume);
  ASSERT_TRUE(below.outside);
  EXPECT_EQ(below.outside->law, "edf_mz");
  EXPECT_EQ(below.outside->quantity, "V0");
  EXPECT_LT(below.outside->value, below.outside->least);
  EXPECT_EQ(below.outside->least, law.s);
  const std::string text = worn_volume(law, 2e-3).outside->text;
  for (const char* part :
       {"edf_mz does not apply", "A W^b = 5.771e-17", "S = 1.14e-16", "at least 0.003527 W", "archard"})
    EXPECT_NE(text.find(part), std::string::npos) << text;
  // the states together decide, not each of them
  EXPECT_TRUE(worn_volume(law, std::array{OperatingState{0.5, 0.0}, OperatingState{0.5, 2e-2}}).volume);
}

TEST(KwuEpri, WeighsTheWorkByItsIndex) {
  const std::array states{OperatingState{0.25, 4e-3, ImpactSliding{3.0, 1.0}},
                          OperatingState{0.5, 2e-3, ImpactSliding{0.5, 0.5}}, OperatingState{0.25, 0.0}};
  // I = 1/4 and 1/4
  EXPECT_NEAR(worn_volume(KwuEpri{1e-14}, states).volume->at(1.0) / (1e-14 * 0.25 * 2e-3), 1.0, round_off);
  const std::array no_motion{OperatingState{1.0, 1e-3, ImpactSliding{0.0, 0.0}}};
  EXPECT_EQ(worn_volume(KwuEpri{1e-14}, no_motion).volume->at(1.0), 0.0);
}

TEST(KwuEpri, DoesNotApplyWhereSlidingPrevails) {
  const std::array states{OperatingState{0.5, 4e-3, ImpactSliding{3.0, 1.0}},
                          OperatingState{0.5, 4e-3, ImpactSliding{1.0, 3.0}}};
  const LawResult result = worn_volume(KwuEpri{1e-14}, states);
  EXPECT_FALSE(result.volume);
  ASSERT_TRUE(result.outside);
  EXPECT_EQ(result.outside->state, 1u);
  EXPECT_EQ(result.outside->value, 1.0);
  EXPECT_EQ(result.outside->least, 3.0);
  EXPECT_NE(result.outside->text.find("state 2 the impact index Si = 1 is below the sliding index Sg = 3"),
            std::string::npos)
      << result.outside->text;
}

TEST(Laws, HaveTheirNames) {
  EXPECT_EQ(name_of(Archard{1e-14}), "archard");
  EXPECT_EQ(name_of(EdfMz{}), "edf_mz");
  EXPECT_EQ(name_of(KwuEpri{1e-14}), "kwu_epri");
}

TEST(Laws, RefuseConstantsThatMakeNoSense) {
  expect_refused([] { check(Archard{-1e-14}); }, {"archard: coefficient = -1e-14 m2/N", ">= 0"});
  expect_refused([] { check(KwuEpri{not_a_number}); }, {"kwu_epri: coefficient = nan"});
  expect_refused([] { check(EdfMz{0.0}); }, {"edf_mz: a = 0", "> 0"});
  expect_refused([] { check(EdfMz{1e-13, -1.0}); }, {"edf_mz: b = -1"});
  expect_refused([] { check(EdfMz{1e-13, 1.2, 0.0}); }, {"edf_mz: n = 0 1/s"});
  expect_refused([] { check(EdfMz{1e-13, 1.2, 1e-8, -1.0}); }, {"edf_mz: s = -1 m3/s"});
  expect_refused([] { (void)worn_volume(Archard{1e-14}, -1.0); }, {"work rate = -1 W"});
  expect_refused([] { (void)worn_volume(KwuEpri{1e-14}, 1e-3); },
                 {"kwu_epri: operating state 1 has no impact and sliding indices", "archard"});
  const auto with = [](ImpactSliding indices) {
    return [=] { (void)worn_volume(KwuEpri{1e-14}, std::array{OperatingState{1.0, 1e-3, indices}}); };
  };
  expect_refused(with({-1.0, 0.0}), {"impact index Si = -1"});
  expect_refused(with({1.0, not_a_number}), {"sliding index Sg = nan"});
}

TEST(OperatingStates, AreRefusedWhereTheyMakeNoSense) {
  expect_states_refused({}, {"no operating state", "share of the time"});
  expect_states_refused({{0.7, 1e-3}, {0.2, 1e-3}}, {"2 operating states sum to 0.9, not to 1", "at rest"});
  expect_states_refused({{1.1, 1e-3}, {-0.1, 1e-3}}, {"operating state 2: share of the time = -0.1"});
  expect_states_refused({{1.0, not_a_number}}, {"operating state 1: work rate = nan W"});
}

} // namespace laws_test
