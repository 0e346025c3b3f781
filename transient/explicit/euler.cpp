// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The reference's scheme of order 1 (R5.06.04: Euler; semi-implicit):
///     v_{n+1} = v_n + h (loads(t_n) + B^T f(q_n, v_n) - c v_n - k q_n),   q_{n+1} = q_n + h v_{n+1}
/// The contact laws are evaluated explicitly and their memory is committed once a step. Stable for h w_max <
/// 2 and h w_c < 2; an explicit tangential damper asks for C_T W h well below 1. It takes a full damping
/// matrix. Energy: v_n belongs to t_n - h/2; the energy balance uses (v_n + v_{n+1})/2 at t_n, and its residual is of
/// the order of the scheme.
#include "transient/contacts/obstacle_motion.hpp"
#include "transient/explicit/euler_contacts.hpp"
#include "transient/explicit/explicit_schemes.hpp"
#include "vibration/load_sum.hpp"
#include <algorithm>
#include <cmath>

namespace fretwork::transient {
namespace {

class Euler final : public Scheme {
public:
  Euler(const Scene& scene, double step)
      : system_(scene.system), h_(step), loads_(scene, step), contacts_(scene.contacts, scene.system.size()),
        motion_(contacts_), obstacles_(scene, contacts_), imposed_(obstacles_.workspace()),
        laws_(contacts_, step), trial_(contacts_.count), rows_(contacts_), q_(kernels::padded_copy(scene.q0)),
        v_(kernels::padded_copy(scene.v0)), k_(kernels::padded_copy(system_.stiffness)),
        c_(kernels::padded_copy(system_.lone_damping())), load_(q_.size(), 0.0), force_(load_),
        before_q_(load_), before_v_(load_) {
    obstacles_.place(0.0, q_.data(), v_.data(), imposed_, motion_);
    laws_.start(motion_);
    loads_.at(0.0, {0.0, h_}, load_.data());
    record_.step = h_;
  }

  const Record& advance() override {
    record_.time = static_cast<double>(steps_) * h_;
    before_q_ = q_;
    before_v_ = v_;
    std::fill(force_.begin(), force_.end(), 0.0);
    const Contacts contact = act();
    double damper_power = apply_damping_matrix();
    if (!loads_.constant())
      loads_.at(record_.time, {record_.time, record_.time + h_}, load_.data());
    const auto sums = kernels::euler_step(contacts_.padded_modes, h_, c_.data(), k_.data(), load_.data(),
                                          force_.data(), q_.data(), v_.data());
    damper_power += sums.damping_power;
    balance_energy(contact, sums, damper_power);
    ++steps_;
    show(record_, contacts_, before_q_.data(), motion_.u.data(), trial_);
    return record_;
  }

  void state_at(double time, double* q, double* v) override {
    if (steps_ == 0) {
      std::copy_n(q_.begin(), system_.size(), q);
      std::copy_n(v_.begin(), system_.size(), v);
      return;
    }
    const double share = (time - record_.time) / h_;
    for (Eigen::Index i = 0; i < system_.size(); ++i) {
      q[i] = before_q_[i] + share * (q_[i] - before_q_[i]);
      v[i] = before_v_[i] + share * (v_[i] - before_v_[i]);
    }
  }

  void load_at(double time, double* force) override { loads_.observe(time, force); }

  [[nodiscard]] double next_time() const override { return static_cast<double>(steps_) * h_; }

  [[nodiscard]] StepCounts counts() const override {
    return {steps_, 0, contacts_.count > 0 ? steps_ : 0, 0, h_, h_};
  }

  void visit(core::StateArchive& state) override {
    state(steps_, q_, v_, before_q_, before_v_, laws_);
    state(record_.time, record_.energy, load_work_, modal_damping_, lost_);
  }

private:
  struct Contacts {
    double stored = 0.0;
    double power = 0.0;   ///< W, that moving obstacles bring
    ContactLosses losses; ///< over the step
  };

  Contacts act() {
    if (contacts_.count == 0)
      return {};
    obstacles_.place(record_.time, q_.data(), v_.data(), imposed_, motion_);
    laws_.evaluate(motion_, trial_);
    const ContactLosses losses = laws_.commit(motion_, trial_);
    rows_.add_to(trial_, force_.data());
    return {trial_.springs + laws_.memory().spring_energy(), -product(contacts_, trial_, imposed_.w), losses};
  }

  /// The full damping matrix joins the forces. Returns its power.
  double apply_damping_matrix() {
    if (system_.damping_matrix.size() == 0)
      return 0.0;
    const Eigen::Index n = system_.size();
    const Eigen::Map<const Eigen::VectorXd> v(v_.data(), n);
    Eigen::Map<Eigen::VectorXd> force(force_.data(), n);
    double power = 0.0;
    for (Eigen::Index i = 0; i < n; ++i) {
      const double f = system_.damping_matrix.row(i).dot(v);
      force(i) -= f;
      power += f * v(i);
    }
    return power;
  }

  void balance_energy(const Contacts& contact, const kernels::EulerSums& sums, double damper_power) {
    Energy& energy = record_.energy;
    energy.stored = 0.5 * sums.twice_energy + contact.stored;
    const bool start = steps_ == 0;
    if (start)
      energy.start(energy.stored);
    // A record stands in the middle of its step: half of what the step brings belongs to it, at t = 0 nothing
    // (only the second half is run).
    const double before = start ? 0.0 : 0.5, all = start ? 0.5 : 1.0;
    const double work = h_ * (sums.load_power + contact.power), loss = h_ * damper_power;
    energy.scale += all * std::abs(work);
    energy.load_work = load_work_ + before * work;
    energy.modal_damping = modal_damping_ + before * loss;
    energy.contact_damping = lost_.damping + before * contact.losses.damping;
    energy.friction = lost_.friction + before * contact.losses.friction;
    load_work_ += all * work;
    modal_damping_ += all * loss;
    lost_.damping += all * contact.losses.damping;
    lost_.friction += all * contact.losses.friction;
  }

  vibration::System system_;
  double h_;
  vibration::LoadSum loads_;
  PackedContacts contacts_;
  ContactMotion motion_;
  ObstacleMotion obstacles_;
  ImposedMotion imposed_;
  EulerContacts laws_;
  ContactTrial trial_;
  ContactRows rows_;
  std::int64_t steps_ = 0;
  kernels::Array q_, v_, k_, c_, load_, force_, before_q_, before_v_;
  Record record_;
  double load_work_ = 0.0, modal_damping_ = 0.0; ///< up to now, the last step included
  ContactLosses lost_;                           ///< likewise
};

} // namespace

std::unique_ptr<Scheme> make_euler(const Scene& scene, double step) {
  return std::make_unique<Euler>(scene, step);
}

} // namespace fretwork::transient
