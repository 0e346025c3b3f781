// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Strang splitting of the modal motion and the contact forces, order 2 in displacement, velocity and force,
/// with damping and friction.
///
/// Between instants t_k = (k + 1/2) h the modes move freely: exact flow, loads linear in time
/// (oscillator.hpp; matrix_flow.hpp where a damping matrix couples them). At t_k the contacts act once for the whole step: contact_solver.hpp, with
/// residual flexibility flexible_contacts.hpp.
/// Stability: w_c h < 2.7, w_c^2 the largest eigenvalue of K_N^1/2 W K_N^1/2; h w_max away from multiples of
/// pi (mass_scaling.hpp). Accuracy asks for less (step_rule.hpp). Cost: one evaluation of the contacts a step. Energy: the work
/// of each action h f.w and of each flow are exact; the ledger's residual is what the contact laws' discrete
/// work lacks.
#include "transient/flexible_contacts.hpp"
#include "transient/load_sum.hpp"
#include "transient/mass_scaling.hpp"
#include "transient/matrix_flow.hpp"
#include "transient/obstacle_motion.hpp"
#include "transient/oscillator.hpp"
#include "transient/sliding_paths.hpp"
#include <algorithm>
#include <cmath>
#include <optional>

namespace fretwork::transient {
namespace {

/// Coupled modes stay where they are: their flow follows the table's.
kernels::FlowTable flow_table(const System& system, const MatrixFlow& coupled, double h) {
  kernels::FlowTable t;
  const auto n = static_cast<std::size_t>(kernels::padded(static_cast<int>(system.size())));
  for (kernels::Array* a :
       {&t.qq, &t.qv, &t.qf0, &t.qf1, &t.vq, &t.vv, &t.vf0, &t.vf1, &t.mq, &t.mv, &t.mf0, &t.mf1})
    a->assign(n, 0.0);
  for (Eigen::Index j = 0; j < system.size(); ++j) {
    constexpr StepCoefficients none{1, 0, 0, 0, 0, 1, 0, 0, 1, 0, 0, 0};
    const StepCoefficients s =
        coupled.couples(j) ? none : step_coefficients(system.stiffness(j), system.damping(j), h);
    const auto i = static_cast<std::size_t>(j);
    t.qq[i] = s.qq, t.qv[i] = s.qv, t.qf0[i] = s.qf0, t.qf1[i] = s.qf1;
    t.vq[i] = s.vq, t.vv[i] = s.vv, t.vf0[i] = s.vf0, t.vf1[i] = s.vf1;
    t.mq[i] = s.mq, t.mv[i] = s.mv, t.mf0[i] = s.mf0, t.mf1[i] = s.mf1;
  }
  return t;
}

class Splitting final : public Scheme {
public:
  /// @param scene  in the coordinates p of mass_scaling.hpp   @param shown  n, q = shown p; empty: all 1
  Splitting(const Scene& scene, double step, const Eigen::VectorXd& shown)
      : system_(with_diagonal(scene.system)), h_(step),
        loads_(scene.loads, scene.system.size(), scene.duration, step),
        contacts_(scene.contacts, scene.system.size()), motion_(contacts_),
        obstacles_(scene, contacts_, step), carried_(obstacles_.room()), memory_(contacts_, step),
        solver_(contacts_, step), trial_(contacts_.count), paths_(contacts_, step, scene.residual.size() == 0), rows_(contacts_),
        coupled_(system_, step), first_(flow_table(system_, coupled_, 0.5 * step)),
        full_(flow_table(system_, coupled_, step)) {
    const auto n = static_cast<std::size_t>(contacts_.padded_modes);
    for (kernels::Array* a : {&q_, &v_, &k_, &f_now_, &f_next_, &slope_, &impulse_})
      a->assign(n, 0.0);
    std::copy_n(scene.q0.data(), scene.q0.size(), q_.begin());
    std::copy_n(scene.v0.data(), scene.v0.size(), v_.begin());
    std::copy_n(system_.stiffness.data(), system_.size(), k_.begin());
    // With the slopes from the start to h/2 and on to 3h/2 the first two forces weigh h/4 and 3h/4: both stand for the first step.
    loads_.at(0.0, {0.0, step}, f_now_.data());
    const double moving =
        0.5 * kernels::twice_energy(contacts_.padded_modes, k_.data(), q_.data(), v_.data());
    motion_.gather(q_.data(), v_.data());
    obstacles_.at(0.0, carried_);
    carried_.add_to(motion_);
    double given = 0.0; // J, of the residual flexibility
    if (scene.residual.size() > 0) {
      flexible_.emplace(contacts_, scene.residual, step);
      given = flexible_->start(motion_);
    }
    memory_.start(motion_);
    near_only_ = !flexible_ && carried_.u.empty() && !(solver_.window() > 0.0);
    record_.energy.initial = record_.energy.throughput = moving + motion_.spring_energy() + given;
    after_action_ = moving;
    record_.step = h_;
    if (shown.size() > 0) {
      shown_.assign(n, 0.0);
      std::copy_n(shown.data(), shown.size(), shown_.begin());
    }
    shown_q_.assign(n, 0.0);
    seen_ = motion_.u;
  }

