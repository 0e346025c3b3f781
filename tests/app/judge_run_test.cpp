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

/// Of a run that was given 1 J and lost so much by friction, its residual relative to the scale.
std::vector<std::string> warnings(double lost, double residual_relative, double stored = 0.0,
                                  double contact_damping = 0.0) {
  transient::Report report;
  report.energy.load_work = 1.0;
  report.energy.friction = lost;
  report.energy.stored = stored;
  report.energy.contact_damping = contact_damping;
  report.energy.scale = 200.0; // pushed to and fro
  report.residual_relative = residual_relative;
  results::RunResults out;
  app::judge_run({}, {}, {}, report, out);
  return out.warnings;
}

} // namespace

TEST(JudgeRun, WarnsOfEnergyThatNothingPutIn) {
  EXPECT_THAT(warnings(1.0, 1e-9), IsEmpty());
  EXPECT_THAT(warnings(1.009, 4e-3), IsEmpty());
  EXPECT_THAT(warnings(2.5, 4e-3),
              ElementsAre("of the energy dissipated and stored 60 % is in excess, which nothing supplied; a "
                          "sound run is balanced to 1 %; take a smaller step"));
  EXPECT_THAT(warnings(2.5, 4e-4), IsEmpty()); // next to what goes to and fro
  EXPECT_THAT(warnings(0.0, 4e-3, 1.25), ElementsAre(HasSubstr("stored 20 % is in excess")));
  EXPECT_THAT(warnings(0.1, 4e-3), IsEmpty()); // of what goes to and fro nothing is left to judge by
  EXPECT_THAT(warnings(1.0, 0.0099), IsEmpty());
  EXPECT_THAT(
      warnings(1.0, 0.012),
      ElementsAre("the energy balance is off by 1.2 % of the energy put in; a sound run is balanced to "
                  "1 %; take a smaller step"));
  EXPECT_THAT(warnings(2.5, 0.02), ElementsAre(HasSubstr("stored 60 % is in excess")));
  EXPECT_THAT(warnings(2.5, 0.2), ElementsAre(HasSubstr("off by 20 % of the energy put in")));
}

TEST(JudgeRun, WarnsOfEnergyThatNothingTook) {
  EXPECT_THAT(warnings(0.5, 4e-3, 0.495), IsEmpty());
  EXPECT_THAT(warnings(0.5, 4e-3, 0.48),
              ElementsAre("of the energy dissipated and stored 2 % is missing, which nothing took; a sound "
                          "run is balanced to 1 %; take a smaller step"));
}

TEST(JudgeRun, WarnsOfDampersThatGiveEnergy) {
  EXPECT_THAT(warnings(1.005, 1e-9, 0.0, -0.005), IsEmpty());
  EXPECT_THAT(warnings(1.2, 1e-9, 0.0, -0.2), ElementsAre(HasSubstr("gave 20 % of the energy put in")));
}

} // namespace judge_run_test
