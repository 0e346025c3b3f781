// SPDX-License-Identifier: GPL-3.0-or-later
// What becomes of gap opening where a later stage has no results: the stages before it stand.
#include "app/gap_opening.hpp"
#include "core/error.hpp"
#include <functional>
#include <gtest/gtest.h>

namespace fretwork::app {
namespace {

constexpr double wall = 1.09e-3, rate = 1e-3; // m, W

/// A support on which a tube wears, through 5 stages at most.
class GapStages : public ::testing::Test {
protected:
  GapStages() {
    study_.gap_opening = study::GapOpening{.stages = 5};
    study_.contacts.resize(1);
    study_.wear.resize(1);
    contact_.name = "bar";
    contact_.entry = 0;
    contact_.obstacle = contact::Circle{1e-4};
    places_.push_back({"bar",
                       0,
                       {0},
                       {wear::SharedScar{wear::FlatBar{9.525e-3, 0.01}}, wear::Archard{1e-14}, wall},
                       {},
                       {},
                       {}});
    run_.contacts.resize(1);
    run_.contacts[0].gap = 1e-4;
    run_.wear = stage();
  }

  static results::Wear stage() {
    results::WearOfSupport support;
    support.name = "bar";
    support.states = {{"", 1.0, wear::work_rate_between(rate, rate, rate)}};
    support.work_rate = support.states[0].work_rate;
    support.life.end = "reached";
    results::Wear out;
    out.supports.push_back(support);
    return out;
  }

  /// @param third  what the third stage throws
  void open(const std::function<void()>& third) {
    open_gaps(
        study_, places_, {contact_},
        [&](const std::vector<PlacedContact>&, std::int64_t number) {
          if (number == 3)
            third();
          results::RunResults out;
          out.wear = stage();
          return out;
        },
        run_);
  }

  /// Two stages, with the end and its reason.
  void expect_two_stages(const std::string& end, const std::string& reason) {
    const results::GapOpening& opening = run_.wear->opening.value();
    EXPECT_EQ(opening.time.size(), 2u);
    EXPECT_GT(opening.supports[0].depth.value[1], opening.supports[0].depth.value[0]);
    EXPECT_EQ(opening.end, end);
    EXPECT_EQ(opening.reason, reason);
    EXPECT_EQ(run_.warnings, std::vector<std::string>{"gap opening: " + reason});
  }

  study::Study study_;
  PlacedContact contact_;
  std::vector<WornPlace> places_;
  results::RunResults run_;
};

} // namespace

TEST_F(GapStages, NameTheOneThatWasInterrupted) {
  try {
    open([] { throw core::Interrupted("ended by SIGTERM at t = 1 s"); });
    FAIL() << "an interruption ends the run";
  } catch (const core::Interrupted& error) {
    EXPECT_STREQ(error.what(), "gap opening, stage 3: ended by SIGTERM at t = 1 s");
  }
}

TEST_F(GapStages, StandWhereALaterOneDiverges) {
  open([] { throw core::ComputationError("the transient diverged"); });
  expect_two_stages("stage_failed", "stage 3: the transient diverged");
}

TEST_F(GapStages, StandWhereALaterOneTakesTooLong) {
  open([] { throw core::Error("it takes 30 hours"); });
  expect_two_stages("stage_refused", "stage 3: it takes 30 hours");
}

TEST_F(GapStages, EndWithTheProgramThatASignalEnds) {
  EXPECT_THROW(open([] { throw core::Interrupted("ended by SIGTERM"); }), core::Interrupted);
}

} // namespace fretwork::app