  const Record& advance() override {
    flow();
    if (contacts_.count > 0) {
      act();
      see();
    }
    show(record_, contacts_, displacements(), seen_.data(), trial_);
    return record_;
  }

  void state_at(double time, double* q, double* v) override {
    // Exact flow from the last action under the load's slope of the step under way. The action stands for a
    // force f over the step around it: its impulse is spread out, so that the velocity is of order 2 at any
    // instant and not only in the middle between two actions.
    const double t = time - time_, span = next_time() - time_;
    const double share = t / h_ - 0.5;
    if (!loads_.empty()) {
      loads_.at(next_time(), f_next_.data());
      for (std::size_t i = 0; i < slope_.size(); ++i)
        slope_[i] = (f_next_[i] - f_now_[i]) / span;
    }
    for (Eigen::Index j = 0; j < system_.size(); ++j) {
      if (coupled_.couples(j))
        continue;
      const auto i = static_cast<std::size_t>(j);
      const DenseCoefficients d = dense_coefficients(system_.stiffness(j), system_.damping(j), t);
      q[j] = d.qq * q_[i] + d.qv * v_[i] + d.qf * f_now_[i] + d.qs * slope_[i];
      v[j] = d.vq * q_[i] + d.vv * v_[i] + d.vf * f_now_[i] + d.vs * slope_[i];
    }
    coupled_.inside(t, q_.data(), v_.data(), f_now_.data(), slope_.data(), q, v);
    std::fill(impulse_.begin(), impulse_.end(), 0.0);
    rows_.add_to(impulse_.data());
    for (Eigen::Index j = 0; j < system_.size(); ++j) {
      const double impulse = impulse_[static_cast<std::size_t>(j)];
      q[j] += 0.5 * (share * share - 1.0 / 12.0) * h_ * impulse; // nothing in the mean over the step
      v[j] += share * impulse;
    }
    if (!shown_.empty())
      for (Eigen::Index j = 0; j < system_.size(); ++j) {
        q[j] *= shown_[static_cast<std::size_t>(j)];
        v[j] *= shown_[static_cast<std::size_t>(j)];
      }
  }

  void load_at(double time, double* force) override {
    if (loads_.empty()) {
      std::fill_n(force, system_.size(), 0.0);
      return;
    }
    loads_.instant(time, f_next_.data());
    std::copy_n(f_next_.data(), system_.size(), force);
    if (!shown_.empty())
      for (Eigen::Index j = 0; j < system_.size(); ++j)
        force[j] /= shown_[static_cast<std::size_t>(j)];
  }

  [[nodiscard]] double next_time() const override { return (static_cast<double>(steps_) + 0.5) * h_; }

  [[nodiscard]] StepCounts counts() const override {
    return {steps_, 0, contacts_.count > 0 ? steps_ : 0, unconverged_, h_, h_};
  }

  void visit(core::StateArchive& state) override {
    state(steps_, unconverged_, time_, q_, v_, f_now_, trial_, paths_, memory_);
    state(record_.energy, moving_, after_action_, load_work_, lost_);
    if (flexible_)
      state(*flexible_);
    rows_.set(trial_, h_);
  }

private:
  /// Of the modes in the mean over the step, as `see` has the contacts; padded.
  const double* displacements() {
    const double* mean = trial_.active.empty() ? q_.data() : shown_q_.data();
    if (shown_.empty())
      return mean;
    for (std::size_t i = 0; i < shown_.size(); ++i)
      shown_q_[i] = shown_[i] * mean[i];
    return shown_q_.data();
  }

  /// From the last action (or the start) to the next.
  void flow() {
    const kernels::FlowTable& table = steps_ == 0 ? first_ : full_;
    const int halvings = steps_ == 0 ? 1 : 0;
    time_ = next_time();
    ++steps_;
    double work = 0.0;
    if (loads_.empty()) {
      kernels::flow_free(contacts_.padded_modes, table, q_.data(), v_.data());
      coupled_.advance(halvings, q_.data(), v_.data(), nullptr, nullptr);
    } else {
      if (loads_.constant())
        f_next_ = f_now_;
      else
        loads_.at(time_, f_next_.data());
      work = kernels::flow_loaded(contacts_.padded_modes, table, q_.data(), v_.data(), f_now_.data(),
                                  f_next_.data());
      work += coupled_.advance(halvings, q_.data(), v_.data(), f_now_.data(), f_next_.data());
      f_now_.swap(f_next_);
    }
    moving_ = 0.5 * kernels::twice_energy(contacts_.padded_modes, k_.data(), q_.data(), v_.data());
    Energy& energy = record_.energy;
    load_work_ += work;
    energy.load_work = load_work_;
    energy.throughput += std::abs(work);
    energy.modal_damping +=
        work - (moving_ - after_action_); // the flow is exact: what the load gave and the modes did not keep
    after_action_ = moving_;
    record_.time = time_;
    record_.energy.stored = moving_;
  }

