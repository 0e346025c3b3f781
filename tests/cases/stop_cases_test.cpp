// SPDX-License-Identifier: GPL-3.0-or-later
// Masses on springs and stops, as studies: closed forms of an undamped or damped oscillator in pieces.
#include "mesh_text.hpp"
#include "transient_case.hpp"

namespace fretwork::cases::stop_cases_test {
namespace {

using app::test::lone_points;
using std::numbers::pi;

/// The rule gives a run with contacts 20000 steps at least: single impacts of these runs come out better than
/// this.
constexpr double single_impact = 1e-4;
/// An impact begins and ends on a step: its length is known to a step, 1/600 of it in the example.
constexpr double counted_length = 2e-3;

/// A mass that moves along x alone, with a stop along +x.
std::string mass_and_stop(double mass, double stiffness, const std::string& more) {
  const std::string spring =
      stiffness > 0.0
          ? fmt::format("[[springs]]\ngroup = \"mass\"\nstiffness = [{:e}, 0, 0, 0, 0, 0]\n", stiffness)
          : "";
  return fmt::format(R"([mesh]
file = "mass.msh"
[[masses]]
group = "mass"
mass = {}
[[restraints]]
group = "mass"
fixed = ["uy", "uz", "rx", "ry", "rz"]
{}{})",
                     mass, spring, more);
}

Results run_mass(const Workshop& folder, const std::string& study) {
  folder.write("mass.msh", lone_points({"mass"}).text());
  return folder.run_text(study);
}

/// Two instants of a downward (or upward) passage of `level`, from the outputs: linear between them.
std::vector<double> passages(const Eigen::VectorXd& time, const Eigen::VectorXd& value, double level,
                             bool upward) {
  std::vector<double> out;
  for (Eigen::Index i = 1; i < time.size(); ++i) {
    const double a = value(i - 1) - level, b = value(i) - level;
    if (upward ? a < 0.0 && b >= 0.0 : a >= 0.0 && b < 0.0)
      out.push_back(time(i - 1) + (time(i) - time(i - 1)) * a / (a - b));
  }
  return out;
}

TEST(StopCases, MassOnASpringMeetsAnElasticStop) {
  const double mass = 100.0, k = 1e4, kn = 1e6, speed = 1.0;
  const double w1 = std::sqrt(k / mass), w2 = std::sqrt((k + kn) / mass);
  const Workshop folder;
  const Results run = folder.run(app::test::example("oscillator"), "results", {"--set", "output.every=1e-4"});
  const auto& stop = run.statistics("stop");
  expect_value("A2", run, "largest force, N", kn * speed / w2, stop["normal_force"]["max"], single_impact);
  expect_value("A2", run, "length of a contact, s", pi / w2, stop["contact_duration"]["mean"],
               counted_length);
  expect_value("A2", run, "speed at the impacts, m/s", speed, stop["impact_velocity"]["mean"], single_impact);
  const auto& force = run.contact("stop").normal_force;
  const auto& time = run.archive.series.time;
  const double first = pi / (2.0 * w2), second = 3.0 * pi / (2.0 * w2) + pi / w1;
  const auto peak_near = [&](double instant) {
    Eigen::Index at_peak = 0;
    const Eigen::Index middle = at(run, std::round(instant * 1e4) / 1e4);
    force.segment(middle - 100, 201).maxCoeff(&at_peak);
    return time(middle - 100 + at_peak);
  };
  expect_value("A2", run, "instant of the first peak, s", first, peak_near(first), 1e-4,
               second); // to an output of 1e-4 s
  expect_value("A2", run, "instant of the second peak, s", second, peak_near(second), 3e-4, second);
  double impulse = 0.0;
  for (Eigen::Index i = 0; i < 600; ++i)
    impulse += force(i) * 1e-4;
  expect_value("A2", run, "impulse, N s", 2.0 * kn * speed / (w2 * w2), impulse, single_impact);
}

TEST(StopCases, BallFallsOnAStop) {
  const Workshop folder;
  const Results run = run_mass(folder, mass_and_stop(1.0, 0.0, R"([gravity]
acceleration = [10.0, 0.0, 0.0]
[[initial]]
group = "mass"
velocity = [1.0, 0.0, 0.0]
[[contacts]]
name = "stop"
group = "mass"
obstacle = "stop_y"
axis = [0.0, 0.0, 1.0]
y_axis = [1.0, 0.0, 0.0]
gap = 2.0
normal_stiffness = 100.0
[transient]
duration = 1.2
[output]
every = 1.0e-4
)"));
  const auto& fall = run.contact("stop").displacement.col(0 + 1);
  const auto down = passages(run.archive.series.time, fall, 2.0, true),
             up = passages(run.archive.series.time, fall, 2.0, false);
  ASSERT_EQ(down.size(), 1u);
  ASSERT_EQ(up.size(), 1u);
  expect_value("A4", run, "touches the stop, s", 0.54031242374329, down[0], single_impact);
  expect_value("A4", run, "leaves it, s", 0.88545615307643, up[0], single_impact);
  expect_value("A4", run, "height at 1 s, m", -1.332162981855, -fall(at(run, 1.0)), single_impact);
  expect_value("A4", run, "height at 1.1 s, m", -0.856394405035, -fall(at(run, 1.1)), single_impact);
  const auto& stop = run.statistics("stop");
  expect_value("A4", run, "deepest penetration, m", 0.748074,
               stop["displacement"]["y"]["max"].get<double>() - 2.0, single_impact);
  expect_value("A4", run, "largest force, N", 74.8074, stop["normal_force"]["max"], single_impact);
}

/// Case A6: a free mass thrown at 1.5 m/s on a damped stop. @return speed after, longest contact, largest
/// force by the summary
void expect_restitution(double ratio, double restitution, double duration, double force) {
  const double mass = 2.0, stiffness = 5e5, speed = 1.5;
  const Workshop folder;
  const Results run = run_mass(
      folder, mass_and_stop(mass, 0.0,
                            fmt::format(R"([[initial]]
group = "mass"
velocity = [{}, 0.0, 0.0]
[[contacts]]
name = "stop"
group = "mass"
obstacle = "stop_y"
axis = [0.0, 0.0, 1.0]
y_axis = [1.0, 0.0, 0.0]
gap = 0.0
normal_stiffness = {}
normal_damping = {}
[transient]
duration = 0.02
[output]
every = 1.0e-5
)",
                                        speed, stiffness, 2.0 * ratio * std::sqrt(stiffness * mass))));
  const auto& series = run.contact("stop");
  const std::string name = fmt::format("A6, xi = {}", ratio);
  expect_value(name.c_str(), run, "restitution", restitution,
               -series.velocity(series.velocity.rows() - 1, 1) / speed, single_impact);
  const auto& stop = run.statistics("stop");
  expect_value(name.c_str(), run, "length of the contact, s", duration, stop["contact_duration"]["max"],
               counted_length);
  expect_value(name.c_str(), run, "largest force, N", force, stop["normal_force"]["max"], single_impact);
}

TEST(StopCases, ElasticStopGivesTheSpeedBack) { expect_restitution(0.0, 1.0, 6.283185e-3, 1500.0); }

TEST(StopCases, DampedStopGivesBackTheReferencesRestitution) {
  expect_restitution(0.1, 0.74407940, 5.912151e-3, 1320.216);
}

TEST(StopCases, MassBetweenTwoStopsOscillatesFasterTheHarderItHits) {
  const double periods[][2] = {{0.05, 1.0}, {0.1, 0.61212248}, {0.2, 0.39503082}, {0.5, 0.27698718}};
  const double k = 4.0 * pi * pi;
  const Workshop folder;
  for (const auto& [speed, period] : periods) {
    const Results run = run_mass(folder, mass_and_stop(1.0, k,
                                                       fmt::format(R"([[initial]]
group = "mass"
velocity = [{}, 0.0, 0.0]
[[contacts]]
name = "stops"
group = "mass"
obstacle = "plane_y"
axis = [0.0, 0.0, 1.0]
y_axis = [1.0, 0.0, 0.0]
gap = 0.01
normal_stiffness = {}
[transient]
duration = 2.2
[output]
every = 1.0e-3
)",
                                                                   speed, 24.0 * k)));
    const auto rises = passages(run.archive.series.time, run.contact("stops").displacement.col(1), 0.0, true);
    ASSERT_GE(rises.size(), 2u) << speed;
    const double measured = (rises.back() - rises.front()) / static_cast<double>(rises.size() - 1);
    expect_value("A8", run, fmt::format("period from {} m/s, s", speed), period, measured, single_impact);
  }
}

} // namespace
} // namespace fretwork::cases::stop_cases_test
