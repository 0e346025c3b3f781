// SPDX-License-Identifier: GPL-3.0-or-later
/// Intervals that single runs state, against the scatter of many: a mass that rattles with friction in a hole under random forces.
#include "post/contact_statistics.hpp"
#include "transient/run.hpp"
#include "wear/life.hpp"
#include "wear/student.hpp"
#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

namespace coverage_test {

using namespace fretwork;

namespace {

constexpr int runs = 100;
constexpr double confidence = 0.95;

/// 1 kg on springs of 40 Hz, 5 % of damping, hole of 0.1 mm, band-limited forces in both planes.
transient::Scene rattling_mass(std::uint64_t draw) {
  const double w = 2.0 * std::numbers::pi * 40.0;
  transient::Scene scene;
  scene.system.stiffness = Eigen::VectorXd::Constant(2, w * w);
  scene.system.damping = Eigen::VectorXd::Constant(2, 2.0 * 0.05 * w);
  scene.q0 = scene.v0 = Eigen::VectorXd::Zero(2);
  scene.duration =
      10.0; // 125 decay times 1/(zeta w); over 50 errors are a tenth too small, over 14 a quarter
  for (int plane = 0; plane < 2; ++plane)
    scene.loads.push_back({transient::Random{20.0, 2.0, 100.0, 2 * draw + static_cast<std::uint64_t>(plane)},
                           Eigen::VectorXd::Unit(2, plane)});
  transient::ContactPoint hole;
  hole.name = "hole";
  hole.support = {contact::Circle{1e-4}, {1e5}, {5e4, 50.0, 0.3, 0.3}};
  hole.b = Eigen::MatrixXd::Zero(3, 2);
  hole.b(1, 0) = hole.b(2, 1) = 1.0;
  scene.contacts = {hole};
  return scene;
}

post::ContactSummary statistics_of(std::uint64_t draw) {
  const transient::Scene scene = rattling_mass(draw);
  post::ContactStatistics statistics(scene.contacts, 0.5);
  transient::Observer* const observers[] = {&statistics};
  const auto report = transient::run(scene, transient::choose_step(scene, {}), observers, nullptr, {});
  EXPECT_EQ(report.outcome, transient::Outcome::done);
  return statistics.summaries()[0];
}

const std::vector<post::ContactSummary>& ensemble() {
  static const std::vector<post::ContactSummary> all = [] {
    std::vector<post::ContactSummary> made;
    for (int run = 0; run < runs; ++run)
      made.push_back(statistics_of(static_cast<std::uint64_t>(run)));
    return made;
  }();
  return all;
}

struct Figure {
  const char* name;
  double (*value)(const post::ContactSummary&);
  double post::StandardErrors::*error;
};
constexpr std::array figures{
    Figure{"work rate", [](const auto& c) { return c.work_rate; }, &post::StandardErrors::work_rate},
    Figure{"friction power", [](const auto& c) { return c.friction_power; },
           &post::StandardErrors::friction_power},
    Figure{"rms force", [](const auto& c) { return c.normal_rms; }, &post::StandardErrors::normal_rms},
    Figure{"impact rate", [](const auto& c) { return c.impact_rate; }, &post::StandardErrors::impact_rate},
    Figure{"y std", [](const auto& c) { return c.y.std; }, &post::StandardErrors::y_std},
    Figure{"z std", [](const auto& c) { return c.z.std; }, &post::StandardErrors::z_std}};

/// K low for these hard impacts; depth after 10 years and years to 40 % of a wall of 1.09 mm, at the ends of a work rate.
wear::WornSupport flat_bar() {
  return {wear::SharedScar{wear::FlatBar{9.525e-3, 0.01}}, wear::Archard{1e-17}, 1.09e-3};
}

} // namespace

TEST(Coverage, OfTheTruthByTheIntervalsOfSingleRunsIsTheirConfidence) {
  const auto& all = ensemble();
  for (const Figure& f : figures) {
    double truth = 0.0, scatter = 0.0, stated = 0.0;
    int covered = 0;
    for (const auto& c : all)
      truth += f.value(c) / runs;
    for (const auto& c : all) {
      const double off = f.value(c) - truth, error = c.error.*f.error;
      scatter += off * off / (runs - 1);
      stated += error * error / runs;
      covered += std::abs(off) <= wear::student_factor(c.error.batches - 1.0, confidence) * error;
    }
    // of 100 independent intervals of 95 %, 90 to 99 hold the truth with probability 0.97 (binomial)
    EXPECT_GE(covered, 90) << f.name;
    EXPECT_LE(covered, 99) << f.name;
    constexpr double tolerance = 0.2; // the scatter of 100 runs is known to 7 %: three times that
    EXPECT_NEAR(std::sqrt(stated / scatter), 1.0, tolerance) << f.name;
  }
}

TEST(Coverage, HoldsForDepthAndYearsOfASupportThatWears) {
  std::vector<wear::WorkRate> rates;
  double mean = 0.0;
  for (const auto& c : ensemble()) {
    rates.push_back(
        wear::work_rate_with_confidence(c.work_rate, c.error.work_rate, c.error.batches, confidence));
    mean += c.work_rate / runs;
  }
  const std::array times{10.0 * wear::year};
  const auto at = [&](const wear::WorkRate& rate) {
    const std::array states{wear::UncertainState{1.0, rate}};
    return std::pair(wear::depth_history(flat_bar(), states, times), wear::time_to_limit(flat_bar(), states));
  };
  const auto [depth, life] = at(wear::work_rate(mean));
  const double true_depth = depth.value[0].depth.value().tube, true_years = life.value.tube.years();
  int depths = 0, lives = 0;
  for (const auto& rate : rates) {
    const auto [d, l] = at(rate);
    depths += d.low[0].depth.value().tube <= true_depth && true_depth <= d.high[0].depth.value().tube;
    lives += l.at_high.tube.years() <= true_years && true_years <= l.at_low.tube.years();
  }
  for (const int covered : {depths, lives}) {
    EXPECT_GE(covered, 90);
    EXPECT_LE(covered, 99);
  }
}

} // namespace coverage_test
