// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenes.hpp"
#include "single_mass.hpp"
#include "transient/splitting/replays.hpp"
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <utility>

namespace replays_test {

using namespace fretwork;
using namespace fretwork::tests;
using namespace fretwork::signals;
using namespace fretwork::transient;

namespace {

constexpr double step = 2e-5; // s

/// A pressed mass that sticks most of the time, without tangential damper: the work of its short slips asks for fine intervals.
Scene mostly_sticking(double duration) {
  constexpr double mass = 1.0;
  Scene s = mass_point(mass, Vec3(900.0, 1600.0, 2500.0), duration);
  for (Eigen::Index i = 0; i < 3; ++i)
    s.system.damping(i) = 2.0 * 0.02 * std::sqrt(s.system.stiffness(i));
  s.contacts = {contact_of(mass, {contact::Stop{-1e-4, contact::PlaneAxis::y}, {1e6}, {3e5, 0.0, 0.7, 0.7}})};
  s.loads = {force_on(mass, {0.0, 0.0, 60.0}, Harmonic{1.0, 7.0}),
             force_on(mass, {0.0, 60.0, 0.0}, Harmonic{1.0, 11.3})};
  return s;
}

/// The same with a mode at twice w_c that moves the contact too, with `share` of the point's mobility.
Scene with_a_fast_mode(Scene s, double share) {
  const Eigen::Index n = s.system.size();
  const auto add = [&](Eigen::VectorXd& values, double value) {
    values.conservativeResize(n + 1);
    values(n) = value;
  };
  constexpr double fast = 2000.0, damping = 0.02;
  add(s.system.stiffness, fast * fast);
  add(s.system.damping, 2.0 * damping * fast);
  add(s.q0, 0.0);
  add(s.v0, 0.0);
  for (vibration::Load& load : s.loads)
    add(load.modal_force, 0.0);
  Eigen::MatrixXd& b = s.contacts[0].b;
  b.conservativeResize(b.rows(), n + 1);
  b.col(n) = std::sqrt(share) * b.leftCols(n).rowwise().sum();
  return s;
}

struct Measured {
  post::ContactSummary statistics;
  StepError error;
};

Measured measured(const Scene& scene, StepChoice choice) {
  post::ContactStatistics contacts(scene.contacts, 0.0);
  Observer* const observers[] = {&contacts};
  Run run(scene, choice, observers, nullptr, {});
  run.advance(std::numeric_limits<std::int64_t>::max());
  (void)run.finish();
  return {contacts.summaries()[0], run.step_errors().empty() ? StepError{} : run.step_errors()[0]};
}

/// Of three times the automatic step: with one interval in each there is an error to be measured.
constexpr double thrice = 2.4e-3; // s
StepChoice choice_of(const Scene& scene, int parts, double accuracy, double step_of_run = thrice) {
  StepChoice choice = choose_step(scene, splitting(step_of_run));
  choice.parts = parts;
  choice.accuracy = accuracy;
  return choice;
}

/// Hash of what a record says of the motion and of the contacts with a force.
std::size_t digest(const Record& record, int modes) {
  core::StateArchive out;
  double time = record.time, length = record.step;
  std::vector<double> q(record.q, record.q + modes);
  out(time, length, q);
  for (const int c : record.active) {
    ContactState s = record.states[static_cast<std::size_t>(c)];
    out(s.normal_force, s.friction, s.friction_work, s.damper_work, s.closed, s.touches, s.wear_work);
  }
  return std::hash<std::string>()(std::move(out).bytes());
}

} // namespace

TEST(Replayable, GoesOnFromAnotherSchemeAsThatDoes) {
  const Scene scene = rattling(12, 30, 0.05);
  const int modes = static_cast<int>(scene.system.size());
  const auto running = make_replayable_splitting(scene, step, {.parts = 2});
  const auto other = make_replayable_splitting(scene, step, {.parts = 2});
  for (const int steps : {700, 300, 41}) {
    for (int i = 0; i < steps; ++i)
      (void)running->advance();
    const double from = other->continue_from(*running);
    const Record& first = running->advance(); // made before
    EXPECT_NEAR(first.time + 0.5 * first.step, from, 1e-9 * step);
    for (int i = 0; i < 200; ++i)
      ASSERT_EQ(digest(running->advance(), modes), digest(other->advance(), modes)) << steps << ' ' << i;
  }
}

TEST(Replayable, OfHalfTheStepStaysBesideIt) {
  const Scene scene = rattling(12, 30, 0.05);
  const auto running = make_replayable_splitting(scene, step, {.parts = 2});
  const auto finer = make_replayable_splitting(scene, 0.5 * step, {.parts = 4});
  for (int i = 0; i < 1000; ++i)
    (void)running->advance();
  const double from = finer->continue_from(*running);
  (void)running->advance();
  double impulse = 0.0, of_finer = 0.0, now = from;
  constexpr int steps = 100;
  constexpr double agreement = 0.02; // forces of closed contacts over 100 steps, of order 2
  for (int i = 0; i < steps; ++i) {
    const Record& record = running->advance();
    for (const int c : record.active)
      impulse += record.step * record.states[static_cast<std::size_t>(c)].normal_force;
  }
  while (now < from + (steps - 0.5) * step) {
    const Record& record = finer->advance();
    now = record.time + 0.5 * record.step;
    for (const int c : record.active)
      of_finer += record.step * record.states[static_cast<std::size_t>(c)].normal_force;
  }
  ASSERT_GT(impulse, 0.0);
  EXPECT_NEAR(of_finer / impulse, 1.0, agreement);
}

TEST(Replays, ChangeNothingWhereTheAccuracyIsMet) {
  const Scene scene = mostly_sticking(60.0);
  StepChoice choice = choice_of(scene, 2, 1e3);
  ASSERT_GT(choice.replay, 0.0);
  const Measured replayed = measured(scene, choice);
  EXPECT_EQ(replayed.error.parts, 2);
  choice.replay = 0.0;
  const Measured plain = measured(scene, choice);
  EXPECT_EQ(replayed.statistics.work_rate, plain.statistics.work_rate);
  EXPECT_EQ(replayed.statistics.normal_rms, plain.statistics.normal_rms);
  EXPECT_EQ(plain.error.parts, 0) << "not measured";
}

// Against a run of sixteen times as many intervals. Replays sum the errors of the step itself; what a run makes of them in the long term may be
// less: a contact that slips too far sticks the longer.
TEST(Replays, MeasureTheErrorOfTheRun) {
  const Scene scene = mostly_sticking(1000.0);
  const Measured coarse = measured(scene, choice_of(scene, 1, 1e3));
  StepChoice fine_choice = choice_of(scene, 16, 1e3);
  fine_choice.replay = 0.0;
  const Measured fine = measured(scene, fine_choice);
  const double error = coarse.statistics.work_rate / fine.statistics.work_rate - 1.0;
  const StepError& e = coarse.error;
  const double told = e.errors[replayed_work] / e.sums[replayed_work],
               spread = e.spreads[replayed_work] / e.sums[replayed_work];
  ASSERT_GT(std::abs(error), 0.015) << "there is an error to be measured";
  EXPECT_GT(std::abs(told), 3.0 * spread);
  EXPECT_GT(told / error, 0.4); // of its sign
  EXPECT_LT(told / error, 5.0);
}

// Modes that are made heavier leave an error that no finer interval shows: replays have modes of twice the frequency.
TEST(Replays, MeasureWhatHeavierModesChange) {
  const Scene scene = with_a_fast_mode(mostly_sticking(1000.0), 0.1);
  constexpr double fine = 2e-4; // s
  StepChoice choice = choice_of(scene, 2, 1e3, fine);
  const double work = measured(scene, choice).statistics.work_rate;
  choice.fastest = 1000.0;
  const Measured heavier = measured(scene, choice);
  const double error = heavier.statistics.work_rate / work - 1.0;
  const double told = heavier.error.errors[replayed_work] / heavier.error.sums[replayed_work],
               spread = heavier.error.spreads[replayed_work] / heavier.error.sums[replayed_work];
  ASSERT_GT(std::abs(error), 0.02);
  EXPECT_GT(std::abs(told), 3.0 * spread);
  EXPECT_GT(told / error, 0.4); // of its sign
  EXPECT_LT(told / error, 5.0);
}

// So long that its work rate is known to less than what is refined away.
TEST(Replays, RefineTheIntervalsOfContactsUntilTheAccuracyIsMet) {
  const Scene scene = mostly_sticking(600.0);
  StepChoice fine_choice = choice_of(scene, 32, 1e3);
  fine_choice.replay = 0.0;
  const double work = measured(scene, fine_choice).statistics.work_rate;
  const Measured unrefined = measured(scene, choice_of(scene, 1, 1e3)),
                 refined = measured(scene, choice_of(scene, 1, 0.01));
  EXPECT_GE(refined.error.parts, 2);
  EXPECT_GT(std::abs(unrefined.statistics.work_rate / work - 1.0), 0.3);
  EXPECT_LT(std::abs(refined.statistics.work_rate / work - 1.0), 0.015);
  EXPECT_GE(measured(scene, choice_of(scene, 1, 0.003)).error.parts, 4);
}

TEST(Replays, RefineNoContactThatIsRightAsItIs) {
  // a mass that bounces without loss: the spring's energy is kept whatever the interval
  constexpr double mass = 1.0;
  Scene scene = mass_point(mass, Vec3::Zero(), 20.0);
  start(scene, mass, Vec3::Zero(), Vec3(0.0, 0.5, 0.0));
  scene.contacts = {contact_of(mass, {contact::PlanePair{1e-3, contact::PlaneAxis::y}, {1e6}, {}})};
  const StepChoice choice = choose_step(scene, splitting());
  const Measured run = measured(scene, choice);
  EXPECT_GT(run.error.sums[replayed_impulse], 0.0);
  EXPECT_EQ(run.error.parts, choice.parts);
}

namespace {

/// Its one contact has the same forces in all steps.
class Unchanging final : public Replayable {
public:
  Unchanging(double step, const ContactState& state, int* parts)
      : step_(step), state_(state), parts_(parts) {}
  const Record& advance() override {
    time_ += step_;
    record_.time = time_ - 0.5 * step_;
    record_.step = step_;
    record_.contacts = 1;
    record_.states = {&state_, 1};
    record_.active = {&number_, 1};
    return record_;
  }
  double continue_from(const Replayable& running) override {
    return time_ = dynamic_cast<const Unchanging&>(running).time_;
  }
  void divide(int, int parts) override { *parts_ = parts; }
  [[nodiscard]] double next_time() const override { return time_ + step_; }
  void state_at(double, double*, double*) override {}
  void load_at(double, double*) override {}
  [[nodiscard]] StepCounts counts() const override { return {}; }
  void visit(core::StateArchive&) override {}

private:
  double step_, time_ = 0.0;
  ContactState state_;
  int* parts_;
  const int number_ = 0;
  Record record_;
};

constexpr int few = 20'000, many = 2'000'000; // steps: 48 replays, and a hundred times as many

/// Intervals a step of a run whose steps, by their size, are off by these shares of what the replays have: the standard error is the error over the square
/// root of the replays.
int refined_to(double of_square, double of_impulse, int steps = many) {
  int parts = 1;
  ContactState replayed;
  replayed.normal_force = replayed.normal_square = replayed.closed = 1.0;
  ContactState run = replayed;
  run.normal_square += of_square;
  run.normal_force += of_impulse;
  const auto scheme =
      make_replayed(std::make_unique<Unchanging>(2.0 * step, run, &parts),
                    std::make_unique<Unchanging>(step, replayed, &parts),
                    {.accuracy = 0.01, .length = 20.0 * step, .contacts = 1, .parts = 1, .most_parts = 8});
  for (int i = 0; i < steps; ++i)
    (void)scheme->advance();
  return parts;
}

} // namespace

// Three quarters of the accuracy, a half in what half the step takes away. The statistic is the rms force, whose error is half of that of its square.
TEST(Replays, RefineByTheErrorsOfStatistics) {
  EXPECT_EQ(refined_to(0.0, 0.0), 1);
  EXPECT_EQ(refined_to(0.0, 0.0036), 1);
  EXPECT_EQ(refined_to(0.0, 0.004), 8);
  EXPECT_EQ(refined_to(0.0072, 0.0), 1);
  EXPECT_EQ(refined_to(-0.008, 0.0), 8);
}

// By two standard errors: 64 replays of an error of the whole accuracy, 16 of one and a half.
TEST(Replays, RefineWhereAnErrorIsSurelyTooLarge) {
  EXPECT_EQ(refined_to(0.0, 0.005, few), 1);
  EXPECT_EQ(refined_to(0.0, 0.005), 8);
  EXPECT_EQ(refined_to(0.0, 0.0075, few), 8);
}

TEST(Replays, GoOnAfterARestartBitForBit) {
  const Scene scene = mostly_sticking(60.0);
  const StepChoice choice = choice_of(scene, 1, 0.01);
  post::ContactStatistics all(scene.contacts, 0.0);
  Observer* const of_all[] = {&all};
  transient::Run whole(scene, choice, of_all, nullptr, {});
  whole.advance(std::numeric_limits<std::int64_t>::max());
  for (const std::int64_t records : {50, 1500, 7777}) { // within a replay, between two
    post::ContactStatistics first(scene.contacts, 0.0), rest(scene.contacts, 0.0);
    Observer *const of_first[] = {&first}, *const of_rest[] = {&rest};
    transient::Run left(scene, choice, of_first, nullptr, {});
    left.advance(records);
    core::StateArchive saved;
    saved(left);
    transient::Run on(scene, choice, of_rest, nullptr, {});
    core::StateArchive restored(std::move(saved).bytes());
    restored(on);
    restored.end();
    on.advance(std::numeric_limits<std::int64_t>::max());
    EXPECT_EQ(rest.summaries()[0].work_rate, all.summaries()[0].work_rate) << records;
    const StepError a = on.step_errors()[0], b = whole.step_errors()[0];
    EXPECT_EQ(a.parts, b.parts);
    EXPECT_EQ(a.errors, b.errors);
    EXPECT_EQ(a.spreads, b.spreads);
  }
}

// A mass that bounces, whose modes are coupled by a damper: steps of several h, which such modes do not take, would halve the motion of a replay.
TEST(Replays, FollowModesThatDampersCouple) {
  Scene s = mostly_sticking(20.0);
  s.contacts[0].support.obstacle = contact::Stop{6e-2, contact::PlaneAxis::y};
  s.loads = {force_on(1.0, {0.0, 9.0, 0.0}, Harmonic{1.0, 6.4})}; // of a mode
  s.system.damping_matrix = s.system.damping.asDiagonal();
  s.system.damping_matrix(1, 2) = s.system.damping_matrix(2, 1) = 0.5;
  StepChoice choice = choose_step(s, splitting());
  const Measured m = measured(s, choice);
  ASSERT_GT(m.error.sums[replayed_impacts], 50.0);
  for (const std::size_t figure : {replayed_impulse, replayed_impacts, replayed_closed_time})
    EXPECT_LT(std::abs(m.error.errors[figure]), 0.02 * m.error.sums[figure]) << figure;
  // no replay has another number of impacts: so it is known to one of the few in them
  EXPECT_EQ(m.error.errors[replayed_impacts], 0.0);
  EXPECT_GT(m.error.spreads[replayed_impacts], 0.1 * m.error.sums[replayed_impacts]);
  EXPECT_LT(m.error.spreads[replayed_impacts], 0.5 * m.error.sums[replayed_impacts]);
}

} // namespace replays_test
