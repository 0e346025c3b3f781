// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The numbers behind the pictures of doc/contact.md, as JSON on standard output, every one from the functions
/// of `contact` that a run uses. SI units.
///
///     obstacles  gap on a square grid about the origin, row by row (z rises by rows, y along them), and
///                the normal at fewer places, as [y, z, n_y, n_z]
///     impacts    a free mass m thrown at the wall, m p'' = -F_N(p, p'), by Runge-Kutta 4: force and
///                penetration until it is back at p = 0, and the speed it leaves with over the one it came with
///     cycles     a contact moved along its tangent, x(t) = X(t) sin(2 pi f t) with X rising linearly, under
///                constant F_N: mean force of each step at its middle displacement, and the spring's force after it
#include "contact/friction_law.hpp"
#include "contact/normal_law.hpp"
#include "contact/obstacle.hpp"
#include "contact/restitution.hpp"
#include "contact/support_shapes.hpp"
#include <cstdio>
#include <numbers>
#include <vector>

namespace {

using namespace fretwork::contact;

constexpr int grid = 160; // squares along a side of the map of the gap; corners of the shapes are its nodes
constexpr int arrow_columns = 10; // even, and no common odd multiple with the rows: no arrow stands on an
constexpr int arrow_rows = 12;    // axis or a diagonal, where the normal of a symmetric obstacle jumps

/// A JSON list, six digits each: the last bits of a compiler's arithmetic do not show.
template <class Values> void print_list(const char* name, const Values& values) {
  std::printf("\"%s\": [", name);
  const char* separator = "";
  for (const double value : values) {
    std::printf("%s%.6g", separator, value);
    separator = ", ";
  }
  std::printf("]");
}

struct Field {
  const char* name;
  const char* title;
  double half_width; ///< m, of the square shown
  Obstacle obstacle;
};

std::vector<Field> fields() {
  constexpr double tube = 9.525e-3; // radius, m
  constexpr double degree = std::numbers::pi / 180.0;
  const std::vector<PolarPoint> hole{{0.0, 0.30e-3},          {50 * degree, 0.34e-3},
                                     {90 * degree, 0.16e-3},  {130 * degree, 0.34e-3},
                                     {200 * degree, 0.30e-3}, {290 * degree, 0.32e-3}};
  const BroachedHole trefoil{tube + 0.2e-3, tube + 2.5e-3, 3, 25 * degree, 90 * degree};
  const BroachedHole quatrefoil{tube + 0.2e-3, tube + 0.23e-3, 4, 25 * degree, 0.0};
  return {
      {"circle", "circle, g = 0.25 mm", 0.4e-3, drilled_hole(tube, tube + 0.25e-3)},
      {"plane_y", "plane_y, g = 0.25 mm", 0.4e-3, PlanePair{0.25e-3, PlaneAxis::y}},
      {"stop_y", "stop_y, g = 0.15 mm", 0.4e-3, Stop{0.15e-3, PlaneAxis::y}},
      {"profile", "profile of six points", 0.4e-3, Profile(hole)},
      {"trefoil", "trefoil, 0.2 mm over the lands", 0.4e-3, BroachedSpace(tube, trefoil)},
      {"quatrefoil", "quatrefoil, 0.2 mm, lobes 0.23 mm", 0.4e-3, BroachedSpace(tube, quatrefoil)},
      {"bars_two", "bars_y on two sides, 0.2 mm", 0.4e-3,
       flat_bars(tube, tube + 0.2e-3, PlaneAxis::y, BarSides::two)},
      {"bars_one", "bars_y on one side, 0.2 mm", 0.4e-3,
       flat_bars(tube, tube + 0.2e-3, PlaneAxis::y, BarSides::one)},
      {"egg_crate", "egg_crate, 0.3 and 0.2 mm", 0.4e-3, egg_crate(tube, tube + 0.3e-3, tube + 0.2e-3)},
      {"round_pair", "circle of two nodes, distances 9 and 6 mm", 30e-3, RoundPair{15e-3}},
      {"ring", "circle_inside, distances 9.5 and 12 mm", 4e-3, Circle{12e-3 - 9.5e-3}},
      {"facing_planes", "plane_y of two nodes, 2 and 3 mm, s = +1", 10e-3,
       FacingPlanes{5e-3, PlaneAxis::y, 1.0}},
  };
}

/// Middle of square i of n across the picture.
double across(const Field& field, int i, int n) { return field.half_width * ((2.0 * i + 1.0) / n - 1.0); }

void print(const Field& field) {
  std::vector<double> gaps, arrows;
  for (int row = 0; row <= grid; ++row)
    for (int column = 0; column <= grid; ++column)
      gaps.push_back(locate(field.obstacle, field.half_width * (2.0 * column / grid - 1.0),
                            field.half_width * (2.0 * row / grid - 1.0))
                         .gap);
  for (int row = 0; row < arrow_rows; ++row)
    for (int column = 0; column < arrow_columns; ++column) {
      const double y = across(field, column, arrow_columns), z = across(field, row, arrow_rows);
      const Location at = locate(field.obstacle, y, z);
      arrows.insert(arrows.end(), {y, z, at.ny, at.nz});
    }
  std::printf("\"%s\": {\"title\": \"%s\", \"half_width\": %g, ", field.name, field.title, field.half_width);
  print_list("gap", gaps);
  std::printf(", ");
  print_list("arrows", arrows);
  std::printf("}");
}

void print_impact(const NormalLaw& law, double mass, double speed) {
  const double h = 1e-3 * std::sqrt(mass / law.stiffness);
  constexpr int kept = 20; // one step of so many is shown
  const auto slope = [&](double p, double v) { return -normal_force(law, p, v) / mass; };
  double p = 0.0, v = speed;
  std::vector<double> penetrations, forces;
  for (int step = 0; p >= 0.0; ++step) {
    if (step % kept == 0) {
      penetrations.push_back(p);
      forces.push_back(normal_force(law, p, v));
    }
    const double v1 = v, a1 = slope(p, v1);
    const double v2 = v + 0.5 * h * a1, a2 = slope(p + 0.5 * h * v1, v2);
    const double v3 = v + 0.5 * h * a2, a3 = slope(p + 0.5 * h * v2, v3);
    const double v4 = v + h * a3, a4 = slope(p + h * v3, v4);
    p += h / 6.0 * (v1 + 2.0 * v2 + 2.0 * v3 + v4);
    v += h / 6.0 * (a1 + 2.0 * a2 + 2.0 * a3 + a4);
  }
  std::printf("{\"speed\": %g, \"restitution\": %.6g, ", speed, -v / speed);
  print_list("penetration", penetrations);
  std::printf(", ");
  print_list("force", forces);
  std::printf("}");
}

void print_impacts(const char* name, const char* title, const NormalLaw& law, double mass) {
  std::printf("\"%s\": {\"title\": \"%s\", \"impacts\": [", name, title);
  print_impact(law, mass, 0.1);
  for (const double speed : {0.2, 0.3}) {
    std::printf(",\n");
    print_impact(law, mass, speed);
  }
  std::printf("]}");
}

void print_cycles(const char* name, const char* title, const FrictionLaw& law) {
  constexpr double normal_force = 100.0, frequency = 100.0, largest = 160e-6; // N, Hz, m
  constexpr int cycles = 3, steps = 400;                                      // steps a cycle
  const double h = 1.0 / (frequency * steps);
  const FrictionTable table = friction_table(law, h);
  FrictionMemory memory;
  std::vector<double> displacements, forces, springs, slides;
  double x = 0.0;
  for (int step = 1; step <= cycles * steps; ++step) {
    const double turns = static_cast<double>(step) / steps;
    const double next = largest * turns / cycles * std::sin(2.0 * std::numbers::pi * turns);
    const Friction friction = step_friction_line(law, table, memory, normal_force, (next - x) / h, 0.0);
    memory = close_step(law, table, memory, friction, {0.0, next - x}).memory;
    displacements.push_back(0.5 * (x + next));
    forces.push_back(friction.force.t);
    springs.push_back(memory.spring.t);
    slides.push_back(friction.slides);
    x = next;
  }
  std::printf("\"%s\": {\"title\": \"%s\", \"stiffness\": %g, \"damping\": %g, \"frequency\": %g,\n", name,
              title, law.stiffness, law.damping, frequency);
  std::printf("\"static_bound\": %g, \"dynamic_bound\": %g,\n", law.mu_static * normal_force,
              law.mu_dynamic * normal_force);
  print_list("displacement", displacements);
  std::printf(",\n");
  print_list("force", forces);
  std::printf(",\n");
  print_list("spring", springs);
  std::printf(",\n");
  print_list("slides", slides);
  std::printf("}");
}

} // namespace

