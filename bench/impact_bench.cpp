// SPDX-License-Identifier: GPL-3.0-or-later
// Single impacts of a free mass on a stop, at 40 phases of the time steps against the instant of contact: m = 1 kg, w_c = 1000 rad/s,
// v_n = 1 m/s; mu, v_t/v_n, xi_N, K_T/K_N of the grids below, C_T automatic (2 (K_T m)^1/2) or given by its ratio.
//
// Errors are relative to the energy that an impact exchanges: of the normal loss m v_n^2/2, of the tangential loss and of the slider's work
//     E = mu (1 + e) m v_n v_t
// (the impulse of full sliding times the speed), of the integral of F_N |v_T| that over mu. E exceeds what an impact can exchange where it
// sticks; the column "of the exchanged" has min(mu (1 + e) v_n, v_t) m v_t instead.
#include "bench/accuracy_study.hpp"
#include "bench/reference_solution.hpp"
#include "post/contact_statistics.hpp"
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace fretwork::bench {
namespace {

constexpr double frictions[] = {0.1, 0.2, 0.3, 0.6, 1.0}, speeds[] = {0.05, 0.2, 0.5, 1.0, 2.0, 4.0},
                 normal_ratios[] = {0.0, 0.14}, stiffness_ratios[] = {0.03, 1.0};
constexpr double stiffness = 1e6; ///< N/m, of 1 kg at 1 m/s
constexpr int phases = 40;
constexpr double steps_before = 20.0; ///< of the approach
constexpr double after = 0.03;        ///< s, of contact and departure: three contact times at least
constexpr double long_run =
    1000.0; ///< s: the automatic step is that of a run that its duration does not limit
constexpr double reference_share = 0.05; ///< of the resolution of the reference solution: impacts are short

enum Quantity : std::size_t { normal_loss, tangential_loss, slider_work, tangential_work, quantities };
using Energies = std::array<double, quantities>; ///< J

struct Impact {
  double mu, speed, normal_ratio, stiffness_ratio;
};

transient::Scene scene_of(const Impact& impact, std::optional<double> tangential_ratio) {
  transient::Scene scene;
  scene.system.stiffness = scene.system.damping = scene.q0 = Eigen::VectorXd::Zero(2); // along y and z
  scene.v0 = Eigen::Vector2d(1.0, impact.speed);
  scene.duration = long_run;
  const double k = impact.stiffness_ratio * stiffness;
  transient::ContactPoint point;
  point.name = "stop";
  point.support.obstacle = contact::Stop{0.0, contact::PlaneAxis::y};
  point.support.normal = {stiffness, 2.0 * impact.normal_ratio * std::sqrt(stiffness)};
  point.support.friction = {k, 2.0 * tangential_ratio.value_or(1.0) * std::sqrt(k), impact.mu, impact.mu};
  point.b = Eigen::MatrixXd::Zero(3, 2);
  point.b(1, 0) = point.b(2, 1) = 1.0;
  scene.contacts.push_back(point);
  return scene;
}

/// Speeds at the last output.
struct LastState final : transient::Sampler {
  double normal = 0.0, tangential = 0.0; ///< m/s
  void state(std::int64_t, double, const double*, const double* v) override {
    normal = v[0];
    tangential = v[1];
  }
  void forces(std::int64_t, double, const double*, std::span<const transient::ContactForce>) override {}
  void visit(core::StateArchive&) override {}
};

Energies energies(const Impact& impact, double normal, double tangential, double slider,
                  double tangential_work) {
  return {0.5 * (1.0 - normal * normal), 0.5 * (impact.speed * impact.speed - tangential * tangential),
          slider, tangential_work};
}

Energies reference_of(const Impact& impact, transient::Scene scene, double resolution) {
  scene.contacts[0].rest.y() = -0.01; // m: 10 ms before the contact
  scene.duration = 0.01 + after;
  ReferenceSolution reference(scene, resolution);
  reference.run(0.0);
  const ReferenceFigures f = reference.figures()[0];
  return energies(impact, reference.modes().v[0], reference.modes().v[1], f.friction_power * scene.duration,
                  f.work_rate * scene.duration);
}

Energies run_of(const Impact& impact, transient::Scene scene, transient::StepChoice choice, double phase) {
  const double before = (steps_before + phase) * choice.step;
  scene.contacts[0].rest.y() = -before;
  scene.duration = before + after;
  choice.steps = choice.steps > 0 ? static_cast<std::int64_t>(std::ceil(scene.duration / choice.step)) : 0;
  post::ContactStatistics statistics(scene.contacts, 0.0);
  transient::Observer* const observers[] = {&statistics};
  LastState last;
  const auto report = transient::run(scene, choice, observers, &last,
                                     transient::output_grid(scene.duration, scene.duration / 2));
  const post::ContactSummary c = statistics.summaries()[0];
  const double window = c.impulse / c.normal_mean; // s, of the records
  if (report.outcome != transient::Outcome::done)
    return {NAN, NAN, NAN, NAN};
  return energies(impact, last.normal, last.tangential, c.friction_work, c.work_rate * window);
}

struct Row {
  Impact impact;
  Energies bias{}, scatter{},
      strict{}; ///< means over phases of the error, of its size, of the error over what is exchanged
  double worst = 0.0;
};

Row row_of(const Impact& impact, const StudyOptions& options, std::optional<double> tangential_ratio) {
  const transient::Scene scene = scene_of(impact, tangential_ratio);
  const Energies reference = reference_of(impact, scene, reference_share * options.resolution);
  transient::StepChoice choice = transient::choose_step(scene, options.step);
  if (choice.steps > 0)
    choice.step *= options.step_factor;
  const double returned = std::sqrt(1.0 - 2.0 * reference[normal_loss]);
  const double impulse = impact.mu * (1.0 + returned), work = impulse * impact.speed,
               exchanged = std::min(impulse, impact.speed) * impact.speed;
  const Energies scale = {0.5, work, work, work / impact.mu},
                 least = {0.5, exchanged, exchanged, exchanged / impact.mu};
  Row row{impact};
  for (int phase = 0; phase < phases; ++phase) {
    const Energies e = run_of(impact, scene, choice, static_cast<double>(phase) / phases);
    for (std::size_t k = 0; k < quantities; ++k) {
      const double error = (e[k] - reference[k]) / phases;
      row.bias[k] += error / scale[k];
      row.scatter[k] += std::abs(error) / scale[k];
      row.strict[k] += error / least[k];
    }
  }
  for (const double b : row.bias)
    row.worst = std::max(row.worst, std::isfinite(b) ? std::abs(b) : 1e9);
  return row;
}

double largest(const Energies& e) {
  double out = 0.0;
  for (const double x : e)
    out = std::max(out, std::abs(x));
  return out;
}

} // namespace

void print_impacts(const StudyOptions& options, std::optional<double> tangential_ratio) {
  std::vector<Row> rows;
  for (const double mu : frictions)
    for (const double speed : speeds)
      for (const double normal_ratio : normal_ratios)
        for (const double stiffness_ratio : stiffness_ratios)
          rows.push_back(row_of({mu, speed, normal_ratio, stiffness_ratio}, options, tangential_ratio));
  std::sort(rows.begin(), rows.end(), [](const Row& a, const Row& b) { return a.worst > b.worst; });
  std::printf("Mean error over %d phases, %% of the impact's energy exchange; scatter: the largest of the "
              "means of |error|\n\n"
              "| mu | v_t/v_n | xi_N | K_T/K_N | normal loss | tangential loss | slider work | F_N v_T | "
              "scatter | of the exchanged |\n"
              "| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |\n",
              phases);
  std::size_t within = 0, strictly = 0;
  double mean = 0.0;
  for (const Row& r : rows) {
    std::printf("| %g | %g | %g | %g |", r.impact.mu, r.impact.speed, r.impact.normal_ratio,
                r.impact.stiffness_ratio);
    for (const double b : r.bias)
      std::printf(" %+.2f |", 100.0 * b);
    std::printf(" %.2f | %.2f |\n", 100.0 * largest(r.scatter), 100.0 * largest(r.strict));
    within += r.worst <= options.tolerance() ? 1 : 0;
    strictly += largest(r.strict) <= options.tolerance() ? 1 : 0;
    mean += r.worst / static_cast<double>(rows.size());
  }
  std::printf("\n%zu of %zu impacts within %.2g %%, %zu of the exchanged energy; mean of the worst %.2f %%\n",
              within, rows.size(), 100.0 * options.tolerance(), strictly, 100.0 * mean);
}

} // namespace fretwork::bench
