// SPDX-License-Identifier: GPL-3.0-or-later
// Coulomb friction under a constant normal force, which a plane that overlaps the node by 0.5 m makes with 20
// N/m: as studies; the law alone under imposed motion.
#include "contact/friction_law.hpp"
#include "mesh_text.hpp"
#include "transient_case.hpp"

namespace fretwork::cases::friction_cases_test {
namespace {

using app::test::lone_points;
using std::numbers::pi;

/// The closed form has a rigid stick; the friction spring yields 2.5e-6 m and its damper takes the energy: a
/// share of the first extremum.
constexpr double yield_of_stick = 2e-4;
/// The last extremum is 13 times smaller.
constexpr double yield_at_last = 5e-3;
/// 6000 steps a period; the closed form has a rigid stick, of which 1e-7 m yields.
constexpr double work_rate = 1e-4;
/// The rule gives a run with contacts 20000 steps at least: single impacts of these runs come out better than
/// this.
constexpr double single_impact = 1e-4;

/// 10 N along -z on a mass that is free along x and y.
std::string pressed_mass(double mass, double tangential_stiffness, const std::string& more) {
  return fmt::format(R"([mesh]
file = "mass.msh"
[[masses]]
group = "mass"
mass = {}
[[contacts]]
name = "floor"
group = "mass"
obstacle = "stop_z"
axis = [1.0, 0.0, 0.0]
gap = 0.0
offset = [0.0, -0.5]
normal_stiffness = 20.0
friction = 0.1
tangential_stiffness = {}
{})",
                     mass, tangential_stiffness, more);
}

Results run_mass(const Workshop& folder, const std::string& study) {
  folder.write("mass.msh", lone_points({"mass"}).text());
  return folder.run_text(study);
}

void expect_free_decay(const std::string& name, const std::string& transient) {
  const Workshop folder;
  const double released = 0.85e-3;
  const Results run =
      run_mass(folder, pressed_mass(1.0, 4e5,
                                    fmt::format(R"([[springs]]
group = "mass"
stiffness = [1e4, 1e4, 0, 0, 0, 0]
[[restraints]]
group = "mass"
fixed = ["uz", "rx", "ry", "rz"]
[[initial]]
group = "mass"
displacement = [{0:.17g}, {0:.17g}, 0.0]
[transient]
duration = 0.3
{1}
[output]
nodes = ["mass"]
every = {2:.17g}
)",
                                                released / std::sqrt(2.0), transient, pi / 1000.0)));
  const double extrema[] = {-4.5961941e-4, 3.1819805e-4, -1.7677670e-4, 3.5355339e-5};
  const auto& moved = run.node("mass").displacement;
  for (int n = 1; n <= 4; ++n)
    for (int axis = 0; axis < 2; ++axis) {
      const double tolerance = n == 4 ? yield_at_last : yield_of_stick;
      expect_value(name.c_str(), run, fmt::format("extremum {} along {}, m", n, "xy"[axis]), extrema[n - 1],
                   moved(10 * n, axis), tolerance, n == 4 ? 0.0 : std::abs(extrema[0]));
    }
  // it sticks: what moves still is the stuck spring, within its yield
  EXPECT_NEAR(moved(moved.rows() - 1, 0), extrema[3], 2.5e-6);
}

TEST(FrictionCases, MassOnASpringDecaysLinearlyAndSticks) { expect_free_decay("A1", ""); }

TEST(FrictionCases, EulersSchemeGivesTheSameDecay) { expect_free_decay("A1", "scheme = \"euler\""); }

Results shaken(double amplitude) {
  const Workshop folder;
  return run_mass(folder, pressed_mass(1.0, 9e6,
                                       fmt::format(R"([[springs]]
group = "mass"
stiffness = [3e-5, 0, 0, 0, 0, 0]
[[restraints]]
group = "mass"
fixed = ["uy", "uz", "rx", "ry", "rz"]
[[base_motion]]
direction = [1.0, 0.0, 0.0]
harmonic = {{ amplitude = {}, frequency = 1.0 }}
[transient]
duration = 12.0
[output]
statistics_from = 4.0
)",
                                                   amplitude)));
}

TEST(FrictionCases, ShakenMassWorksAsTheClosedFormSays) {
  const Results run = shaken(1.5);
  const auto& floor = run.statistics("floor");
  expect_value("A3, A = 1.5", run, "work rate, W", 0.40906245, floor["work_rate"], work_rate);
  expect_value("A3, A = 1.5", run, "friction power, W", 0.1 * 0.40906245, floor["friction_power"], work_rate);
}