int main() {
  std::printf("{\"obstacles\": {\n");
  const char* separator = "";
  for (const Field& field : fields()) {
    std::printf("%s", separator);
    print(field);
    separator = ",\n";
  }
  constexpr double stiffness = 1e6, mass = 1.0, restitution = 0.7, speed = 0.2; // N/m, kg, -, m/s
  std::printf("},\n\"impacts\": {\n");
  print_impacts("normal_reference", "reference, K_N = 10⁶ N/m, m = 1 kg, restitution = 0.7",
                {stiffness, damping_of_restitution(restitution, stiffness, mass), 0.0}, mass);
  std::printf(",\n");
  print_impacts("normal_hunt_crossley", "hunt_crossley, K_N = 10⁶ N/m, m = 1 kg, 0.7 at 0.2 m/s",
                {stiffness, 0.0, dissipation_of_restitution(restitution, speed)}, mass);
  FrictionLaw friction{5e5, 700.0, 0.3, 0.3, FrictionMemoryKind::return_map};
  std::printf("},\n\"cycles\": {\n");
  print_cycles("friction_return_map", "return_map, µ = 0.3, F_N = 100 N", friction);
  friction.kind = FrictionMemoryKind::reference;
  std::printf(",\n");
  print_cycles("friction_reference", "reference, µ = 0.3, F_N = 100 N", friction);
  friction = {5e5, 700.0, 0.45, 0.3, FrictionMemoryKind::return_map};
  std::printf(",\n");
  print_cycles("friction_static_dynamic", "return_map, static 0.45, dynamic 0.3, F_N = 100 N", friction);
  std::printf("}}\n");
  return 0;
}
