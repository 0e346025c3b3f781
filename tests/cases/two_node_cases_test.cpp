// SPDX-License-Identifier: GPL-3.0-or-later
// Contacts between two nodes, as studies: a fixed second node, masses and bars that collide.
#include "mesh_text.hpp"
#include "transient_case.hpp"

namespace fretwork::cases::two_node_cases_test {
namespace {

using app::test::lone_points;
using app::test::MeshText;
using app::test::straight_line;
using app::test::together;
using std::numbers::pi;

/// The rule gives a run with contacts 20000 steps at least: single impacts of these runs come out better than
/// this.
constexpr double single_impact = 1e-4;
/// An impact begins and ends on a step: 1/1000 of the contacts here.
constexpr double counted_length = 2e-3;

/// Named points at given places.
MeshText points_at(const std::vector<std::pair<std::string, core::Vec3>>& points) {
  MeshText mesh;
  for (const auto& [name, place] : points) {
    mesh.points.emplace_back(name, static_cast<int>(mesh.nodes.size()));
    mesh.nodes.push_back(place);
  }
  return mesh;
}

/// A mass that moves along x alone.
std::string mass_along_x(const std::string& group, double mass) {
  return fmt::format(R"([[masses]]
group = "{0}"
mass = {1}
[[restraints]]
group = "{0}"
fixed = ["uy", "uz", "rx", "ry", "rz"]
)",
                     group, mass);
}

std::string moving_along_x(const std::string& group, double speed) {
  return fmt::format("[[initial]]\ngroup = \"{}\"\nvelocity = [{}, 0.0, 0.0]\n", group, speed);
}

/// Faces across x that stay on the sides where their nodes start.
std::string faces_across_x(const std::string& name, const std::string& first, const std::string& second,
                           const std::string& more) {
  return fmt::format(R"([[contacts]]
name = "{}"
group = "{}"
other = "{}"
obstacle = "plane_y"
axis = [0.0, 0.0, 1.0]
y_axis = [1.0, 0.0, 0.0]
{})",
                     name, first, second, more);
}

TEST(TwoNodeCases, MassOnASpringDecaysAgainstAFixedNode) {
  // A1 with a slab 1 m below the mass that overlaps it by 0.5 m
  constexpr double yield_of_stick = 2e-4, yield_at_last = 5e-3; // as with one node: friction_cases_test.cpp
  const double released = 0.85e-3 / std::sqrt(2.0);
  const Workshop folder;
  folder.write("mesh.msh", points_at({{"mass", {0, 0, 0}}, {"slab", {0, 0, -1}}}).text());
  const Results run = folder.run_text(fmt::format(R"([mesh]
file = "mesh.msh"
[[masses]]
group = "mass"
mass = 1.0
[[springs]]
group = "mass"
stiffness = [1e4, 1e4, 0, 0, 0, 0]
[[restraints]]
group = "mass"
fixed = ["uz", "rx", "ry", "rz"]
[[restraints]]
group = "slab"
fixed = "all"
[[contacts]]
name = "floor"
group = "mass"
other = "slab"
obstacle = "plane_z"
axis = [1.0, 0.0, 0.0]
distance_1 = 0.5
distance_2 = 1.0
normal_stiffness = 20.0
friction = 0.1
tangential_stiffness = 4e5
[[initial]]
group = "mass"
displacement = [{0:.17g}, {0:.17g}, 0.0]
[transient]
duration = 0.3
[output]
nodes = ["mass"]
every = {1:.17g}
)",
                                                  released, pi / 1000.0));
  const double extrema[] = {-4.5961941e-4, 3.1819805e-4, -1.7677670e-4, 3.5355339e-5};
  const auto& moved = run.node("mass").displacement;
  for (int n = 1; n <= 4; ++n)
    for (int axis = 0; axis < 2; ++axis)
      expect_value("A1, two nodes", run, fmt::format("extremum {} along {}, m", n, "xy"[axis]),
                   extrema[n - 1], moved(10 * n, axis), n == 4 ? yield_at_last : yield_of_stick,
                   n == 4 ? 0.0 : std::abs(extrema[0]));
  EXPECT_NEAR(moved(moved.rows() - 1, 0), extrema[3], 2.5e-6); // sticks, within the yield of its spring
  expect_value("A1, two nodes", run, "normal force, N", 10.0, run.statistics("floor")["normal_force"]["mean"],
               single_impact);
}

