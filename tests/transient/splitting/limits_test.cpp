// SPDX-License-Identifier: GPL-3.0-or-later
// What results of splitting are worth in the longest steps that its limits allow (transient/scene/scheme_limits.hpp): small scenes at each limit against
// runge_kutta_54. The limit of normal dampers: damped_impacts_test.cpp; stability beside tangential ones: sticking_contacts_test.cpp; macro-steps: macro_steps_test.cpp.
#include "scenes.hpp"
#include "transient/scene/scheme_limits.hpp"
#include <array>
#include <numbers>
#include <variant>

namespace splitting_limits_test {

using namespace fretwork;
using namespace fretwork::tests;
using namespace fretwork::signals;
using namespace fretwork::transient;
using contact::PlaneAxis;
using contact::Stop;

namespace {

constexpr SchemeLimits limits = limits_of(SchemeKind::splitting);
constexpr double step = 1e-3;                           // s: the longest of each scene
constexpr double contact = limits.contact.share / step; // rad/s, w_c or w_t at its limit
constexpr double beside_scaled =
    limits.highest_mode.share / scaled_above / step; // likewise, with modes that are made heavier
constexpr double fast_damper = 3.0;                  // r_t h
constexpr double fastest_damper = limits.intervals * limits.tangential_damper.share / step; // 1/s
constexpr double phases[] = {0.0, 0.3, 0.6}; // of a step: where an impact begins in one

/// Of contact 0, and the speed of mode 0 at the end, m/s.
struct Figures {
  double rms, largest, mean, rebound, friction_power, work_rate, tangential_rms;
};

/// @param from  s, of the statistics
Figures figures_of(const Scene& scene, const StepChoice& choice, double from = 0.0) {
  const History run = simulate_with(scene, choice, scene.duration, from);
  const post::ContactSummary& s = run.statistics.at(0);
  return {s.normal_rms,     s.normal_max, s.normal_mean,   run.v(0, run.v.cols() - 1),
          s.friction_power, s.work_rate,  s.tangential_rms};
}

Figures reference(const Scene& scene, double tolerance = 1e-10, double from = 0.0) {
  StepOptions options;
  options.scheme = SchemeKind::runge_kutta_54;
  options.tolerance = tolerance;
  return figures_of(scene, choose_step(scene, options), from);
}

/// Errors allowed: relative ones of forces, friction power and work rate; of the rebound in m/s.
struct Allowed {
  double rms, largest, mean, rebound;
};
void expect_impact(const Figures& found, const Figures& exact, const Allowed& allowed) {
  EXPECT_NEAR(found.rms / exact.rms, 1.0, allowed.rms);
  EXPECT_NEAR(found.largest / exact.largest, 1.0, allowed.largest);
  EXPECT_NEAR(found.mean / exact.mean, 1.0, allowed.mean);
  EXPECT_NEAR(found.rebound, exact.rebound, allowed.rebound);
}
void expect_friction(const Scene& scene, double power, double force, const Figures& exact) {
  const Figures found = figures_of(scene, choose_step(scene, splitting(step)));
  EXPECT_NEAR(found.friction_power / exact.friction_power, 1.0, power);
  EXPECT_NEAR(found.work_rate / exact.work_rate, 1.0, power);
  EXPECT_NEAR(found.tangential_rms / exact.tangential_rms, 1.0, force);
}
void expect_friction(const Scene& scene, double power, double force) {
  expect_friction(scene, power, force, reference(scene));
}

/// A longer step is warned about, this one is not.
void expect_at_limit(const Scene& scene) {
  EXPECT_TRUE(choose_step(scene, splitting(step)).warnings.empty());
  EXPECT_EQ(choose_step(scene, splitting(1.03 * step)).warnings.size(), 1u);
}

/// A mode that is free and one of w h = `fast` move a node at 1 m/s to a stop that deflects both.
/// @param share  of the fast mode at the node over that of the free one; 0: a mass alone   @param phase  of the first step with a force
Scene impact(double frequency, double damping_ratio, double fast, double share, double phase) {
  Scene scene;
  const double mobility = 1.0 + share * share, mode = fast / step;
  scene.system.stiffness = Eigen::Vector2d(0.0, mode * mode);
  scene.system.damping = Eigen::Vector2d(0.0, 0.02 * mode);
  scene.contacts = {{"stop",
                     {Stop{0.0, PlaneAxis::y},
                      {frequency * frequency / mobility, 2.0 * damping_ratio * frequency / mobility},
                      {}},
                     Vec3(0.0, -(3.0 + phase) * step, 0.0),
                     Eigen::MatrixXd::Zero(3, 2)}};
  scene.contacts[0].b.row(1) << 1.0, share;
  scene.q0 = Eigen::Vector2d::Zero();
  scene.v0 = Eigen::Vector2d(1.0, 0.0);
  scene.duration = 20.0 * step;
  return scene;
}

/// Such a node, pressed on a plane with 10 N, on which a force of `amplitude` times the friction bound moves it to and fro, 50 steps a period. The fast
/// mode begins with a vibration.
Scene pressed_mass(double stick, double damper, double amplitude, double fast = 0.1, double share = 0.0) {
  constexpr double mu = 0.3, normal = 10.0, stiffness = 1e3, vibration = 3e-3;
  const double mobility = 1.0 + share * share, mode = fast / step;
  Scene scene;
  scene.system.stiffness = Eigen::Vector2d(share > 0.0 ? 1e4 : 0.0, mode * mode);
  scene.system.damping = Eigen::Vector2d(share > 0.0 ? 2.0 : 0.0, 0.02 * mode);
  scene.contacts = {
      {"plane",
       {Stop{0.0, PlaneAxis::z}, {stiffness}, {stick * stick / mobility, damper / mobility, mu, mu}},
       Vec3(0.0, 0.0, normal / stiffness),
       Eigen::MatrixXd::Zero(3, 2)}};
  scene.contacts[0].b.row(0) << 1.0, share;
  scene.q0 = Eigen::Vector2d::Zero();
  scene.v0 = Eigen::Vector2d(0.0, share > 0.0 ? vibration : 0.0);
  scene.loads = {{Harmonic{amplitude * mu * normal, 1.0 / (50.0 * step)}, Eigen::Vector2d(1.0, share)}};
  scene.duration = 250.0 * step;
  return scene;
}

constexpr double settled = 100.0 * step; // what the start of a load has excited has died away

/// A damped mass that a force and a load of 10 N press on a stop.   @param damping  1/s
Scene driven(const TimeFunction& load, double frequency, double damping = 0.1 / step) {
  Scene scene = mass_point(1.0, Vec3::Zero(), 400.0 * step);
  scene.system.damping.setConstant(damping);
  const double k = frequency * frequency;
  scene.contacts = {contact_of(1.0, {Stop{0.0, PlaneAxis::z}, {k}, {}}, Vec3(0.0, 0.0, 10.0 / k))};
  scene.loads = {force_on(1.0, Vec3(0, 0, 1), load), force_on(1.0, Vec3(0, 0, 1), Constant{10.0})};
  return scene;
}
void expect_driven(const Scene& scene, const Allowed& allowed, double from = 0.0) {
  expect_impact(figures_of(scene, choose_step(scene, splitting(step)), from), reference(scene, 1e-10, from),
                allowed);
}

} // namespace

TEST(SplittingLimits, OfTheContactFrequencyGivesImpacts) {
  struct Case {
    double frequency; ///< w_c
    int parts;
    Allowed bounces, stopped;
  };
  for (const Case& of : {Case{1.75 / step, 2, {2e-3, 3e-3, 8e-4, 1e-3}, {1e-2, 3e-3, 3e-4, 1e-4}},
                         Case{contact, 3, {3e-3, 4e-3, 1.2e-3, 1.5e-3}, {1.1e-2, 3e-3, 3e-4, 1e-4}}})
    for (const double ratio : {0.0, 0.05, 0.2, 0.7, 3.0})
      for (const double phase : phases) {
        SCOPED_TRACE(testing::Message()
                     << of.frequency << " rad/s, damping ratio " << ratio << ", phase " << phase);
        const Scene scene = impact(of.frequency, ratio, 0.1, 0.0, phase);
        const StepChoice choice = choose_step(scene, splitting(step));
        if (ratio < 1.0) {
          EXPECT_EQ(choice.parts, of.parts);
        }
        if (of.frequency == contact)
          expect_at_limit(scene);
        expect_impact(figures_of(scene, choice), reference(scene), ratio > 1.0 ? of.stopped : of.bounces);
      }
}

// Contacts of one node find their forces one after the other: what they leave unanswered is no loss. At a tenth of the largest change two took 2 to 4 % of the energy,
// at a twentieth up to 1.5 % (w_c h = 1.55).
TEST(SplittingLimits, OfContactsOfOneNodeGivesImpacts) {
  for (const auto& [count, allowed] : {std::pair(2, 6e-4), {5, 1.5e-3}}) // of the speed
    for (const double frequency : {0.75 / step, 1.2 / step, 1.55 / step, 1.75 / step, contact})
      for (const double phase : phases) {
        SCOPED_TRACE(testing::Message() << count << " contacts, " << frequency << " rad/s, phase " << phase);
        Scene scene = impact(frequency, 0.0, 0.1, 0.0, phase);
        scene.contacts[0].support.normal.stiffness /= count;
        scene.contacts.resize(static_cast<std::size_t>(count), scene.contacts[0]);
        const History run = simulate_with(scene, choose_step(scene, splitting(step)), scene.duration);
        EXPECT_NEAR(run.v(0, run.v.cols() - 1), -1.0, allowed);
      }
}

// In the middles of steps a free mass stands where its sine has it, though what the modes bear of the force is linear in time.
TEST(SplittingLimits, OfTheContactFrequencyGivesPositions) {
  for (const auto& [frequency, allowed] : {std::pair(1.75 / step, 4e-3), {contact, 1.5e-2}})
    for (const double phase : phases) {
      SCOPED_TRACE(testing::Message() << frequency << " rad/s, phase " << phase);
      const double touch = (3.0 + phase) * step, lasts = std::numbers::pi / frequency;
      int closed = 0;
      for (const Trace::Entry& record : trace(impact(frequency, 0.0, 0.1, 0.0, phase), splitting(step))) {
        const double since = record.time - touch, rest = -touch,
                     exact = since < 0.0     ? since
                             : since > lasts ? lasts - since
                                             : std::sin(frequency * since) / frequency;
        EXPECT_NEAR(record.uy + rest, exact, allowed / frequency) << record.time / step;
        closed += since > 0.0 && since < lasts ? 1 : 0;
      }
      EXPECT_GE(closed, 1);
    }
}

TEST(SplittingLimits, OfTheHighestModeGivesImpactsThatItHasAPartIn) {
  struct Case {
    double fast; ///< w h of the fast mode
    std::array<double, 3> frequencies;
    Allowed part, half; ///< by its share of the mobility
  };
  for (const Case& of : {Case{1.75,
                              {0.35 / step, 0.875 / step, 1.75 / step},
                              {1.2e-3, 4e-3, 1.3e-3, 2.4e-3},
                              {4e-3, 8e-3, 8e-3, 1.4e-2}},
                         Case{limits.highest_mode.share,
                              {0.2 * contact, 0.5 * contact, contact},
                              {2e-3, 4e-3, 1.3e-3, 2.4e-3},
                              {5e-3, 8e-3, 8e-3, 1.4e-2}}})
    for (const double frequency : of.frequencies)
      for (const double share : {0.3, 1.0})
        for (const double phase : phases) {
          SCOPED_TRACE(testing::Message() << "w h = " << of.fast << ", " << frequency << " rad/s, share "
                                          << share << ", phase " << phase);
          const Scene scene = impact(frequency, 0.0, of.fast, share, phase);
          expect_impact(figures_of(scene, choose_step(scene, splitting(step))), reference(scene),
                        share < 1.0 ? of.part : of.half);
        }
  expect_at_limit(impact(0.5 * contact, 0.0, limits.highest_mode.share, 0.3, 0.0));
}

TEST(SplittingLimits, OfScaledModesGiveImpactsThatTheyHaveAPartIn) {
  constexpr Allowed far{1.2e-3, 3e-3, 4e-4, 6e-4}, near{8e-3, 5e-2, 5e-3, 1e-2};
  for (const double times : {3.0, 14.0}) // w_c
    for (const double share : {0.3, 1.0})
      for (const double phase : phases) {
        SCOPED_TRACE(testing::Message() << times << " w_c, share " << share << ", phase " << phase);
        const Scene scene = impact(beside_scaled, 0.0, times * beside_scaled * step, share, phase);
        StepChoice scaled = choose_step(scene, splitting(step));
        scaled.fastest = limits.highest_mode.share / step;
        expect_impact(figures_of(scene, scaled), reference(scene), times > 10.0 ? far : near);
      }
}

// Without damper runge_kutta_54 is of order 1 and needs a finer tolerance: at 1e-10 its work rates are 0.1 % from those that short steps of splitting converge to.
TEST(SplittingLimits, OfStickingContactsGiveFriction) {
  constexpr double finer = 1.0 / 32.0;
  for (const double amplitude : {1.5, 3.0, 10.0})
    for (const double damper : {0.0, 0.2 * contact}) {
      SCOPED_TRACE(testing::Message() << "amplitude " << amplitude << ", damper " << damper);
      const Scene scene = pressed_mass(contact, damper, amplitude);
      expect_at_limit(scene);
      const Figures fine = figures_of(scene, choose_step(scene, splitting(finer * step)));
      expect_friction(scene, 1e-4, 1e-3, fine);
      expect_friction(scene, damper > 0.0 ? 1e-4 : 1e-3, damper > 0.0 ? 1e-3 : 5e-3,
                      reference(scene, damper > 0.0 ? 1e-10 : 1e-12));
    }
}

// A mass that turns round sticks for less than an interval meanwhile. Where it slid on in the new direction at once, friction powers were up to 1.7 % low.
TEST(SplittingLimits, OfTangentialDampersGiveFriction) {
  for (const double amplitude : {1.5, 2.5, 3.0, 10.0})
    for (const double damper : {fastest_damper, limits.tangential_damper.share / step, fast_damper / step}) {
      SCOPED_TRACE(testing::Message() << "amplitude " << amplitude << ", damper " << damper);
      expect_friction(pressed_mass(contact, damper, amplitude), 1e-3, 5e-3);
      expect_friction(pressed_mass(0.2 * contact, damper, amplitude), 1e-3, 5e-3);
    }
  expect_at_limit(pressed_mass(0.2 * contact, fastest_damper, 3.0));
}

// In a step the fast mode holds back 55 % of the velocity that a force gives it.
TEST(SplittingLimits, OfModesBesideTangentialDampersGiveFriction) {
  for (const double share : {0.5, 1.0})
    for (const double amplitude : {1.2, 3.0}) {
      SCOPED_TRACE(testing::Message() << "share " << share << ", amplitude " << amplitude);
      for (const double damper : {fastest_damper, fast_damper / step})
        expect_friction(pressed_mass(contact, damper, amplitude, limits.highest_mode.share, share), 5e-3,
                        2e-3);
    }
  for (const double damper : {30.0 / step, fast_damper / step})
    expect_at_limit(pressed_mass(0.5 * contact, damper, 3.0, limits.highest_mode.share, 0.5));
}

// From the start, with the vibration that it excites, and after that has died away.
TEST(SplittingLimits, OfTheExcitationGiveForces) {
  const double frequency = 1.0 / (limits.points_per_period * step);
  std::vector<TimeFunction> loads;
  for (const double share : {1.0, 0.937, 0.71})
    loads.push_back(Harmonic{5.0, share * frequency});
  for (unsigned seed = 3; seed < 10; ++seed)
    loads.push_back(Random{3.0, 0.2 * frequency, frequency, seed});
  for (const double of : {1.75 / step, contact}) {
    double squares = 0.0;
    for (const TimeFunction& load : loads) {
      const Scene scene = driven(load, of);
      expect_driven(scene, {5e-5, 6e-4, 4e-5, 1e-5}, settled);
      const Figures found = figures_of(scene, choose_step(scene, splitting(step))), exact = reference(scene);
      const bool random = std::holds_alternative<Random>(load);
      const double largest = of < contact ? 1e-3 : random ? 1.5e-2 : 5e-3;
      expect_impact(found, exact, {random ? 2e-4 : of < contact ? 5e-5 : 2e-5, largest, 1e-5, 1e-5});
      squares += std::pow(found.largest / exact.largest - 1.0, 2);
    }
    EXPECT_LT(std::sqrt(squares / static_cast<double>(loads.size())), of < contact ? 4e-4 : 7e-3);
  }
  expect_at_limit(driven(Harmonic{5.0, frequency}, 0.9 * contact));
}

// A mass that rests in space on an obstacle that rests there too, told by its motion from a base that moves: what the loads of this motion give the mass within a step is what
// moves the obstacle.
TEST(SplittingLimits, OfTheExcitationLeaveAtRestWhatABaseMovesUnder) {
  const double frequency = 1.0 / (limits.points_per_period * step);
  const Harmonic harmonic{30.0, frequency};
  Table corners{{0.0}, {0.0}};
  for (int i = 1; corners.time.back() < 401.0 * step; ++i) {
    corners.time.push_back(6.3 * i * step);
    corners.value.push_back(i % 2 > 0 ? 30.0 : -30.0);
  }
  struct Case {
    TimeFunction acceleration;
    double most; ///< N
  };
  for (const auto& [acceleration, most] : {Case{harmonic, 0.03}, {corners, 0.2}}) {
    Scene scene = driven(Constant{0.0}, contact);
    scene.system.damping.setZero();
    const PrescribedMotion motion{acceleration, 0.1, 0.0};
    scene.motions = {motion};
    scene.contacts[0].imposed = Vec3(0.0, 0.0, 1.0);
    scene.loads[0] = force_on(1.0, Vec3(0, 0, -1), acceleration);
    scene.v0(2) = -0.1;
    const History run = simulate_with(scene, choose_step(scene, splitting(step)), scene.duration);
    EXPECT_NEAR(run.statistics[0].normal_max, 10.0, most);
    EXPECT_NEAR(run.statistics[0].normal_mean, 10.0, 1e-3);
    EXPECT_NEAR(run.statistics[0].normal_rms, 10.0, 1e-3);
  }
}

/// @param interval  s
Table sine(double rate, double interval) {
  Table table;
  for (int i = 0; table.time.empty() || table.time.back() < 401.0 * step; ++i) {
    table.time.push_back(i * interval);
    table.value.push_back(5.0 * std::sin(rate * table.time.back()));
  }
  return table;
}

TEST(SplittingLimits, OfRecordsGiveForces) {
  for (const double interval : {step / 3.3, step / 20.0}) {
    const Table record = sine(record_share / step, interval);
    EXPECT_NEAR(choose_step(driven(record, contact), splitting(step)).record_rate * step, record_share, 0.03);
    expect_driven(driven(record, contact), {5e-4, 5e-3, 1e-4, 1e-4});
  }
}

// Values that change by their whole size from point to point of a table, which lie anywhere in steps.
TEST(SplittingLimits, OfTablesGiveForces) {
  for (const auto& [interval, frequency] :
       {std::pair(step, contact_beside_tables / step), {step / table_share, contact}})
    for (const double rests : {17.3, 7.3}) { // of it, in steps
      Table table{{0.0}, {0.0}};
      for (int i = 1; table.time.back() < 401.0 * step; ++i) {
        table.time.push_back(table.time.back() + (i % 3 > 0 ? interval : rests * step));
        table.value.push_back(6.0 * std::sin(1.7 * i));
      }
      SCOPED_TRACE(testing::Message() << frequency << ", " << rests);
      expect_driven(driven(table, frequency), {6e-4, 7e-3, 3e-5, 1e-4});
      expect_at_limit(driven(table, 0.99 * frequency));
    }
}

// The corners of a table that lie anywhere in steps drive the vibration of a contact that stays closed, by a harmonic of theirs: little damped, its resonance
// is all that there is of it. Lines between the values at the ends of steps would lose 5 to 20 % of the largest force.
TEST(SplittingLimits, OfTablesDriveContacts) {
  constexpr double damping = 0.02 / step;
  for (const auto& [frequency, allowed] : {std::pair(1.75, Allowed{1.2e-3, 8e-3, 1e-4, 1e-3}),
                                           {2.2, Allowed{3e-3, 1.6e-2, 2e-4, 1e-3}},
                                           {contact * step, Allowed{7e-3, 2.5e-2, 2e-4, 2e-3}}})
    for (const int harmonic : {1, 3}) {
      const double interval = std::numbers::pi * harmonic / frequency * step;
      Table corners{{0.0}, {0.0}};
      for (int i = 1; corners.time.back() < 401.0 * step; ++i) {
        corners.time.push_back((i - 0.5) * interval);
        corners.value.push_back((i % 2 > 0 ? 1.0 : -1.0) * (harmonic > 1 ? 0.4 : 0.05));
      }
      SCOPED_TRACE(testing::Message() << frequency << ", harmonic " << harmonic);
      expect_driven(driven(corners, frequency / step, damping), allowed, settled);
    }
}

namespace {

/// One mode of `own` times w_c, undamped, and a contact of w_c = frequency at its node.
Scene oscillator(double frequency, double own, double gap, double preload, double duration) {
  Scene scene;
  scene.system.stiffness = Eigen::VectorXd::Constant(1, own * own * frequency * frequency);
  scene.system.damping = Eigen::VectorXd::Zero(1);
  scene.contacts = {{"stop",
                     {Stop{gap, PlaneAxis::y}, {frequency * frequency}, {}},
                     Vec3(0.0, preload, 0.0),
                     Eigen::MatrixXd::Zero(3, 1)}};
  scene.contacts[0].b(1, 0) = 1.0;
  scene.q0 = Eigen::VectorXd::Zero(1);
  scene.v0 = Eigen::VectorXd::Ones(1);
  scene.duration = duration;
  return scene;
}

} // namespace

// A contact that stays closed vibrates on, without damping: what the step takes of it, as a ratio of damping. Beside w_c h = 3 a step is about half a period, and
// what it conserves is 2 % from the energy: hence the many periods.
TEST(SplittingLimits, OfTheContactFrequencyDampsClosedContactsLittle) {
  constexpr double periods = 150.0;
  struct Case {
    double frequency, own, most;
  };
  for (const Case& of : {Case{1.75 / step, 0.1, 2.2e-5},
                         {1.75 / step, 0.3, 1.9e-4},
                         {1.75 / step, 0.7, 9e-4},
                         {contact, 0.1, 6.5e-5},
                         {contact, 0.3, 6e-4},
                         {contact, 0.6, 2.5e-3}}) {
    SCOPED_TRACE(testing::Message() << of.frequency << " rad/s beside " << of.own << " of it");
    const double own = of.own, w = of.frequency * std::hypot(1.0, own), amplitude = 1.0 / w;
    // rest at the equilibrium of both springs, deep enough that it never opens
    const double preload = 2.0 * amplitude * (1.0 + own * own) / (own * own),
                 rests = -preload / (1.0 + own * own);
    Scene scene = oscillator(of.frequency, own, 0.0, preload, periods * 2.0 * std::numbers::pi / w);
    scene.q0(0) = rests;
    StepChoice choice = choose_step(scene, splitting(step));
    choice.replay = 0.0;
    const History run = simulate_with(scene, choice, step);
    const auto size = [&](Eigen::Index k) { return std::hypot(run.v(0, k), w * (run.q(0, k) - rests)); };
    const double left = size(run.q.cols() - 1);
    EXPECT_GT(left, 0.0);
    EXPECT_LT(-std::log(left) / (2.0 * std::numbers::pi * periods), of.most);
    EXPECT_LT(left, 1.0 + 1e-3);
  }
}

// The penetration bends as the mode turns the node back, from the touch on: an impact in one interval a step neither gains nor loses energy by it.
TEST(SplittingLimits, OfTheHighestModeKeepsTheEnergyOfImpactsInOneInterval) {
  constexpr int phases_of_touch = 24;
  for (const auto& [own, most] : {std::pair(0.5, 4e-4), {1.0, 8e-4}, {2.0, 5e-3}}) {
    double sum = 0.0, squares = 0.0;
    for (int i = 0; i < phases_of_touch; ++i) {
      const double frequency = 0.6 / step, before = (3.5 + static_cast<double>(i) / phases_of_touch) * step;
      const double w = own * frequency;
      Scene scene = oscillator(frequency, own, 1e-9, 0.0, 12.0 * step);
      scene.q0(0) = -std::sin(w * before) / w;
      scene.v0(0) = std::cos(w * before);
      StepChoice choice = choose_step(scene, splitting(step));
      choice.replay = 0.0;
      choice.macro_steps = 1;
      EXPECT_EQ(choice.parts, 1);
      const double gain = -simulate_with(scene, choice, scene.duration).report.energy.residual() / 0.5;
      sum += gain / phases_of_touch;
      squares += gain * gain / phases_of_touch;
    }
    EXPECT_LT(std::abs(sum), most) << own;
    EXPECT_LT(std::sqrt(squares), 1.5 * most) << own;
  }
}

} // namespace splitting_limits_test
