// SPDX-License-Identifier: GPL-3.0-or-later
// Error against work, of every scheme, on the horizon on which trajectories can be compared (impacts are chaotic beyond), and drift of
// the energy against the step. Prints lines of CSV; bench/plots.py makes the tables and pictures of doc/benchmarks.md of them.
//
//   precision: displacement: largest difference of a contact's displacement at 20 instants, over the largest displacement;
//              force: the same of the normal force. The reference is runge_kutta_54 at 1e-11; its own error is the difference from 1e-10.
//   energy:    a mass on a spring without losses bounces off a stiff stop; a tube without losses rattles between three holes.
#include "bench/tube_scene.hpp"
#include "transient/run.hpp"
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <limits>
#include <numbers>
#include <time.h>

namespace {

using namespace fretwork;
using transient::Scene;
using transient::SchemeKind;

constexpr int instants = 20;
constexpr double reference_tolerance = 1e-11;
constexpr double longest_second = 1.0; // of processor time a run: finer ones are left out
constexpr int repeats = 3;             // the fastest counts: others were disturbed

double seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

struct NamedScene {
  const char* name;
  Scene scene;
};

Scene point(double mass, double stiffness, double duration) {
  Scene scene;
  scene.system.stiffness = Eigen::Vector3d::Constant(stiffness / mass);
  scene.system.damping = scene.q0 = scene.v0 = Eigen::Vector3d::Zero();
  scene.duration = duration;
  return scene;
}

/// 1 kg, 1 m/s onto a stop 2 mm away: w_c = 1000 rad/s, restitution about 0.85.
Scene single_impact() {
  Scene scene = point(1.0, 0.0, 0.0083);
  scene.v0.y() = 1.0;
  scene.contacts = {{"stop",
                     {contact::Stop{2e-3, contact::PlaneAxis::y}, {1e6, 100.0}, {}},
                     core::Vec3::Zero(),
                     Eigen::Matrix3d::Identity()}};
  return scene;
}

/// An oscillator of 20 Hz driven at 16 Hz that sticks and slides on a floor (Den Hartog's).
Scene friction_oscillator() {
  const double omega = 2.0 * std::numbers::pi * 20.0;
  Scene scene = point(1.0, omega * omega, 0.2);
  contact::FrictionLaw friction{4e6, 400.0, 0.1, 0.1};
  transient::ContactPoint floor{"floor",
                                {contact::Stop{0.0, contact::PlaneAxis::z}, {1e3}, friction},
                                {0, 0, 0.4},
                                Eigen::Matrix3d::Identity()};
  floor.b.row(2).setZero();
  scene.contacts = {floor};
  scene.loads = {{signals::Harmonic{100.0, 16.0}, Eigen::Vector3d::UnitY()}};
  return scene;
}

Scene tube(int modes, int supports, double length, double normal_stiffness, double duration) {
  bench::TubeScene tube;
  tube.modes = modes;
  tube.supports = supports;
  tube.length = length;
  tube.normal_stiffness = normal_stiffness;
  tube.duration = duration;
  return bench::tube_scene(tube);
}

std::vector<NamedScene> precision_scenes() {
  return {{"single impact", single_impact()},
          {"friction oscillator", friction_oscillator()},
          {"3 supports", tube(40, 3, 4.0, 1e6, 0.05)},
          {"10 supports", tube(60, 10, 11.0, 1e6, 0.05)},
          {"30 supports", tube(120, 30, 31.0, 1e6, 0.05)},
          {"3 supports, K_N 1e5", tube(40, 3, 4.0, 1e5, 0.05)},
          {"3 supports, K_N 1e8", tube(40, 3, 4.0, 1e8, 0.05)},
          {"3 supports, high modes", tube(120, 3, 4.0, 1e6, 0.05)}};
}

/// Displacements along y_loc and z_loc, and forces, of all contacts at the instants.
struct Path {
  Eigen::MatrixXd displacement, force;
  transient::Report report;
  double seconds = 0.0;
};

class Keeper final : public transient::Sampler {
public:
  Keeper(const Scene& scene, Path& path) : scene_(scene), path_(path), q_(scene.system.size()) {
    const auto contacts = static_cast<Eigen::Index>(scene.contacts.size());
    path.displacement.setZero(2 * contacts, instants + 1);
    path.force.setZero(contacts, instants + 1);
  }
  void state(std::int64_t index, double, const double* q, const double*) override {
    q_ = Eigen::Map<const Eigen::VectorXd>(q, q_.size());
    for (std::size_t c = 0; c < scene_.contacts.size(); ++c)
      path_.displacement.block(2 * static_cast<Eigen::Index>(c), index, 2, 1).noalias() =
          scene_.contacts[c].b.bottomRows(2).lazyProduct(q_);
  }
  void forces(std::int64_t index, double, const double*,
              std::span<const transient::ContactForce> contacts) override {
    for (std::size_t c = 0; c < contacts.size(); ++c)
      path_.force(static_cast<Eigen::Index>(c), index) = contacts[c].normal;
  }
  void visit(core::StateArchive&) override {} // never restarted

private:
  const Scene& scene_;
  Path& path_;
  Eigen::VectorXd q_;
};

Path path_of(const Scene& scene, const transient::StepOptions& options, int runs) {
  Path path;
  const auto choice = transient::choose_step(scene, options);
  path.seconds = std::numeric_limits<double>::infinity();
  for (int i = 0; i < runs; ++i) {
    Keeper keeper(scene, path);
    const double begin = seconds();
    path.report = transient::run(scene, choice, {}, &keeper,
                                 transient::output_grid(scene.duration, scene.duration / instants));
    path.seconds = std::min(path.seconds, seconds() - begin);
  }
  return path;
}

/// Largest difference over the largest value; without bound where they cannot be compared.
double difference(const Eigen::MatrixXd& a, const Eigen::MatrixXd& reference) {
  const double error = (a - reference).cwiseAbs().maxCoeff() / reference.cwiseAbs().maxCoeff();
  return std::isfinite(error) ? error : std::numeric_limits<double>::infinity();
}

void row(const char* scene, const std::string& scheme, double parameter, const Path& path,
         const Path& reference) {
  std::printf("%s;%s;%g;%lld;%.4g;%.3g;%.3g\n", scene, scheme.c_str(), parameter,
              static_cast<long long>(path.report.counts.evaluations), 1e6 * path.seconds,
              difference(path.displacement, reference.displacement), difference(path.force, reference.force));
  std::fflush(stdout);
}

void precision() {
  std::puts("scene;scheme;step or tolerance;evaluations;microseconds;displacement;force");
  for (const auto& [name, scene] : precision_scenes()) {
    transient::StepOptions options;
    options.scheme = SchemeKind::runge_kutta_54;
    options.tolerance = reference_tolerance;
    const Path reference = path_of(scene, options, 1);
    options.tolerance = 10.0 * reference_tolerance;
    row(name, "reference", options.tolerance, path_of(scene, options, 1), reference);
    for (double tolerance = 1e-2; tolerance > 0.5e-9; tolerance /= 10.0) {
      options.tolerance = tolerance;
      const Path path = path_of(scene, options, repeats);
      if (path.report.outcome == transient::Outcome::done)
        row(name, "runge_kutta_54", tolerance, path, reference);
      if (path.seconds > longest_second)
        break;
    }
    for (const SchemeKind scheme :
         {SchemeKind::splitting, SchemeKind::collocation, SchemeKind::energy_conserving, SchemeKind::euler,
          SchemeKind::devogelaere})
      for (double step = scene.duration / 128.0; step > 1e-8; step /= 2.0) {
        transient::StepOptions fixed;
        fixed.scheme = scheme;
        fixed.step = step;
        const Path path = path_of(scene, fixed, repeats);
        if (path.report.outcome == transient::Outcome::done)
          row(name, name_of(scheme), step, path, reference);
        if (path.seconds > longest_second || difference(path.displacement, reference.displacement) < 1e-6)
          break;
      }
  }
}

/// Energy at the end over that at the start, and its largest departure on the way.
struct Energies final : transient::Observer {
  double departure = 0.0, end = 1.0;
  void visit(core::StateArchive&) override {} // never restarted
  void step(const transient::Record& record) override {
    end = record.energy.stored / record.energy.initial;
    departure = std::max(departure,
                         std::isfinite(end) ? std::abs(end - 1.0) : std::numeric_limits<double>::infinity());
  }
};

/// 1 kg, w = 314 rad/s, 1 m/s, onto a stop of 1e9 N/m at 0: 200 impacts in 2 s.
Scene bouncing() {
  Scene scene = point(1.0, 314.0 * 314.0, 2.0);
  scene.v0.y() = 1.0;
  scene.contacts = {{"stop",
                     {contact::Stop{0.0, contact::PlaneAxis::y}, {1e9}, {}},
                     core::Vec3::Zero(),
                     Eigen::Matrix3d::Identity()}};
  return scene;
}

Scene rattling() {
  bench::TubeScene tube;
  tube.modes = 40;
  tube.supports = 3;
  tube.length = 4.0;
  tube.friction = 0.0;
  tube.duration = 2.0;
  Scene scene = bench::tube_scene(tube);
  scene.loads.clear();
  scene.system.damping.setZero();
  for (auto& contact : scene.contacts)
    contact.support.normal.damping = 0.0;
  scene.v0(0) = 0.3, scene.v0(1) = 0.2, scene.v0(4) = 0.2, scene.v0(7) = 0.1;
  return scene;
}

void energy() {
  std::puts("scene;scheme;w_c h;energy at the end;largest departure");
  const NamedScene scenes[] = {{"mass on a stop", bouncing()}, {"tube in three holes", rattling()}};
  for (const auto& [name, scene] : scenes)
    for (const SchemeKind scheme :
         {SchemeKind::splitting, SchemeKind::collocation, SchemeKind::energy_conserving, SchemeKind::euler,
          SchemeKind::devogelaere})
      for (const double wh : {0.05, 0.1, 0.2, 0.5, 1.0, 1.5, 2.0, 5.0}) {
        transient::StepOptions options;
        options.scheme = scheme;
        options.step = wh / transient::choose_step(scene, options).contact_frequency;
        Energies energies;
        transient::Observer* observers[] = {&energies};
        const auto report =
            transient::run(scene, transient::choose_step(scene, options), observers, nullptr, {});
        const bool lost = report.outcome != transient::Outcome::done;
        const double infinite = std::numeric_limits<double>::infinity();
        std::printf("%s;%s;%g;%.6g;%.3g\n", name, name_of(scheme).c_str(), wh, lost ? infinite : energies.end,
                    lost ? infinite : energies.departure);
        std::fflush(stdout);
      }
}

} // namespace

int main(int argc, char** argv) {
  if (argc == 2 && std::strcmp(argv[1], "precision") == 0)
    precision();
  else if (argc == 2 && std::strcmp(argv[1], "energy") == 0)
    energy();
  else
    return std::fputs("bench_precision precision | energy\n", stderr), 1;
}
