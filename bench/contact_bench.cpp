// SPDX-License-Identifier: GPL-3.0-or-later
// Cost of contacts: a look-up in profiles of 10 to 10 000 facets, `locate` of each obstacle, and what a contact
// adds to a step of the splitting scheme beside its projections.
#include "bench/tube_scene.hpp"
#include "contact/support_shapes.hpp"
#include "transient/contacts/packed_contacts.hpp"
#include "transient/scene/scheme.hpp"
#include "transient/splitting/splitting.hpp"
#include <algorithm>
#include <array>
#include <cstdio>
#include <functional>
#include <limits>
#include <numbers>
#include <random>
#include <time.h>

namespace {

using namespace fretwork;
using contact::Profile;

constexpr double turn = 2.0 * std::numbers::pi;
constexpr int repeats = 15; // of each measurement; the fastest counts: others were disturbed

/// Of this thread: what others take of the processor does not count.
double seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

template <class T> void keep(const T& value) { asm volatile("" : : "g"(&value) : "memory"); }

/// Nanoseconds of the fastest of several calls, over `count`.
double fastest(double count, const auto& work) {
  double best = std::numeric_limits<double>::infinity();
  for (int i = 0; i < repeats; ++i) {
    const double begin = seconds();
    work();
    best = std::min(best, seconds() - begin);
  }
  return 1e9 * best / count;
}

// Look-ups

using Nodes = std::vector<std::array<double, 2>>;

double random(double low, double high) {
  static std::mt19937_64 generator(1);
  return low + (high - low) * static_cast<double>(generator() >> 11) * 0x1p-53;
}

double cost_of_locate(const auto& obstacle, const Nodes& nodes) {
  return fastest(static_cast<double>(nodes.size()), [&] {
    double sum = 0.0;
    for (const auto& [y, z] : nodes) {
      const contact::Location at = locate(obstacle, y, z);
      sum += at.gap + at.ny + at.nz;
    }
    keep(sum);
  });
}

/// Where the nodes are: at a share of the boundary's distance from the origin.
struct Depth {
  const char* name;
  double low, high;
};
constexpr Depth depths[] = {{"within 1 %, inside", 0.99, 1.0},    {"within 1 %, outside", 1.0, 1.01},
                            {"within 10 %, inside", 0.9, 1.0},    {"within 10 %, outside", 1.0, 1.1},
                            {"within 50 %, inside", 0.5, 1.0},    {"within 50 %, outside", 1.0, 1.5},
                            {"anywhere in the hole", -1.0, -1.0}, {"middle, within 1 %", 0.0, 0.01}};

Nodes nodes_at(const Profile& profile, const Depth& depth) {
  const auto corners = profile.vertices();
  Nodes nodes(1 << 14);
  for (auto& [y, z] : nodes) {
    const auto k = static_cast<std::size_t>(random(0.0, 1.0) * static_cast<double>(corners.size()));
    const contact::PlanePoint a = corners[k], b = corners[(k + 1) % corners.size()];
    const double s = random(0.0, 1.0);
    const double share = depth.low < 0.0 ? std::sqrt(random(0.0, 1.0)) : random(depth.low, depth.high);
    y = share * (a.y + s * (b.y - a.y));
    z = share * (a.z + s * (b.z - a.z));
  }
  return nodes;
}

constexpr int facets[] = {10, 100, 1000, 10000};

struct Shape {
  const char* name;
  std::function<double(int, double)> radius; ///< of point k, at its angle
};

Profile make(const Shape& shape, int number) {
  std::vector<contact::PolarPoint> points;
  for (int k = 0; k < number; ++k)
    points.push_back({turn * k / number, shape.radius(k, turn * k / number)});
  return Profile(points);
}

void print_look_ups(const Shape& shape) {
  std::vector<Profile> profiles;
  for (const int number : facets)
    profiles.push_back(make(shape, number));
  for (const Depth& depth : depths) {
    std::printf("| %s, %s |", shape.name, depth.name);
    double first = 0.0, cost = 0.0;
    for (const Profile& profile : profiles) {
      cost = cost_of_locate(profile, nodes_at(profile, depth));
      first = first > 0.0 ? first : cost;
      std::printf(" %.1f |", cost);
    }
    std::printf(" %.2f |\n", cost / first);
  }
  std::printf("| %s, to build, us |", shape.name);
  for (const int number : facets)
    std::printf(" %.0f |", 1e-3 * fastest(1.0, [&] { keep(make(shape, number).inscribed()); }));
  std::printf(" |\n");
  std::fflush(stdout);
}

void print_obstacles() {
  const double t = 9.525e-3, third = turn / 3.0;
  const std::pair<const char*, contact::Obstacle> obstacles[] = {
      {"circle", contact::Circle{2e-4}},
      {"planes", contact::PlanePair{2e-4, contact::PlaneAxis::y}},
      {"stop", contact::Stop{2e-4, contact::PlaneAxis::z}},
      {"round pair", contact::RoundPair{2e-4}},
      {"facing planes", contact::FacingPlanes{2e-4, contact::PlaneAxis::y, 1.0}},
      {"egg crate", contact::egg_crate(t, t + 2e-4, t + 2e-4)},
      {"trefoil", contact::BroachedSpace(t, {t + 2e-4, t + 3e-3, 3, third / 4.0})},
      {"quatrefoil", contact::BroachedSpace(t, {t + 2e-4, t + 3e-3, 4, third / 5.0})}};
  for (const auto& [name, obstacle] : obstacles) {
    Nodes nodes(1 << 14);
    for (auto& [y, z] : nodes) { // about the land or plane: what a node in reach meets
      const double angle = random(0.0, turn), r = random(1.9e-4, 2.1e-4);
      y = r * std::cos(angle);
      z = r * std::sin(angle);
    }
    std::printf("| %s | %.1f |\n", name, cost_of_locate(obstacle, nodes));
  }
}

// Steps

constexpr int modes = 40, supports = 8, steps = 20000;
constexpr double step = 1e-4, preload = 50.0; // s; N on each support

enum class Motion { none, out_of_reach, sticking, sliding };

/// The tube, each support with a constant force that holds it shut, and a harmonic one across.
transient::Scene scene_of(Motion motion, int number) {
  bench::TubeScene tube;
  tube.modes = modes;
  tube.supports = number;
  tube.length = supports + 1.0;
  if (motion == Motion::out_of_reach)
    tube.gap = 1e6; // the load moves the tube far
  transient::Scene scene = bench::tube_scene(tube);
  scene.duration = 1.1 * steps * step;
  const double amplitude = motion == Motion::sticking ? 0.1 : 3.0; // of the friction bound
  vibration::Load hold{signals::Constant{preload}, Eigen::VectorXd::Zero(modes)};
  vibration::Load across{signals::Harmonic{amplitude * tube.friction * preload, 53.0},
                         Eigen::VectorXd::Zero(modes)};
  for (auto& contact : scene.contacts) {
    if (motion == Motion::sticking || motion == Motion::sliding)
      contact.rest.y() = tube.gap + preload / tube.normal_stiffness;
    hold.modal_force += contact.b.row(1).transpose();
    across.modal_force += contact.b.row(2).transpose();
  }
  scene.loads = {hold, across};
  if (motion == Motion::none)
    scene.contacts.clear();
  return scene;
}

/// Cost of a step, ns, and how many contacts of it are closed and slide.
struct Run {
  double ns = std::numeric_limits<double>::infinity(), closed = 0.0, sliding = 0.0;
};

void run_once(Run& run, const transient::Scene& scene) {
  const auto scheme = transient::make_splitting(scene, step);
  run.closed = run.sliding = 0.0;
  const double begin = seconds();
  for (int i = 0; i < steps; ++i)
    keep(scheme->advance().time);
  run.ns = std::min(run.ns, 1e9 * (seconds() - begin) / steps);
}

void count_closed(Run& run, const transient::Scene& scene) {
  const auto scheme = transient::make_splitting(scene, step);
  for (int i = 0; i < steps; ++i) {
    const transient::Record& record = scheme->advance();
    run.closed += static_cast<double>(record.active.size()) / steps;
    for (const int c : record.active)
      run.sliding += record.states[c].slides ? 1.0 / steps : 0.0;
  }
}

/// The projections of a step: displacements and velocities of all contacts, and impulses of `closed` of them.
double projections(const transient::Scene& scene, double closed) {
  using kernels::Array;
  const transient::PackedContacts contacts(scene.contacts, modes);
  const auto width = static_cast<std::size_t>(contacts.stride());
  const int np = contacts.padded_modes;
  Array q(static_cast<std::size_t>(np), 1.0), v = q, u(width), w(width);
  std::vector<const double*> rows;
  for (int c = 0; c < static_cast<int>(closed + 0.5); ++c)
    for (int component = 0; component < 2; ++component)
      rows.push_back(contacts.row(c, component));
  const std::vector<double> factors(rows.size(), 1e-9);
  return fastest(steps, [&] {
    for (int i = 0; i < steps; ++i) {
      kernels::gather_two(contacts.gather, q.data(), v.data(), u.data(), w.data());
      if (!rows.empty())
        kernels::scatter(np, static_cast<int>(rows.size()), rows.data(), factors.data(), v.data());
      keep(u[0]);
    }
  });
}

void print_steps(int number) {
  const Motion motions[] = {Motion::none, Motion::out_of_reach, Motion::sticking, Motion::sliding};
  const char* names[] = {"no contact", "out of reach", "closed, sticking", "closed, sliding"};
  transient::Scene scenes[4];
  Run runs[4];
  for (int i = 0; i < 4; ++i)
    scenes[i] = scene_of(motions[i], number);
  for (int i = 0; i < repeats; ++i) // in turn: a disturbance falls on all
    for (int m = 0; m < 4; ++m)
      run_once(runs[m], scenes[m]);
  for (int m = 1; m < 4; ++m) {
    count_closed(runs[m], scenes[m]);
    const double projected = projections(scenes[m], runs[m].closed),
                 own = runs[m].ns - runs[0].ns - projected;
    std::printf("| %d circles, %s | %.1f | %.1f | %.0f | %.0f | %.0f | %.1f |\n", number, names[m],
                runs[m].closed, runs[m].sliding, runs[m].ns, runs[0].ns, projected, own / number);
  }
  std::fflush(stdout);
}

} // namespace