  /// Where the contacts are in the mean over the step: at the action the modes stand (h^2/12) W f behind (contact/instant_spring.hpp); of W the
  /// block of the contact itself.
  void see() {
    seen_ = motion_.u;
    const auto width = static_cast<std::size_t>(contacts_.width);
    for (const int active : trial_.active) {
      const auto c = static_cast<std::size_t>(active);
      const ContactState& s = trial_.states[c];
      const double scale = h_ * h_ / 12.0, y = scale * (s.normal_force * s.ny + s.friction.t * s.nz),
                   z = scale * (s.normal_force * s.nz - s.friction.t * s.ny);
      seen_[c] += contacts_.own_mobility(active, 0, 0) * y + contacts_.own_mobility(active, 0, 1) * z;
      seen_[width + c] += contacts_.own_mobility(active, 1, 0) * y + contacts_.own_mobility(active, 1, 1) * z;
    }
  }

  /// Where the contacts stand and the forces of the action.
  ContactSolver::Action solve() {
    if (near_only_) {
      motion_.gather_near(q_.data(), v_.data(), memory_.closed());
      memory_.follow(motion_, 0.5 * h_);
      return solver_.solve_near(memory_, motion_, trial_);
    }
    motion_.gather(q_.data(), v_.data());
    obstacles_.at(time_, carried_);
    carried_.add_to(motion_);
    if (flexible_) // whose contacts move at once by their own forces
      return flexible_->solve(memory_, motion_, trial_);
    memory_.follow(motion_, 0.5 * h_);
    return solver_.solve(memory_, motion_, trial_);
  }

  /// The contacts act.
  void act() {
    const auto action = solve();
    unconverged_ += !action.converged;
    const double springs_before = memory_.spring_energy();
    paths_.correct(motion_, memory_, trial_);
    ContactLosses losses = memory_.commit(motion_, trial_);
    paths_.end_slides(trial_, losses);
    if (flexible_)
      flexible_->accept();
    else
      memory_.leave(motion_, trial_, 0.5 * h_);
    rows_.set(trial_, h_);
    rows_.add_to(v_.data(), h_ / 12.0, q_.data(), shown_q_.data());
    // The record stands in the middle of the action: half of its losses belong to it, and its velocity is (v-
    // + v+)/2, whose energy is moving + work/2 - (h^2/8) f.W.f. What moving obstacles do is work from outside.
    Energy& energy = record_.energy;
    const double brought = -h_ * product(contacts_, trial_, carried_.w), work = action.work + brought;
    energy.load_work = load_work_ + 0.5 * brought;
    energy.throughput += std::abs(brought);
    load_work_ += brought;
    energy.contact_damping = lost_.damping + 0.5 * losses.damping;
    energy.friction = lost_.friction + 0.5 * losses.friction;
    energy.stored = moving_ + 0.5 * work - 0.25 * action.jump + trial_.springs +
                    0.5 * (springs_before + memory_.spring_energy());
    lost_.damping += losses.damping;
    lost_.friction += losses.friction;
    after_action_ = moving_ + work;
  }

  System system_;
  double h_;
  LoadSum loads_;
  PackedContacts contacts_;
  ContactMotion motion_;
  ObstacleMotion obstacles_;
  Carried carried_;
  ContactMemory memory_;
  ContactSolver solver_;
  std::optional<FlexibleContacts> flexible_; ///< instead of it
  bool near_only_ =
      false; ///< only displacements tell which contacts act: velocities of the others are not asked for
  ContactTrial trial_;
  SlidingPaths paths_;
  ContactRows rows_; ///< impulses of the last action
  MatrixFlow coupled_;
  kernels::FlowTable first_, full_;

  std::int64_t steps_ = 0, unconverged_ = 0;
  double time_ = 0.0;
  kernels::Array q_, v_, k_, f_now_, f_next_, slope_, impulse_;
  kernels::Array shown_;   ///< with scaled masses
  kernels::Array shown_q_; ///< in the mean over the step
  kernels::Array seen_;    ///< m, lanes, likewise

  Record record_;
  double moving_ = 0.0, after_action_ = 0.0; ///< modal energy before and after the action
  double load_work_ = 0.0;                   ///< up to the last action, all of it included
  ContactLosses lost_;                       ///< likewise
};

} // namespace

std::unique_ptr<Scheme> make_splitting(const Scene& scene, double step, double fastest) {
  const Eigen::VectorXd masses = scaled_masses(scene, fastest);
  if ((masses.array() == 1.0).all())
    return std::make_unique<Splitting>(scene, step, Eigen::VectorXd());
  return std::make_unique<Splitting>(with_masses(scene, masses), step, masses.cwiseSqrt().cwiseInverse());
}

} // namespace fretwork::transient