/// Case C1.
Results three_masses(const std::string& step) {
  const Workshop folder;
  folder.write("mesh.msh", points_at({{"wall_left", {0.0, 0, 0}},
                                      {"left", {0.1, 0, 0}},
                                      {"centre", {0.2, 0, 0}},
                                      {"right", {0.3, 0, 0}},
                                      {"wall_right", {0.4, 0, 0}}})
                               .text());
  const auto contact = [](const std::string& other, double stiffness) {
    return faces_across_x(
        other, "centre", other,
        fmt::format("distance_1 = 0.0\ndistance_2 = 0.0\nnormal_stiffness = {}\n", stiffness));
  };
  const auto spring = [](const std::string& side) {
    return fmt::format(
        "[[springs]]\ngroup = \"{0}\"\nother = \"wall_{0}\"\nstiffness = [1e3, 0, 0, 0, 0, 0]\n"
        "[[restraints]]\ngroup = \"wall_{0}\"\nfixed = \"all\"\n",
        side);
  };
  return folder.run_text("[mesh]\nfile = \"mesh.msh\"\n" + mass_along_x("left", 4.5) +
                         mass_along_x("centre", 10.0) + mass_along_x("right", 3.7) + spring("left") +
                         spring("right") + contact("left", 1e7) + contact("right", 3e6) + R"([[loads]]
group = "centre"
direction = [1.0, 0.0, 0.0]
harmonic = { amplitude = 60.0, frequency = 2.0 }
[output]
every = 1.0e-5
nodes = ["left", "centre", "right"]
[transient]
duration = 1.0
)" + step);
}

/// What [transient] says of a scheme; "" is the default.
constexpr const char* schemes[] = {"",
                                   "scheme = \"collocation\"\n",
                                   "scheme = \"energy_conserving\"\n",
                                   "scheme = \"devogelaere\"\n",
                                   "scheme = \"runge_kutta_54\"\ntolerance = 1e-8\n",
                                   "scheme = \"euler\"\nstep = 1e-6\n"};

void expect_three_masses(const std::string& name, const std::string& step, double tolerance, double of_left) {
  const Results run = three_masses(step);
  const Eigen::Index i = at(run, 0.68044);
  expect_value(name.c_str(), run, "force between left and centre at 0.68044 s, N", 1698.44669,
               run.contact("left").normal_force(i), tolerance);
  expect_value(name.c_str(), run, "centre, m", -0.100235874, run.node("centre").displacement(i, 0),
               tolerance);
  expect_value(name.c_str(), run, "left, m", -6.602905e-5, run.node("left").displacement(i, 0), of_left);
}

TEST(TwoNodeCases, ThreeMassesMeetOneSidedContacts) {
  // The left mass turns back here, 1500 times nearer to its place than the centre: with the automatic steps of 5e-5 s
  // it is some 1e-6 m off. The reference's own step, 1e-6 s, leaves it 7e-5 of its value off the limit.
  expect_three_masses("C1", "", 2e-3, 2e-2);
  expect_three_masses("C1", "step = 1e-6", 1e-4, 2e-4);
  for (const char* scheme : schemes) // up to 2.5e-6 m off
    expect_three_masses("C1", scheme, 2e-3, 5e-2);
}

void expect_bars_collide(const std::string& scheme) {
  // Exact from the first touch on; 20 modes a bar carry the front of the wave.
  constexpr double accepted = 0.05;
  const double gap = 1e-5, speed = 1.0, area = 4e-4, density = 7800.0, modulus = 2e11, length = 1.0;
  const double wave = std::sqrt(modulus / density);
  const Workshop folder;
  folder.write("mesh.msh", together(straight_line("striker", {gap, 0, 0}, {length + gap, 0, 0}, 50),
                                    straight_line("struck", {-length, 0, 0}, {0, 0, 0}, 50))
                               .text());
  const auto bar = [](const std::string& group) {
    return fmt::format(R"([[beams]]
group = "{0}"
material = "steel"
section = "bar"
[[restraints]]
group = "{0}"
fixed = ["uy", "uz", "rx", "ry", "rz"]
)",
                       group);
  };
  const Results run = folder.run_text(R"([mesh]
file = "mesh.msh"
[materials.steel]
young_modulus = 2.0e11
poisson_ratio = 0.0
density = 7800.0
[sections.bar]
shape = "rectangle"
height_y = 0.02
height_z = 0.02
)" + bar("striker") + bar("struck") + R"([[restraints]]
group = "struck_begin"
fixed = "all"
[modes]
count = 20
damping = 0.001
)" + moving_along_x("striker", -speed) +
                                      faces_across_x("ends", "striker_begin", "struck_end",
                                                     "distance_1 = 0.0\ndistance_2 = 0.0\n"
                                                     "normal_stiffness = 5e9\nnormal_damping = 2e4\n") +
                                      R"([output]
