// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The splitting scheme of scenes with residual flexibility: Strang splitting of the modal motion and contact forces that act at instants.
/// Between instants t_k = (k + 1/2) h the modes move freely: loaded_flow.hpp. At t_k the contacts act once for the whole step: flexible_contacts.hpp.
/// Order 2 in displacement, velocity and force, with damping and friction. Stability: w_c h < 2.7, w_c^2 the largest eigenvalue of
/// K^1/2 W K^1/2, K^-1 = K_N^-1 + R; h w_max away from multiples of pi (mass_scaling.hpp). Energy: the work of each action h f.w and of each flow
/// are exact; the residual of the energy balance is what the contact laws' discrete work lacks.
#include "transient/contacts/obstacle_motion.hpp"
#include "transient/modes/loaded_flow.hpp"
#include "transient/modes/mass_scaling.hpp"
#include "transient/splitting/flexible_contacts.hpp"
#include "transient/splitting/splitting.hpp"
#include <algorithm>
#include <cmath>

namespace fretwork::transient {
namespace {

class FlexibleSplitting final : public Scheme {
public:
  /// @param scene  in the coordinates p of mass_scaling.hpp   @param mode_scales  n, q = mode_scales p; empty: all 1
  FlexibleSplitting(const Scene& scene, double step, const Eigen::VectorXd& mode_scales)
      : h_(step), modes_(scene, step), contacts_(scene.contacts, scene.system.size()), motion_(contacts_),
        obstacles_(scene, contacts_, step), imposed_(obstacles_.workspace()), memory_(contacts_, step),
        flexible_(contacts_, scene.residual, step), trial_(contacts_.count), rows_(contacts_),
        impulse_(modes_.q.size(), 0.0), output_q_(modes_.q.size(), 0.0) {
    motion_.gather(modes_.q.data(), modes_.v.data());
    obstacles_.at(0.0, imposed_);
    imposed_.add_to(motion_);
    const double stored = flexible_.start(motion_); // J
    memory_.start(motion_);
    record_.energy.initial = record_.energy.scale = modes_.energy() + motion_.spring_energy() + stored;
    preload();
    after_action_ = modes_.energy();
    if (mode_scales.size() > 0) {
      mode_scales_.assign(modes_.q.size(), 0.0);
      std::copy_n(mode_scales.data(), mode_scales.size(), mode_scales_.begin());
    }
    mean_u_ = motion_.u;
    for (int c = 0; c < contacts_.count; ++c) {
      Eigen::Matrix2d& w = own_mobility_.emplace_back();
      for (int to = 0; to < 2; ++to)
        for (int from = 0; from < 2; ++from)
          w(to, from) = contacts_.mobility(c, to, c, from);
    }
  }

  const Record& advance() override {
    flow();
    act();
    average_displacements();
    record_.step = h_;
    show(record_, contacts_, displacements(), mean_u_.data(), trial_);
    return record_;
  }

  void state_at(double time, double* q, double* v) override {
    // Exact flow from the last action under the load's slope of the step under way. The action stands for a
    // force f over the step around it: its impulse is spread out, so that the velocity is of order 2 at any
    // instant and not only in the middle between two actions.
    modes_.state_at(time, q, v);
    const double t = time - modes_.time();
    const double share =
        modes_.steps() > 0 ? t / h_ - 0.5 : t / h_; // the start is in the middle between actions
    std::fill(impulse_.begin(), impulse_.end(), 0.0);
    rows_.add_to(impulse_.data());
    for (Eigen::Index j = 0; j < contacts_.modes; ++j) {
      const double impulse = impulse_[static_cast<std::size_t>(j)];
      q[j] += 0.5 * (share * share - 1.0 / 12.0) * h_ * impulse; // nothing in the mean over the step
      v[j] += share * impulse;
    }
    if (!mode_scales_.empty())
      for (Eigen::Index j = 0; j < contacts_.modes; ++j) {
        q[j] *= mode_scales_[static_cast<std::size_t>(j)];
        v[j] *= mode_scales_[static_cast<std::size_t>(j)];
      }
  }

  void load_at(double time, double* force) override {
    modes_.load_at(time, force);
    if (!mode_scales_.empty())
      for (Eigen::Index j = 0; j < contacts_.modes; ++j)
        force[j] /= mode_scales_[static_cast<std::size_t>(j)];
  }

  [[nodiscard]] double next_time() const override { return modes_.instant(1); }

  [[nodiscard]] StepCounts counts() const override {
    return {modes_.steps(), 0, modes_.steps(), unconverged_, h_, h_};
  }

  void visit(core::StateArchive& state) override {
    state(modes_, unconverged_, trial_, memory_, flexible_, record_.energy, moving_, after_action_,
          load_work_, lost_);
    if (modes_.steps() > 0)
      rows_.set(trial_, h_);
  }

private:
  /// Contacts that are pressed at the start have been so: half a step after an action that stands for these forces modes are (h^2/24) W f
  /// before their mean between two actions. From the mean itself a tube that rests would ring, at w_c h = 1 with 4 % of its forces.
  void preload() {
    for (int c = 0; c < contacts_.count; ++c) {
      const contact::Location at = motion_.locate(c);
      const double force = contact::normal_force(contacts_.supports[c].normal, -at.gap,
                                                 motion_.penetration_rate(c, at.axes()));
      if (!(at.gap < 0.0 && force > 0.0))
        continue;
      ContactState& state = trial_.states[c];
      state.normal_force = force;
      state.axes = at.axes();
      trial_.active.push_back(c);
    }
    rows_.set(trial_, h_);
    trial_.clear();
    rows_.add_to(impulse_.data());
    for (std::size_t i = 0; i < impulse_.size(); ++i)
      modes_.q[i] += h_ / 24.0 * impulse_[i];
  }

