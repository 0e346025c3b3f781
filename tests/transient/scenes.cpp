// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenes.hpp"
#include "transient/splitting/splitting.hpp"
#include <Eigen/LU>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace fretwork::tests {

using namespace signals;
using namespace transient;
using namespace vibration;
using contact::PlaneAxis;

Scene mass_point(double mass, const Vec3& stiffness, double duration) {
  Scene scene;
  scene.system.stiffness = stiffness / mass;
  scene.system.damping = scene.q0 = scene.v0 = Vec3::Zero();
  scene.duration = duration;
  return scene;
}

void start(Scene& scene, double mass, const Vec3& displacement, const Vec3& velocity) {
  scene.q0 = std::sqrt(mass) * displacement;
  scene.v0 = std::sqrt(mass) * velocity;
}

ContactPoint contact_of(double mass, const contact::Support& support, const Vec3& rest) {
  return {"contact", support, rest, Eigen::Matrix3d::Identity() / std::sqrt(mass)};
}

ContactPoint pressed(double mass, double normal_force, const contact::FrictionLaw& friction) {
  constexpr double stiffness = 1e3;
  ContactPoint point = contact_of(mass, {contact::Stop{0.0, PlaneAxis::z}, {stiffness}, friction},
                                  {0, 0, normal_force / stiffness});
  point.b.row(2).setZero(); // the modes do not move it along the normal
  return point;
}

Load force_on(double mass, const Vec3& amplitude, const TimeFunction& function) {
  return {function, amplitude / std::sqrt(mass)};
}

Scene pressed_on_a_circle(const contact::NormalLaw& normal, double modal_damping,
                          const contact::FrictionLaw& friction, const Vec3& velocity) {
  Scene scene;
  scene.system.stiffness = Eigen::Vector4d(4.0, 30.0, 120.0, 0.0);
  scene.system.damping = modal_damping * Eigen::Vector4d(1.0, 2.0, 3.0, 0.5);
  ContactPoint point;
  point.support = {contact::Circle{1.0}, normal, friction};
  point.rest = Vec3(0.0, 0.0, 1.05);
  point.b.resize(3, 4);
  point.b << 1.0, 0.2, -0.3, 0.5, //
      0.1, 1.1, 0.4, -0.2,        //
      -0.2, 0.3, 0.9, 0.6;
  scene.contacts = {point};
  scene.loads = {{Constant{1.0}, point.b.transpose() * Vec3(0.0, 0.0, 50.0)},
                 {Harmonic{1.0, 3.0, 0.3}, point.b.transpose() * Vec3(4.0, 5.0, 3.0)}};
  scene.q0 = Eigen::Vector4d::Zero();
  scene.v0 = point.b.transpose() * (point.b * point.b.transpose()).inverse() * velocity;
  scene.duration = 0.3;
  return scene;
}

Scene rattling(int contacts, int modes, double duration) {
  Scene scene;
  const double pi = std::numbers::pi;
  scene.system.stiffness.resize(modes);
  for (int i = 0; i < modes; ++i)
    scene.system.stiffness(i) = std::pow(2.0 * pi * 8.0 * (1 + i / 2), 2);
  scene.system.damping = 0.01 * scene.system.stiffness.cwiseSqrt();
  const std::array<contact::Obstacle, 4> obstacles = {
      contact::Circle{2e-4}, contact::PlanePair{1e-4, PlaneAxis::y}, contact::Stop{5e-5, PlaneAxis::z},
      contact::PlanePair{1e-4, PlaneAxis::z}};
  for (int c = 0; c < contacts; ++c) {
    ContactPoint point;
    point.name = std::to_string(c);
    point.support = {obstacles[static_cast<std::size_t>(c) % 4],
                     {2e5, c % 3 == 0 ? 0.0 : 15.0},
                     {1e5, 30.0, 0.4, c % 2 == 0 ? 0.4 : 0.3}};
    if (c % 5 == 4)
      point.support.friction = {};
    point.b = Eigen::MatrixXd::Zero(3, modes);
    for (int i = 0; i < modes; ++i) {
      const double shape = std::sin((1 + i / 2) * pi * (c + 0.7) / (contacts + 0.3));
      point.b(1 + i % 2, i) = shape;
      point.b(0, i) = 0.1 * shape;
    }
    scene.contacts.push_back(point);
  }
  const Eigen::VectorXd even =
      Eigen::VectorXd::NullaryExpr(modes, [](Eigen::Index i) { return i % 2 == 0 ? 1.0 : 0.0; });
  scene.loads = {{Harmonic{3.0, 11.0, 0.2}, even},
                 {Harmonic{2.0, 17.0, 0.0}, Eigen::VectorXd::Ones(modes) - even}};
  scene.q0 = scene.v0 = Eigen::VectorXd::Zero(modes);
  scene.duration = duration;
  return scene;
}

