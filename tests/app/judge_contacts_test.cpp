// SPDX-License-Identifier: GPL-3.0-or-later
// Warnings of contacts whose laws are not what their study means.
#include "app/judge_contacts.hpp"
#include <gmock/gmock.h>

namespace judge_contacts_test {

using namespace fretwork;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

namespace {

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

/// Of a run whose modes lose 1 J and whose contact, half of a support, dissipates so much by its dampers in the window, the second half.
struct Pressed {
  study::Study study;
  std::vector<app::PlacedContact> placed{1};
  std::vector<app::BuiltScene> scenes{1};
  results::RunResults out;

  Pressed() {
    study.contacts.resize(1);
    study.contacts[0].name = "grid";
    study.transient.emplace().duration = 4.0;
    study.output.statistics_from = 2.0;
    placed[0].share = 0.5;
    transient::ContactPoint point;
    point.support.friction = {5e4, 500.0, 0.3, 0.3}; // of the point
    scenes[0].scene.contacts = {point};
    scenes[0].contacts = {0};
    post::ContactSummary of;
    of.contact_time_ratio = of.sticking_ratio = 1.0;
    out.contact_summaries = {of};
    transient::Report report;
    report.energy.modal_damping = 1.0;
    out.transients = {{{}, report}};
  }
  std::vector<std::string> warnings(double damping) {
    out.contact_summaries[0].damping_work = damping;
    out.transients[0].report.energy.contact_damping = 2.0 * damping;
    out.warnings.clear();
    app::judge_stuck_dampers(study, placed, scenes, out);
    return out.warnings;
  }
};

/// Of a contact with friction under two random base motions.
std::vector<std::string> of_sliding(std::uint64_t seed, double normal_rms, double work_rate,
                                    double friction = 0.3) {
  study::Study study;
  study.contacts = {entry("a")};
  study.contacts[0].friction_dynamic = friction;
  study.base_motions = {{{1, 0, 0}, signals::Random{1, 5, 50, 1}, {}, {}},
                        {{0, 1, 0}, signals::Random{1, 5, 50, seed}, {}, {}}};
  post::ContactSummary summary;
  summary.normal_rms = normal_rms;
  summary.work_rate = work_rate;
  results::RunResults out;
  out.contact_summaries = {summary};
  app::judge_sliding(study, std::vector<app::PlacedContact>(1), out);
  return out.warnings;
}

} // namespace

TEST(JudgeContacts, WarnsOfImpactsAlongOneLineUnderOneSignal) {
  EXPECT_THAT(of_sliding(1, 5.0, 0.0),
              ElementsAre(AllOf(HasSubstr("no contact slides, though contacts have friction"),
                                HasSubstr("[[base_motion]] entry 1 and [[base_motion]] entry 2 follow one "
                                          "random signal: they have the same seed 1 and band"))));
  EXPECT_THAT(of_sliding(2, 5.0, 0.0), IsEmpty()) << "two signals";
  EXPECT_THAT(of_sliding(1, 5.0, 1e-9), IsEmpty()) << "it slides";
  EXPECT_THAT(of_sliding(1, 0.0, 0.0), IsEmpty()) << "nothing touches";
  EXPECT_THAT(of_sliding(1, 5.0, 0.0, 0.0), IsEmpty()) << "without friction";
}

TEST(JudgeContacts, WarnsOfAnotherRestitutionThanAskedFor) {
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

TEST(JudgeContacts, WarnsOfAutomaticDampersThatHoldWhatSticks) {
  Pressed run;
  EXPECT_THAT(run.warnings(0.05), IsEmpty());
  EXPECT_THAT(run.warnings(0.5),
              ElementsAre(HasSubstr("tangential_damping of \"grid\" takes 50 % of the energy")));
  EXPECT_THAT(run.warnings(0.5),
              ElementsAre(HasSubstr("its 1 000 N s/m are stiffer than tangential_stiffness above 15.9 Hz")));
  run.out.contact_summaries[0].sticking_ratio = 0.4;
  EXPECT_THAT(run.warnings(0.5), IsEmpty()) << "it slides";
  run.out.contact_summaries[0].sticking_ratio = 1.0;
  run.out.contact_summaries[0].contact_time_ratio = 0.4;
  EXPECT_THAT(run.warnings(0.5), IsEmpty()) << "it rattles";
  run.out.contact_summaries[0].contact_time_ratio = 1.0;
  run.study.contacts[0].tangential_damping = 1000.0;
  EXPECT_THAT(run.warnings(0.5), IsEmpty()) << "as given";
}

} // namespace judge_contacts_test