  /// Of the modes in the mean over the step, as `see` has the contacts; padded.
  const double* displacements() {
    for (std::size_t i = 0; i < mode_scales_.size(); ++i)
      output_q_[i] *= mode_scales_[i];
    return output_q_.data();
  }

  /// From the last action (or the start) to the next.
  void flow() {
    const kernels::FlowSums sums = modes_.advance();
    moving_ = 0.5 * sums.twice_energy;
    const double work = sums.work;
    Energy& energy = record_.energy;
    load_work_ += work;
    energy.load_work = load_work_;
    energy.scale += std::abs(work);
    energy.modal_damping +=
        work - (moving_ - after_action_); // the flow is exact: what the load gave and the modes did not keep
    after_action_ = moving_;
    record_.time = modes_.time();
    record_.energy.stored = moving_;
  }

  /// Where the contacts are in the mean over the step: at the action the modes stand (h^2/12) W f behind (contact/instant_spring.hpp); of W the
  /// block of the contact itself.
  void average_displacements() {
    mean_u_ = motion_.u;
    const auto width = static_cast<std::size_t>(contacts_.width);
    for (const int active : trial_.active) {
      const auto c = static_cast<std::size_t>(active);
      const ContactState& s = trial_.states[c];
      const double scale = h_ * h_ / 12.0, y = scale * s.force_y(), z = scale * s.force_z();
      const Eigen::Matrix2d& w = own_mobility_[c];
      mean_u_[c] += w(0, 0) * y + w(0, 1) * z;
      mean_u_[width + c] += w(1, 0) * y + w(1, 1) * z;
    }
  }

  /// The contacts act.
  void act() {
    motion_.gather(modes_.q.data(), modes_.v.data());
    if (!imposed_.u.empty()) {
      obstacles_.at(modes_.time(), imposed_);
      imposed_.add_to(motion_);
    }
    const auto action = flexible_.solve(memory_, motion_, trial_);
    unconverged_ += !action.converged;
    const double springs_before = memory_.friction().spring_energy();
    const ContactLosses losses = memory_.commit(motion_, trial_);
    flexible_.accept();
    rows_.set(trial_, h_);
    end_action(action, losses, springs_before);
  }

  /// Forces found and committed: the modes take them.
  void end_action(const FlexibleContacts::Action& action, const ContactLosses& losses,
                  double springs_before) {
    std::fill(impulse_.begin(), impulse_.end(), 0.0);
    rows_.add_to(impulse_.data());
    for (std::size_t i = 0; i < impulse_.size(); ++i) {
      modes_.v[i] += impulse_[i];
      output_q_[i] = modes_.q[i] + h_ / 12.0 * impulse_[i];
    }
    // The record stands in the middle of the action: half of its losses belong to it, and its velocity is (v-
    // + v+)/2, whose energy is moving + work/2 - (h^2/8) f.W.f. What moving obstacles do is work from outside.
    Energy& energy = record_.energy;
    const double brought = -h_ * product(contacts_, trial_, imposed_.w), work = action.work + brought;
    energy.load_work = load_work_ + 0.5 * brought;
    energy.scale += std::abs(brought);
    load_work_ += brought;
    energy.contact_damping = lost_.damping + 0.5 * losses.damping;
    energy.friction = lost_.friction + 0.5 * losses.friction;
    energy.stored = moving_ + 0.5 * work - 0.25 * action.jump + trial_.springs +
                    0.5 * (springs_before + memory_.friction().spring_energy());
    lost_.damping += losses.damping;
    lost_.friction += losses.friction;
    after_action_ = moving_ + work;
  }

  double h_;
  LoadedFlow modes_;
  PackedContacts contacts_;
  ContactMotion motion_;
  ObstacleMotion obstacles_;
  ImposedMotion imposed_;
  ContactMemory memory_;
  FlexibleContacts flexible_;
  ContactTrial trial_;
  ContactRows rows_; ///< impulses of the last action

  std::int64_t unconverged_ = 0;
  kernels::Array impulse_;
  kernels::Array mode_scales_;                ///< with scaled masses
  kernels::Array output_q_;                   ///< in the mean over the step
  std::vector<Eigen::Matrix2d> own_mobility_; ///< 1/kg, y z, contact by contact
  kernels::Array mean_u_;                     ///< m, lanes, likewise

  Record record_;
  double moving_ = 0.0, after_action_ = 0.0; ///< modal energy before and after the action
  double load_work_ = 0.0;                   ///< up to the last action, all of it included
  ContactLosses lost_;                       ///< likewise
};

} // namespace

std::unique_ptr<Scheme> make_flexible_splitting(const Scene& scene, double step, double fastest) {
  const Eigen::VectorXd masses = scaled_masses(scene, fastest);
  if ((masses.array() == 1.0).all())
    return std::make_unique<FlexibleSplitting>(scene, step, Eigen::VectorXd());
  return std::make_unique<FlexibleSplitting>(with_masses(scene, masses), step,
                                             masses.cwiseSqrt().cwiseInverse());
}

} // namespace fretwork::transient