Scene turning_bar(double duration) {
  constexpr double mass = 60.0, inertia = mass / 3.0; // kg, kg m2: of a length of 2 m
  Scene scene;
  scene.duration = duration;
  scene.system.stiffness = Eigen::Vector4d::Zero();
  scene.system.damping = Eigen::Vector4d::Constant(0.2);
  for (const auto& [x, gap] : {std::pair(-1.0, 1e-5), std::pair(0.0, 0.03), std::pair(1.0, 0.037)}) { // m
    ContactPoint point;
    point.name = std::to_string(scene.contacts.size());
    point.support = {contact::PlanePair{gap, PlaneAxis::y}, {1e5, 1e3}, {1e5, 2e3, 0.3, 0.3}};
    point.b = Eigen::MatrixXd::Zero(3, 4);
    for (const int d : {0, 1}) // moves along y, then along z
      point.b.block<1, 2>(1 + d, 2 * d) << 1.0 / std::sqrt(mass), x / std::sqrt(inertia);
    scene.contacts.push_back(point);
  }
  scene.q0 = Eigen::Vector4d::Zero();
  scene.v0 = Eigen::Vector4d(0.5 * std::sqrt(mass), 0.5 * std::sqrt(inertia), 0.1, 0.05);
  return scene;
}

bool closes_at_both_ends_at_once(const Scene& bar, double step) {
  const auto scheme = make_splitting(bar, step);
  while (scheme->next_time() < bar.duration)
    if (const Record& record = scheme->advance(); !record.active.empty())
      return record.active.size() == 2 && record.active.front() == 0 && record.active.back() == 2;
  return false;
}

namespace {

struct Keeper final : Sampler {
  explicit Keeper(History& r) : run(r) {}
  void state(std::int64_t index, double time, const double* q, const double* v) override {
    run.time(index) = time;
    run.q.col(index) = Eigen::Map<const Eigen::VectorXd>(q, run.q.rows());
    run.v.col(index) = Eigen::Map<const Eigen::VectorXd>(v, run.v.rows());
  }
  void forces(std::int64_t index, double, const double*, std::span<const ContactForce> contacts) override {
    for (std::size_t c = 0; c < contacts.size(); ++c) {
      const auto row = static_cast<Eigen::Index>(c);
      run.normal(row, index) = contacts[c].normal;
      run.along_x(row, index) = contacts[c].friction.x;
      run.along_t(row, index) = contacts[c].friction.t;
    }
  }
  void visit(core::StateArchive&) override {}
  History& run;
};

} // namespace

History simulate(const Scene& scene, const StepOptions& options, double every, double from) {
  return simulate_with(scene, choose_step(scene, options), every, from);
}

History simulate_with(const Scene& scene, const StepChoice& choice, double every, double from) {
  History run;
  run.choice = choice;
  const OutputGrid grid = output_grid(scene.duration, every);
  const auto contacts = static_cast<Eigen::Index>(scene.contacts.size());
  run.time.setZero(grid.count);
  run.q = run.v = Eigen::MatrixXd::Zero(scene.system.size(), grid.count);
  run.normal = run.along_x = run.along_t = Eigen::MatrixXd::Zero(contacts, grid.count);
  Keeper keeper(run);
  post::ContactStatistics statistics(scene.contacts, from);
  Observer* const observers[] = {&statistics};
  run.report = transient::run(scene, run.choice, observers, &keeper, grid);
  run.statistics = statistics.summaries();
  return run;
}

StepOptions splitting(std::optional<double> step) { return {SchemeKind::splitting, step}; }
StepOptions euler(std::optional<double> step) { return {SchemeKind::euler, step}; }
StepOptions collocation(std::optional<double> step) { return {SchemeKind::collocation, step}; }
StepOptions energy_conserving(std::optional<double> step) { return {SchemeKind::energy_conserving, step}; }

void Trace::step(const Record& record) {
  const ContactState& s = record.states[0];
  records.push_back({record.time, s.normal_force, contact::norm(s.friction), record.uy[0], record.uz[0],
                     s.friction_work, record.energy, s.normal_force > 0.0, s.slides});
}

std::vector<Trace::Entry> trace(const Scene& scene, const StepOptions& options) {
  const StepChoice choice = choose_step(scene, options);
  Trace keeper(static_cast<std::size_t>(choice.steps));
  Observer* const observers[] = {&keeper};
  (void)run(scene, choice, observers, nullptr, {});
  return std::move(keeper.records);
}

} // namespace fretwork::tests
