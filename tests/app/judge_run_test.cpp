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

/// An entry of Hunt and Crossley's law with a restitution of 0.7 at 0.1 m/s.
study::Contact entry(const std::string& name) {
  study::Contact out;
  out.name = name;
  out.normal_damper = study::NormalDamper::hunt_crossley;
  out.restitution = study::Restitution{0.7, std::nullopt, 0.1};
  return out;
}

post::ContactSummary impacts(std::int64_t number, double rms) {
  post::ContactSummary out;
  out.impacts = number;
  out.impact_velocity_rms = rms;
  return out;
}

/// Of one contact of each entry.
std::vector<std::string> of_restitution(const study::Study& study, const std::vector<std::size_t>& entries,
                                        std::vector<post::ContactSummary> summaries) {
  results::RunResults out;
  out.contact_summaries = std::move(summaries);
  std::vector<app::PlacedContact> placed(entries.size());
  for (std::size_t c = 0; c < entries.size(); ++c)
    placed[c].entry = entries[c];
  app::judge_restitution(study, placed, out);
  return out.warnings;
}

} // namespace

TEST(JudgeRun, WarnsOfAnotherRestitutionThanAskedFor) {
  study::Study study;
  study.contacts = {entry("a"), entry("b")};
  const std::string of_a = "contact \"a\": the rms impact velocity is 0.5 m/s, 5 times",
                    of_b = "contact \"b\"";
  EXPECT_THAT(of_restitution(study, {0, 1}, {impacts(10, 0.5), impacts(10, 0.11)}),
              ElementsAre(HasSubstr(of_a)));
  EXPECT_THAT(of_restitution(study, {0, 1}, {impacts(10, 0.5), impacts(10, 0.5)}),
              ElementsAre(HasSubstr(of_a), HasSubstr(of_b)));
  EXPECT_THAT(of_restitution(study, {0, 1}, {impacts(10, 0.5), impacts(10, 0.01)}),
              ElementsAre(HasSubstr(of_a)))
      << "4e-4 of the energy of the impacts";
  EXPECT_THAT(of_restitution(study, {0, 0}, {impacts(10, 0.0), impacts(10, 0.5)}),
              ElementsAre(HasSubstr("is 0.354 m/s"))); // over both points
  EXPECT_THAT(of_restitution(study, {0, 1}, {{}, {}}), IsEmpty()) << "without impacts";
  study.contacts[0].normal_damper = study::NormalDamper::reference;
  study.contacts[1].restitution->value = 1.0; // elastic at every velocity
  EXPECT_THAT(of_restitution(study, {0, 1}, {impacts(10, 0.5), impacts(10, 0.5)}), IsEmpty());
}

TEST(JudgeRun, WarnsOfEnergyThatNothingPutIn) {
  EXPECT_THAT(warnings(1.0, 1e-9), IsEmpty());
  EXPECT_THAT(warnings(1.05, 4e-3), IsEmpty());
  EXPECT_THAT(warnings(2.5, 4e-3), ElementsAre(HasSubstr("an excess of 60 % of the energy dissipated")));
  EXPECT_THAT(warnings(2.5, 4e-4), IsEmpty());      // next to what goes to and fro
  EXPECT_THAT(warnings(0.0, 4e-3, 1.1), IsEmpty()); // without losses
  EXPECT_THAT(warnings(2.5, 0.2), ElementsAre(HasSubstr("off by 20 % of the energy put in")));
}

TEST(JudgeRun, WarnsOfDampersThatGiveEnergy) {
  EXPECT_THAT(warnings(1.005, 1e-9, 0.0, -0.005), IsEmpty());
  EXPECT_THAT(warnings(1.2, 1e-9, 0.0, -0.2), ElementsAre(HasSubstr("gave 20 % of the energy put in")));
}

} // namespace judge_run_test
