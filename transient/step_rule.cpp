// SPDX-License-Identifier: GPL-3.0-or-later
#include "transient/step_rule.hpp"
#include "core/error.hpp"
#include "transient/scheme_scope.hpp"
#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace fretwork::transient {
namespace {

/// Per run: they take milliseconds, single impacts come out to 1e-4, and statistics see the motion.
constexpr double least_steps = 20000;
/// More steps than this are a mistake in a value rather than a wish: days of computing.
constexpr double most_steps = 1e12;
/// A table whose points are closer than this share of the run does not rule the step: its mean over steps is taken.
constexpr double finest_table = 1e-6;
constexpr double points_per_period =
    30.0; ///< of the excitation at accuracy 0.01, with contacts: with 20 a soft scene misses 6 % of its impacts
/// Without contacts little else limits the step: linear interpolation then errs by (2 pi/200)^2/12 = 8e-5.
constexpr double linear_points_per_period = 200.0;
/// A run of an adaptive scheme has at least so many steps.
constexpr double least_adaptive_steps = 200;
/// w_t h at an accuracy of 0.01, whatever the damping: with splitting a stuck contact gives way by (w_t h)^2/4 too much.
constexpr double most_stuck = 0.5;
/// Of r_t h where dampers are implicit: above it sticking contacts ring.
constexpr double most_implicit = 4.0;
/// Of a damper's rate times the step of devogelaere, whose limit is 0.59.
constexpr double most_damped = 0.5;
/// The step of an accuracy of 0.04 (w_c h = 0.6) is the longest: no statistics are worth having above it.
constexpr double coarsest_accuracy = 0.04;
/// Steps of splitting that one of collocation takes the time of: measured 4 to 5 with 3 supports, 7 to 9 with 8 and 10.
double collocation_cost(const Scene& scene) { return 3.5 + 0.5 * static_cast<double>(scene.contacts.size()); }
/// w_c h and w_t h at an accuracy of 0.01. Measured on rattling tubes (bench_statistics), work rates: with splitting 0.7 % low at
/// w_c h = 0.5, and where contacts stick without much damping (stick_time) 3 % low at w_t h = 0.5, 0.9 % at 0.25, for they start to slide
/// inside steps; with collocation these are off by 2.8 % at 1, 1.4 % at 0.5.
/// damper: of r_t h where dampers are implicit; above 2 a step turns the speed of a sticking contact round, a fifth of it at 3.
struct Shares {
  double contact, stick, damper;
};
Shares shares(SchemeKind scheme) {
  switch (scheme) {
  case SchemeKind::splitting:
    return {0.45, 0.25, 3.0};
  case SchemeKind::collocation:
    return {0.5, 0.5, 2.0};
  default:
    return {0.3, 0.3, 2.0};
  }
}
/// Of w_max h: a step of splitting resonates with modes at w h = pi.
constexpr double before_resonance = 2.5;
/// Largest w_c h and w_t h without a warning: above it an impact changes the energy by more than 1 % or the statistics are wrong, however
/// stable the run (doc/schemes.md, Stability map).
double most_resolved(SchemeKind scheme) { return scheme == SchemeKind::devogelaere ? 0.75 : 1.0; }

/// Largest eigenvalue of D B B^T D over the rows chosen, D the square roots of the weights: that of the
/// smaller of the two products.
double largest_eigenvalue(const Eigen::MatrixXd& rows) {
  if (rows.rows() == 0)
    return 0.0;
  const Eigen::MatrixXd product = rows.rows() <= rows.cols() ? Eigen::MatrixXd(rows * rows.transpose())
                                                             : Eigen::MatrixXd(rows.transpose() * rows);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(product, Eigen::EigenvaluesOnly);
  return std::max(0.0, solver.eigenvalues().maxCoeff());
}

/// Rows weighted by (1/w + R)^-1, w the weights: contacts in series with the residual flexibility. R of the same rows.
Eigen::MatrixXd series_rows(const Eigen::MatrixXd& rows, const Eigen::VectorXd& weights,
                            const Eigen::MatrixXd& residual) {
  const Eigen::MatrixXd compliance = residual + Eigen::MatrixXd(weights.cwiseInverse().asDiagonal());
  return Eigen::LLT<Eigen::MatrixXd>(compliance).matrixL().solve(rows);
}

template <class Weight, class Directions>
Eigen::MatrixXd weighted_rows(const Scene& scene, Weight weight, Directions directions,
                              const Eigen::MatrixXd& residual = {}) {
  Eigen::MatrixXd rows(3 * static_cast<Eigen::Index>(scene.contacts.size()), scene.system.size());
  std::vector<Eigen::Index> number;
  std::vector<double> weights;
  Eigen::Index used = 0, c = 0;
  for (const ContactPoint& point : scene.contacts) {
    const double w = weight(point);
    const std::array<bool, 3> along = directions(point.support);
    for (int k = 0; k < 3; ++k)
      if (along[static_cast<std::size_t>(k)] && w > 0.0) {
        rows.row(used++) = point.b.row(k);
        weights.push_back(w);
        number.push_back(3 * c + k);
      }
    ++c;
  }
  rows.conservativeResize(used, Eigen::NoChange);
  const Eigen::VectorXd w = Eigen::Map<const Eigen::VectorXd>(weights.data(), used);
  if (residual.size() > 0)
    return series_rows(rows, w, residual(number, number));
  return w.cwiseSqrt().asDiagonal() * rows;
}

std::array<bool, 3> normal_rows(const contact::Support& support) {
  const auto [y, z] = contact::normal_directions(support.obstacle);
  return {false, y, z};
}

/// x_loc, and every direction across it that a tangent can take: all but the normal of a plane.
std::array<bool, 3> tangent_rows(const contact::Support& support) {
  const auto [y, z] = contact::normal_directions(support.obstacle);
  return {true, !y || (y && z), !z || (y && z)};
}

/// Largest rate of the structure's own damping, 1/s.
double structure_rate(const System& system) {
  if (system.size() == 0)
    return 0.0;
  if (system.damping_matrix.size() == 0)
    return system.damping.maxCoeff();
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(system.damping_matrix, Eigen::EigenvaluesOnly)
      .eigenvalues()
      .maxCoeff();
}

/// Penetration of a contact at t = 0, m, 0 where it is open.
double initial_overlap(const Scene& scene, const ContactPoint& point) {
  const core::Vec3 u = scene.place_at_start(point) + point.b * scene.q0;
  return std::max(0.0, -contact::locate(point.support.obstacle, u.y(), u.z()).gap);
}

/// Shortest time in which the dampers of sticking contacts give way to their springs, C_T/K_T, s; 0 without friction.
double shortest_relaxation(const Scene& scene) {
  double shortest = std::numeric_limits<double>::infinity();
  for (const ContactPoint& point : scene.contacts)
    if (const auto& law = point.support.friction; law.active())
      shortest = std::min(shortest, law.damping / law.stiffness);
  return std::isfinite(shortest) ? shortest : 0.0;
}

/// Largest rate at which the springs of sliding contacts follow their bound, K_T/C_T, 1/s.
double relaxation_rate(const Scene& scene) {
  double rate = 0.0;
  for (const ContactPoint& point : scene.contacts)
    if (const auto& law = point.support.friction;
        law.active() && law.kind == contact::FrictionMemoryKind::return_map && law.damping > 0.0)
      rate = std::max(rate, law.stiffness / law.damping);
  return rate;
}

/// The modes move exactly between the actions of the contacts.
bool moves_exactly(SchemeKind scheme) {
  return scheme == SchemeKind::splitting || scheme == SchemeKind::collocation ||
         scheme == SchemeKind::energy_conserving;
}

/// Time in which sticking contacts move, s: that of their vibration, or where it is longer that in which their dampers give way.
double stick_time(const StepChoice& c) {
  const double vibration = 1.0 / c.stick_frequency;
  return c.scheme == SchemeKind::splitting ? std::hypot(vibration, c.stick_relaxation) : vibration;
}

struct Term {
  double limit; ///< s
  std::string reason;
};

/// Whether a load has to do with the scene: it moves its modes, or may be that of a motion that carries its obstacles.
bool acts(const Load& load, const Scene& scene) {
  return !load.modal_force.isZero(0.0) ||
         std::any_of(scene.contacts.begin(), scene.contacts.end(),
                     [](const ContactPoint& contact) { return contact.carried.size() > 0; });
}

/// Shortest interval between points of the tables, s, those left out that are too fine to rule; 0 without tables.
double table_interval(const Scene& scene) {
  double shortest = 0.0;
  for (const Load& load : scene.loads)
    if (const auto* table = std::get_if<Table>(&load.function); table && acts(load, scene))
      for (std::size_t i = 1; i < table->time.size(); ++i)
        if (const double interval = table->time[i] - table->time[i - 1];
            interval > finest_table * scene.duration && (shortest == 0.0 || interval < shortest))
          shortest = interval;
  return shortest;
}

/// What limits the step. `fineness` scales with the square root of the accuracy, 1 for 0.01.
std::vector<Term> terms(const StepChoice& c, const Scene& scene, double fineness) {
  const bool exact = moves_exactly(c.scheme), contacts = !scene.contacts.empty(),
             collocation = c.scheme == SchemeKind::collocation;
  const double eps = 0.5 * fineness;
  std::vector<Term> out;
  const auto add = [&](double factor, double rate, const std::string& reason) {
    if (rate > 0.0)
      out.push_back({factor / rate, reason});
  };
  const double points = (contacts ? points_per_period : linear_points_per_period) / fineness;
  add(1.0 / points, c.excitation, fmt::format("the excitation ({:.4g} Hz)", c.excitation));
  if (const double interval = table_interval(scene); interval > 0.0)
    out.push_back({interval, fmt::format("the shortest interval of a table ({:.4g} s)", interval)});
  if (c.scheme ==
      SchemeKind::runge_kutta_54) // its steps follow its tolerance: it only must not step over what loads do
    return out;
  const bool devogelaere = c.scheme == SchemeKind::devogelaere;
  const double damped = devogelaere ? std::min(eps, most_damped) : eps;
  const Shares share = shares(c.scheme);
  const double resolved = most_resolved(c.scheme);
  add(std::min(share.contact * fineness, resolved), c.contact_frequency,
      fmt::format("the contact frequency {:.4g} rad/s", c.contact_frequency));
  if (c.stick_frequency > 0.0) {
    const double most = std::min(most_stuck * fineness, resolved) / c.stick_frequency;
    out.push_back({std::min(share.stick * fineness * stick_time(c), most),
                   fmt::format("the frequency of sticking contacts {:.4g} rad/s", c.stick_frequency)});
  }
  add(exact ? std::min(share.damper * fineness, most_implicit) : damped, c.damper_rate,
      fmt::format("the tangential dampers' rate {:.4g} 1/s", c.damper_rate));
  add(damped, c.explicit_rate, fmt::format("the dampers' rate {:.4g} 1/s", c.explicit_rate));
  // without contacts the flow of the splitting scheme is exact: only the statistics need to see the modes, in about 20 points a period
  const double mode = exact ? (contacts ? 5.0 : 0.6) : 1.0;
  if (!(collocation && contacts))
    add(exact && contacts ? std::min(eps * mode, before_resonance) : eps * mode, c.highest_mode,
        fmt::format("the highest mode {:.4g} rad/s", c.highest_mode));
  return out;
}

/// @throws core::Error where there would be absurdly many
std::int64_t count_steps(double duration, const StepChoice& c) {
  const double steps = std::ceil(duration / c.step * (1.0 - 1e-12));
  if (!(steps <= most_steps))
    throw core::Error(fmt::format(
        "the transient would take {:.3g} steps of {:.3g} s ({}); check the value that asks for them, "
        "or the duration",
        steps, c.step, c.reason));
  return static_cast<std::int64_t>(steps);
}

void warn(StepChoice& c) {
  const auto add = [&](double value, double limit, const char* name, const char* what) {
    if (value > limit)
      c.warnings.push_back(fmt::format(
          "the step {:.3g} s does not resolve {}: {} = {:.3g}, at most {} for results that can be "
          "trusted; take a smaller step or leave it out",
          c.step, what, name, value, limit));
  };
  const bool exact = moves_exactly(c.scheme);
  const bool collocation = c.scheme == SchemeKind::collocation;
  const double resolved = most_resolved(c.scheme);
  add(c.contact_frequency * c.step, resolved, "w_c h", "the contact frequency");
  add(c.stick_frequency * c.step, resolved, "w_t h", "the frequency of sticking contacts");
  const double damped = c.scheme == SchemeKind::devogelaere ? most_damped : 1.0;
  add(c.damper_rate * c.step, exact ? most_implicit : damped, "r_t h", "the tangential dampers");
  add(c.explicit_rate * c.step, damped, "r_e h", "the dampers");
  if (!collocation)
    add(c.highest_mode * c.step, exact ? 3.0 : 1.8, "w_max h", "the highest mode");
  add(c.excitation * c.step * 20.0, 2.0, "20 f h", "the excitation");
}

} // namespace