int main() {
  std::printf("Fastest of %d repeats. Look-ups: ns each, mean of 16384 nodes.\n\n", repeats);
  std::printf(
      "| profile | 10 | 100 | 1000 | 10 000 facets | last/first |\n| --- | --- | --- | --- | --- | --- |\n");
  print_look_ups({"round", [](int, double) { return 1.0; }});
  print_look_ups({"three lobes", [](int, double angle) { return 0.7 + 0.4 * std::cos(3.0 * angle); }});
  print_look_ups({"spikes", [](int, double) { return random(0.9, 1.1); }});
  print_look_ups({"round, off its origin", [](int, double angle) { // which is 0.3 from its centre
                    const double c = 0.3 * std::cos(angle), s = 0.3 * std::sin(angle);
                    return std::sqrt(1.0 - s * s) - c;
                  }});
  print_look_ups({"four lands", [](int, double angle) { // as broached, of steep smooth flanks
                    return 1.15 + 0.15 * std::tanh(6.0 * std::cos(4.0 * angle));
                  }});
  print_look_ups({"deep spikes", [](int, double) { return random(0.1, 1.0); }});
  print_look_ups({"shallow spikes", [](int, double) { return random(0.99, 1.01); }});
  print_look_ups({"rough at all scales", [radius = 1.0](int k, double) mutable { // a walk
                    return radius = k == 0 ? 1.0 : radius * (1.0 + 0.005 * random(-1.0, 1.0));
                  }});
  std::printf("\n| obstacle | ns a locate |\n| --- | --- |\n");
  print_obstacles();
  std::printf("\nSplitting, %d modes, mean of %d steps; ns a step, the last column ns a contact.\n\n", modes,
              steps);
  std::printf("| scene | closed | sliding | step | without contacts | projections | a contact beside them |\n"
              "| --- | --- | --- | --- | --- | --- | --- |\n");
  for (const int number : {1, 3, 8, 32})
    print_steps(number);
}
