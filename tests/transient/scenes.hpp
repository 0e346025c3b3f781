// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Small scenes in modal coordinates and their runs.
#pragma once
#include "post/contact_statistics.hpp"
#include "transient/run.hpp"
#include <gtest/gtest.h>
#include <string>

namespace fretwork::tests {

using core::Vec3;

/// A mass point as a scene without contacts: 3 modes, along x_loc, y_loc and z_loc, q = sqrt(mass) u.
[[nodiscard]] transient::Scene mass_point(double mass, const Vec3& stiffness, double duration);

/// Initial displacement and velocity of a mass point.
void start(transient::Scene& scene, double mass, const Vec3& displacement, const Vec3& velocity);

/// A contact of the mass point.
[[nodiscard]] transient::ContactPoint contact_of(double mass, const contact::Support& support,
                                                 const Vec3& rest = Vec3::Zero());

/// A contact of the mass point along x_loc and y_loc that is pressed along z_loc with a constant normal
/// force, by a stop that overlaps it.
[[nodiscard]] transient::ContactPoint pressed(double mass, double normal_force,
                                              const contact::FrictionLaw& friction);

/// A force on the mass point.
[[nodiscard]] vibration::Load force_on(double mass, const Vec3& amplitude,
                                       const signals::TimeFunction& function);

/// A smooth path of 0.3 s: a node that stays pressed on a round obstacle (w_c about 40 rad/s), with four modes coupled by the contact.
/// @param modal_damping  scale of the modes' own   @param velocity  of the node at the start
[[nodiscard]] transient::Scene pressed_on_a_circle(const contact::NormalLaw& normal, double modal_damping,
                                                   const contact::FrictionLaw& friction,
                                                   const Vec3& velocity);

/// A tube between stops of all kinds, with damping and friction: every branch of a step is met.
[[nodiscard]] transient::Scene rattling(int contacts, int modes, double duration);

/// A rigid bar between pairs of planes at both ends and in the middle, with dampers and friction. It turns about the first end, which is at rest close to its
/// planes, until the other end hits: this pushes the first into its plane within the step, and splitting finds the forces of the step again.
[[nodiscard]] transient::Scene turning_bar(double duration);
/// Whether the first contacts of the bar that close in a run of splitting are those of both ends, in one step: that of the first end would stay at rest.
[[nodiscard]] bool closes_at_both_ends_at_once(const transient::Scene& bar, double step);

struct History {
  transient::StepChoice choice;
  transient::Report report;
  Eigen::VectorXd time;                     ///< outputs
  Eigen::MatrixXd q, v;                     ///< n x outputs
  Eigen::MatrixXd normal, along_x, along_t; ///< N, contacts x outputs
  std::vector<post::ContactSummary> statistics;
};
/// @param every  s, between outputs   @param from  s, start of the window of the statistics
[[nodiscard]] History simulate_with(const transient::Scene& scene, const transient::StepChoice& choice,
                                    double every, double from = 0.0);
[[nodiscard]] History simulate(const transient::Scene& scene, const transient::StepOptions& options,
                               double every, double from = 0.0);

/// Options: the scheme with a step, or with the automatic one.
[[nodiscard]] transient::StepOptions splitting(std::optional<double> step = {});
[[nodiscard]] transient::StepOptions euler(std::optional<double> step = {});
[[nodiscard]] transient::StepOptions collocation(std::optional<double> step = {});
[[nodiscard]] transient::StepOptions energy_conserving(std::optional<double> step = {});

/// A scheme as tests of closed forms run it: at its automatic step; Euler, whose order is 1, at one that is given.
struct Candidate {
  transient::SchemeKind kind;
  [[nodiscard]] bool first_order() const { return kind == transient::SchemeKind::euler; }
  [[nodiscard]] transient::StepOptions options(double euler_step) const {
    return {kind, first_order() ? std::optional(euler_step) : std::nullopt};
  }
  /// Relative error allowed.
  [[nodiscard]] double tolerance() const { return first_order() ? 2e-3 : 1e-3; }
};
inline constexpr Candidate candidates[] = {
    {transient::SchemeKind::splitting},   {transient::SchemeKind::collocation},
    {transient::SchemeKind::euler},       {transient::SchemeKind::energy_conserving},
    {transient::SchemeKind::devogelaere}, {transient::SchemeKind::runge_kutta_54}};
/// For GoogleTest.
inline std::string name_of_candidate(const testing::TestParamInfo<Candidate>& candidate) {
  return transient::name_of(candidate.param.kind);
}

/// What a test wants to see of every step.
struct Trace final : transient::Observer {
  explicit Trace(std::size_t steps) { records.reserve(steps); }
  struct Entry {
    double time, normal, tangential, uy, uz, friction_work;
    transient::Energy energy;
    bool closed, slides;
  };
  void step(const transient::Record& record) override;
  void visit(core::StateArchive& state) override { state(records); }
  std::vector<Entry> records; ///< of contact 0
};

/// Runs with a trace of contact 0.
[[nodiscard]] std::vector<Trace::Entry> trace(const transient::Scene& scene,
                                              const transient::StepOptions& options);

} // namespace fretwork::tests