every = 1.0e-5
nodes = ["striker_begin"]
[transient]
duration = 1.2e-3
)" + scheme);
  const double exact[] = {-1.0e-4, -1.949684e-4, -9.496835e-5, 1.00633e-5, 2.100633e-4};
  const auto& moved = run.node("striker_begin").displacement;
  for (int k = 0; k < 5; ++k) {
    const double since = 2e-4 * (k + 1);
    expect_value("C2", run, fmt::format("end of the striker {:.1f} ms after the touch, m", 1e3 * since),
                 exact[k], moved(at(run, since + gap / speed), 0) + gap, accepted, 1.97e-4);
  }
  const auto& ends = run.statistics("ends");
  expect_value("C2", run, "mean force in contact, N", 0.5 * area * density * wave * speed,
               ends["normal_force_in_contact"]["mean"], accepted);
  expect_value("C2", run, "length of the contact, s", 4.0 * length / wave, ends["contact_duration"]["max"],
               accepted);
  expect_value("C2", run, "impulse, N s", 2.0 * area * density * length * speed,
               ends["normal_force"]["mean"].get<double>() * 1.2e-3, accepted);
}

TEST(TwoNodeCases, BarsCollideAsSaintVenantSays) {
  for (const char* scheme : schemes)
    expect_bars_collide(scheme);
}

void expect_collision(const std::string& scheme, double ratio, double first, double second, double duration,
                      double force) {
  const double stiffness = 4e5, mass = 2.0 * 3.0 / 5.0;
  const Workshop folder;
  folder.write("mesh.msh", lone_points({"first", "second"}).text());
  const Results run = folder.run_text(
      "[mesh]\nfile = \"mesh.msh\"\n" + mass_along_x("first", 2.0) + mass_along_x("second", 3.0) +
      moving_along_x("first", 1.0) +
      faces_across_x(
          "faces", "first", "second",
          fmt::format("distance_1 = 0.5\ndistance_2 = 0.5\nnormal_stiffness = {}\nnormal_damping = {}\n",
                      stiffness, 2.0 * ratio * std::sqrt(stiffness * mass))) +
      R"([output]
nodes = ["first", "second"]
[transient]
duration = 0.01
)" + scheme);
  const std::string name = fmt::format("C3, xi = {}", ratio);
  const Eigen::Index last = run.archive.series.time.size() - 1;
  expect_value(name.c_str(), run, "speed of the first after, m/s", first, run.node("first").velocity(last, 0),
               single_impact, 1.0);
  expect_value(name.c_str(), run, "speed of the second after, m/s", second,
               run.node("second").velocity(last, 0), single_impact);
  const auto& faces = run.statistics("faces");
  expect_value(name.c_str(), run, "length of the contact, s", duration, faces["contact_duration"]["max"],
               std::max(counted_length, run.summary["transient"]["step_max_s"].get<double>() / duration));
  expect_value(name.c_str(), run, "largest force, N", force, faces["normal_force"]["max"], single_impact);
}

TEST(TwoNodeCases, FreeMassesCollide) {
  for (const char* scheme : schemes)
    expect_collision(scheme, 0.0, -0.2, 0.8, 5.441398e-3, 692.820);
}

TEST(TwoNodeCases, FreeMassesCollideWithADamper) {
  for (const char* scheme : schemes)
    expect_collision(scheme, 0.1, -0.04644764, 0.69763176, 5.120073e-3, 609.782);
}

} // namespace
} // namespace fretwork::cases::two_node_cases_test