std::string name_of(SchemeKind kind) {
  switch (kind) {
  case SchemeKind::splitting:
    return "splitting";
  case SchemeKind::collocation:
    return "collocation";
  case SchemeKind::euler:
    return "euler";
  case SchemeKind::energy_conserving:
    return "energy_conserving";
  case SchemeKind::devogelaere:
    return "devogelaere";
  case SchemeKind::runge_kutta_54:
    return "runge_kutta_54";
  }
  return {};
}

std::string name_of(StepFailure failure) {
  switch (failure) {
  case StepFailure::none:
    return "no failure";
  case StepFailure::tolerance:
    return "no step that the time can resolve meets the tolerance; give a larger tolerance, or take another "
           "scheme";
  case StepFailure::contacts:
    return "the equations of the contacts were not solved, however small the step; take another scheme";
  }
  return {};
}

namespace {

StepChoice choice_of(const Scene& scene, const StepOptions& options, SchemeKind scheme) {
  StepChoice c;
  c.scheme = scheme;
  c.order = order_of_statistics(scene, scheme);
  const auto stiffness_n = [](const ContactPoint& point) { return point.support.normal.stiffness; };
  const auto stiffness_t = [](const ContactPoint& point) {
    return point.support.friction.active() ? point.support.friction.stiffness : 0.0;
  };
  const auto damping_t = [](const ContactPoint& point) {
    return point.support.friction.active() ? point.support.friction.damping : 0.0;
  };
  c.contact_frequency =
      std::sqrt(largest_eigenvalue(weighted_rows(scene, stiffness_n, normal_rows, scene.residual)));
  c.stick_frequency =
      std::sqrt(largest_eigenvalue(weighted_rows(scene, stiffness_t, tangent_rows, scene.residual)));
  c.stick_relaxation = shortest_relaxation(scene);
  c.damper_rate = largest_eigenvalue(weighted_rows(scene, damping_t, tangent_rows));
  if (c.scheme == SchemeKind::euler || c.scheme == SchemeKind::devogelaere) {
    const auto damping_n = [&scene](const ContactPoint& point) {
      return point.support.normal.damping_at(initial_overlap(scene, point));
    };
    c.explicit_rate = std::max(structure_rate(scene.system),
                               largest_eigenvalue(weighted_rows(scene, damping_n, normal_rows)));
    if (c.scheme == SchemeKind::devogelaere)
      c.explicit_rate = std::max(c.explicit_rate, relaxation_rate(scene));
  }
  if (scene.system.size() > 0)
    c.highest_mode = std::sqrt(scene.system.stiffness.maxCoeff());
  for (const Load& load : scene.loads)
    if (acts(load, scene))
      c.excitation = std::max(c.excitation, highest_frequency(load.function));

  const bool adaptive = c.scheme == SchemeKind::runge_kutta_54;
  c.tolerance = options.tolerance;
  if (options.step) {
    c.step = *options.step;
    c.reason = "given in the study";
    if (adaptive)
      return c;
    c.steps = count_steps(scene.duration, c);
    warn(c);
    return c;
  }
  const double accuracy = std::min(options.accuracy, coarsest_accuracy);
  const double fineness = std::sqrt(accuracy / 0.01);
  const double least = adaptive ? least_adaptive_steps : least_steps;
  c.step = scene.duration / least;
  c.reason = fmt::format("a run has at least {} steps", least);
  for (const Term& term : terms(c, scene, fineness))
    if (term.limit < c.step) {
      c.step = term.limit;
      c.reason = fmt::format("{} resolved for an accuracy of {}", term.reason, accuracy);
    }
  if (accuracy < options.accuracy)
    c.reason += fmt::format(" (no step is longer than that of {})", accuracy);
  if (adaptive)
    return c;
  c.steps = count_steps(scene.duration, c);
  c.step = scene.duration / static_cast<double>(c.steps);
  return c;
}

/// splitting, or collocation where it takes less time: where modes far above the contacts limit the step of splitting.
StepChoice cheapest(const Scene& scene, const StepOptions& options) {
  StepChoice splitting = choice_of(scene, options, SchemeKind::splitting);
  if (options.step || scene.contacts.empty())
    return splitting;
  if (const std::string why = out_of_scope(scene, SchemeKind::collocation); !why.empty()) {
    splitting.scheme_reason = "splitting, because collocation " + why;
    return splitting;
  }
  StepChoice collocation = choice_of(scene, options, SchemeKind::collocation);
  const double share = static_cast<double>(collocation.steps) / static_cast<double>(splitting.steps),
               step_cost = collocation_cost(scene), cost = step_cost * share;
  StepChoice& chosen = cost < 1.0 ? collocation : splitting;
  chosen.scheme_reason = fmt::format(
      "{}: collocation would need {:.2g} of the steps of splitting, each of about {:.2g} times the time",
      name_of(chosen.scheme), share, step_cost);
  return std::move(chosen);
}

} // namespace

StepChoice choose_step(const Scene& scene, const StepOptions& options) {
  const SchemeKind scheme = options.scheme.value_or(SchemeKind::splitting);
  check_scope(scene, scheme);
  return options.scheme ? choice_of(scene, options, scheme) : cheapest(scene, options);
}

int order_of_statistics(const Scene& scene, SchemeKind scheme) {
  for (const ContactPoint& point : scene.contacts)
    if (point.support.friction.active() &&
        point.support.friction.kind == contact::FrictionMemoryKind::reference)
      return 1;
  switch (scheme) {
  case SchemeKind::euler:
  case SchemeKind::runge_kutta_54:
    return 1;
  case SchemeKind::splitting:
  case SchemeKind::collocation:
  case SchemeKind::energy_conserving:
  case SchemeKind::devogelaere:
    return 2;
  }
  return {};
}

StepChoice halved(StepChoice choice) {
  if (choice.steps == 0) {
    choice.tolerance *= 0.5;
    return choice;
  }
  choice.step *= 0.5;
  choice.steps *= 2;
  return choice;
}

} // namespace fretwork::transient