TEST(FrictionCases, GentlyShakenMassSticks) {
  const Results run = shaken(0.99);
  expect_value("A3, A = 0.99", run, "work rate, W", 0.0, run.statistics("floor")["work_rate"], 1e-12, 0.4);
}

void expect_oblique_impact(double ratio, double slid, double bounced) {
  const double stiffness = 1e6;
  const Workshop folder;
  const Results run = run_mass(folder, fmt::format(R"([mesh]
file = "mass.msh"
[[masses]]
group = "mass"
mass = 1.0
[[restraints]]
group = "mass"
fixed = ["uz", "rx", "ry", "rz"]
[[initial]]
group = "mass"
velocity = [2.0, 1.0, 0.0]
[[contacts]]
name = "wall"
group = "mass"
obstacle = "stop_y"
axis = [1.0, 0.0, 0.0]
gap = 0.0
normal_stiffness = {0}
normal_damping = {1}
friction = 0.3
tangential_stiffness = {0}
[transient]
duration = 0.01
[output]
nodes = ["mass"]
)",
                                                   stiffness, 2.0 * ratio * std::sqrt(stiffness)));
  const auto& speed = run.node("mass").velocity;
  const std::string name = fmt::format("A7, xi = {}", ratio);
  expect_value(name.c_str(), run, "tangential speed after, m/s", slid, speed(speed.rows() - 1, 0),
               single_impact);
  expect_value(name.c_str(), run, "normal speed after, m/s", bounced, -speed(speed.rows() - 1, 1),
               single_impact);
}

TEST(FrictionCases, SlidingImpactLosesTheShareOfCoulomb) { expect_oblique_impact(0.0, 1.4, 1.0); }

TEST(FrictionCases, SlidingDampedImpactLosesTheShareOfCoulomb) {
  expect_oblique_impact(0.1, 1.4767762, 0.7440794);
}

/// Case A11: the law alone; slid length times normal force and the slider's work over the last of three
/// imposed cycles.
void expect_hysteresis(contact::FrictionMemoryKind kind) {
  const double amplitude = 1e-4, force = 50.0, mu = 0.3, stiffness = 1e6, frequency = 25.0;
  const int steps = 20000; // a cycle: the last partial step of each stick weighs 1/20000 of it
  const contact::FrictionLaw law{
      .stiffness = stiffness, .damping = 0.0, .mu_static = mu, .mu_dynamic = mu, .kind = kind};
  const double h = 1.0 / (frequency * steps);
  const contact::FrictionTable table = contact::friction_table(law, h);
  contact::FrictionMemory memory;
  double loss = 0.0, worked = 0.0;
  const auto place = [&](int k) { return amplitude * std::sin(2.0 * pi * k / steps); };
  for (int k = 0; k < 3 * steps; ++k) {
    const contact::Vec2 dx{0.0, place(k + 1) - place(k)};
    const contact::Friction friction = contact::step_friction_line(law, table, memory, force, dx.t / h, 0.0);
    ASSERT_LE(std::abs(friction.force.t), mu * force * (1.0 + 1e-15));
    const contact::FrictionStep step = contact::close_step(law, table, memory, friction, dx);
    memory = step.memory;
    if (k >= 2 * steps) {
      loss += step.friction_work + step.damper_work;
      worked += friction.slides ? force * std::abs(dx.t) : 0.0;
    }
  }
  const double slid = 4.0 * (amplitude - mu * force / stiffness);
  const double whole_steps = 1e-3;
  fmt::print("| A11 | loss a cycle, J | {:.9g} | {:.9g} | {:.1e} | {:.3g} | law alone |\n", mu * force * slid,
             loss, std::abs(loss / (mu * force * slid) - 1.0), h);
  EXPECT_NEAR(loss, mu * force * slid, whole_steps * mu * force * slid);
  fmt::print("| A11 | work rate, W | {:.9g} | {:.9g} | {:.1e} | {:.3g} | law alone |\n",
             frequency * force * slid, frequency * worked, std::abs(worked / (force * slid) - 1.0), h);
  EXPECT_NEAR(frequency * worked, frequency * force * slid, whole_steps * frequency * force * slid);
}

TEST(FrictionCases, HarmonicSlidingLosesTheAreaOfItsLoop) {
  expect_hysteresis(contact::FrictionMemoryKind::return_map);
  expect_hysteresis(contact::FrictionMemoryKind::reference);
}

} // namespace
} // namespace fretwork::cases::friction_cases_test
