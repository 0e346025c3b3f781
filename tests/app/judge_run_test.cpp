// SPDX-License-Identifier: GPL-3.0-or-later
// Warnings of the energies that a run ends with.
#include "app/judge_run.hpp"
#include <gmock/gmock.h>

namespace judge_run_test {

using namespace fretwork;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

namespace {

/// Of a run that was given 1 J and lost so much by friction; loads pushed `scale` to and fro. The residual that it ends with is its largest.
std::vector<std::string> warnings(double lost, double scale, const transient::Energy& other = {},
                                  bool given_step = false) {
  transient::Report report;
  report.energy = other;
  report.energy.load_work = 1.0;
  report.energy.friction = lost;
  report.energy.scale = scale;
  report.residual_relative = std::abs(report.energy.residual()) / scale;
  study::Study study;
  if (given_step)
    study.transient.emplace().step = 1e-4;
  results::RunResults out;
  app::judge_run(study, {}, {}, report, out);
  return out.warnings;
}

} // namespace

TEST(JudgeRun, WarnsOfEnergyThatNothingPutIn) {
  EXPECT_THAT(warnings(1.0, 200.0), IsEmpty());
  EXPECT_THAT(warnings(1.009, 2.0), IsEmpty());
  EXPECT_THAT(warnings(2.5, 200.0),
              ElementsAre("the energy balance has an excess of 60 % of the energy dissipated and stored; a "
                          "sound run is balanced to 1 %; set a smaller transient.accuracy"));
  EXPECT_THAT(warnings(1.15, 200.0), IsEmpty()); // next to what goes to and fro
  EXPECT_THAT(warnings(2.5, 100.0), ElementsAre(HasSubstr("an excess of 60 %")));
  EXPECT_THAT(warnings(2.5, 10.0), ElementsAre(HasSubstr("off by 15 % of the energy put in")));
}

TEST(JudgeRun, WarnsOfEnergyThatIsLacking) {
  EXPECT_THAT(warnings(0.992, 2.0), IsEmpty());
  EXPECT_THAT(warnings(0.5, 100.0, {.stored = 0.48}, true),
              IsEmpty()); // 0.02 J: next to what goes to and fro
  EXPECT_THAT(warnings(0.5, 5.0, {.stored = 0.48}, true),
              ElementsAre("the energy balance lacks 2.04 % of the energy dissipated and stored; a sound run "
                          "is balanced to 1 %; take a smaller step"));
  // a preload is none that the motion takes up
  EXPECT_THAT(warnings(0.5, 900.0, {.initial = 899.0, .stored = 899.48}),
              ElementsAre(HasSubstr("lacks 2.04 %")));
  EXPECT_THAT(warnings(0.5, 3000.0, {.initial = 2999.0, .stored = 2999.48}), IsEmpty());
}

TEST(JudgeRun, HoldsABalanceWithoutLossesAgainstWhatIsPutInAlone) {
  EXPECT_THAT(warnings(0.0, 200.0, {.stored = 1.25}), IsEmpty()); // the motion may have come to rest
  EXPECT_THAT(warnings(0.0, 20.0, {.stored = 1.25}),
              ElementsAre("the energy balance is off by 1.25 % of the energy put in; a sound run is balanced "
                          "to 1 %; set a smaller transient.accuracy"));
}

TEST(JudgeRun, WarnsOfDampersThatGiveEnergy) {
  EXPECT_THAT(warnings(1.005, 1e3, {.contact_damping = -0.005}), IsEmpty());
  EXPECT_THAT(warnings(1.2, 1e3, {.contact_damping = -0.2}),
              ElementsAre(HasSubstr("gave 20 % of the energy put in")));
}

} // namespace judge_run_test
