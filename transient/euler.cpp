// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The reference's scheme of order 1 (R5.06.04: Euler; semi-implicit):
///     v_{n+1} = v_n + h (loads(t_n) + B^T f(q_n, v_n) - c v_n - k q_n),   q_{n+1} = q_n + h v_{n+1}
/// The contact laws are evaluated explicitly and their memory is committed once a step. Stable for h w_max <
/// 2 and h w_c < 2; an explicit tangential damper asks for C_T W h well below 1. It takes a full damping
/// matrix. Energy: v_n belongs to t_n - h/2; the ledger uses (v_n + v_{n+1})/2 at t_n, and its residual is of
/// the order of the scheme.
#include "transient/load_sum.hpp"
#include "transient/packed_contacts.hpp"
#include "transient/scheme.hpp"
#include <algorithm>
#include <cmath>

namespace fretwork::transient {
namespace {

class Euler final : public Scheme {
public:
  Euler(const Scene& scene, double step)
      : system_(scene.system), h_(step), loads_(scene.loads, scene.system.size(), scene.duration, step),
        contacts_(scene.contacts, scene.system.size()) {
    const auto n = static_cast<std::size_t>(contacts_.padded_modes);
    for (kernels::Array* a : {&q_, &v_, &k_, &c_, &load_, &force_, &before_q_, &before_v_, &scratch_})
      a->assign(n, 0.0);
    std::copy_n(scene.q0.data(), scene.q0.size(), q_.begin());
    std::copy_n(scene.v0.data(), scene.v0.size(), v_.begin());
    std::copy_n(system_.stiffness.data(), system_.size(), k_.begin());
    if (system_.damping_matrix.size() == 0)
      std::copy_n(system_.damping.data(), system_.size(), c_.begin());
    const auto lanes = static_cast<std::size_t>(contacts_.stride());
    const auto count = static_cast<std::size_t>(contacts_.count);
    u_.assign(lanes, 0.0);
    w_.assign(lanes, 0.0);
    states_.resize(count);
    memory_.resize(count);
    active_.reserve(count);
    row_.reserve(3 * count);
    factor_.reserve(3 * count);
    for (const auto& support : contacts_.supports)
      tables_.push_back(contact::friction_table(support.friction, h_));
    loads_.at(0.0, load_.data());
    record_.contacts = contacts_.count;
    record_.q = before_q_.data();
    record_.uy = u_.data();
    record_.uz = u_.data() + contacts_.width;
    record_.states = states_;
    record_.step = h_;
  }

  const Record& advance() override {
    record_.time = static_cast<double>(steps_) * h_;
    before_q_ = q_;
    before_v_ = v_;
    std::fill(force_.begin(), force_.end(), 0.0);
    const Forces contact = contact_forces();
    double damper_power = apply_damping_matrix();
    if (!loads_.constant())
      loads_.at(record_.time, load_.data());
    const auto sums = kernels::euler_step(contacts_.padded_modes, h_, c_.data(), k_.data(), load_.data(),
                                          force_.data(), q_.data(), v_.data());
    damper_power += sums.damping_power;
    book(contact, sums, damper_power);
    ++steps_;
    record_.active = active_;
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

  void load_at(double time, double* force) override {
    loads_.instant(time, scratch_.data());
    std::copy_n(scratch_.begin(), system_.size(), force);
  }

private:
  struct Forces {
    double stored = 0.0, damping = 0.0, friction = 0.0;
  };

  Forces contact_forces() {
    Forces sum;
    row_.clear();
    factor_.clear();
    if (contacts_.count == 0)
      return sum;
    kernels::gather(contacts_.modes, contacts_.stride(), contacts_.gather.data(), q_.data(), v_.data(),
                    u_.data(), w_.data());
    for (const int c : active_)
      states_[c] = {};
    active_.clear();
    for (int c = 0; c < contacts_.count; ++c)
      meet(c, sum);
    kernels::scatter(contacts_.padded_modes, static_cast<int>(row_.size()), row_.data(), factor_.data(),
                     force_.data());
    return sum;
  }

  void meet(int c, Forces& sum) {
    const contact::Support& support = contacts_.supports[c];
    const int width = contacts_.width;
    const auto at = contact::locate(support.obstacle, u_[c] + contacts_.reach.rest_y[c],
                                    u_[width + c] + contacts_.reach.rest_z[c]);
    const double rate = -(at.ny * w_[c] + at.nz * w_[width + c]);
    const double p = -at.gap;
    const double normal = contact::normal_force(support.normal, p, rate);
    Memory& memory = memory_[c];
    if (p > 0.0)
      sum.stored += 0.5 * support.normal.stiffness * p * p;
    if (!(normal > 0.0)) {
      if (p > 0.0)
        sum.damping -= support.normal.stiffness * p * rate * h_; // what the positive part cuts
      if (memory.remembers) {
        const auto step = contact::open_step(support.friction, tables_[c], memory.friction);
        memory.friction = step.memory;
        memory.remembers = contact::norm(step.memory.spring) > 0.0;
        sum.damping += step.damper_work;
        sum.stored += contact::spring_energy(support.friction, memory.friction);
      }
      return;
    }
    ContactState& state = states_[c];
    state.normal_force = normal;
    state.ny = at.ny;
    state.nz = at.nz;
    state.approach = rate;
    state.damper_work = (normal - support.normal.stiffness * p) * rate * h_;
    if (support.friction.active()) {
      if (memory.remembers && memory.ny * at.ny + memory.nz * at.nz < 0.0) {
        sum.damping += contact::spring_energy(support.friction, memory.friction);
        memory = {};
      }
      const contact::Vec2 velocity{contacts_.components == 3 ? w_[2 * width + c] : 0.0,
                                   at.nz * w_[c] - at.ny * w_[width + c]};
      state.displacement = h_ * velocity;
      const auto friction =
          contacts_.components == 3
              ? contact::evaluate(support.friction, memory.friction, normal, state.displacement, velocity)
              : contact::evaluate_line(support.friction, memory.friction, normal, state.displacement.t,
                                       velocity.t);
      const auto step =
          contact::close_step(support.friction, tables_[c], memory.friction, friction, state.displacement);
      memory = {step.memory, at.ny, at.nz, true};
      state.friction = friction.force;
      state.slides = friction.slides;
      state.friction_work = step.friction_work;
      state.damper_work += step.damper_work;
      sum.friction += step.friction_work;
      sum.stored += contact::spring_energy(support.friction, memory.friction);
    }
    sum.damping += state.damper_work;
    active_.push_back(c);
    const double force[3] = {normal * at.ny + state.friction.t * at.nz,
                             normal * at.nz - state.friction.t * at.ny, state.friction.x};
    for (int k = 0; k < contacts_.components; ++k) {
      row_.push_back(contacts_.row(c, k));
      factor_.push_back(force[k]);
    }
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

  void book(const Forces& contact, const kernels::EulerSums& sums, double damper_power) {
    Energy& energy = record_.energy;
    energy.stored = 0.5 * sums.twice_energy + contact.stored;
    const bool start = steps_ == 0;
    if (start)
      energy.initial = energy.throughput = energy.stored;
    // A record stands in the middle of its step: half of what the step brings belongs to it, at t = 0 nothing
    // (only the second half is run).
    const double before = start ? 0.0 : 0.5, all = start ? 0.5 : 1.0;
    const double work = h_ * sums.load_power, loss = h_ * damper_power;
    energy.throughput += all * std::abs(work);
    energy.load_work = load_work_ + before * work;
    energy.modal_damping = modal_damping_ + before * loss;
    energy.contact_damping = contact_damping_ + before * contact.damping;
    energy.friction = friction_ + before * contact.friction;
    load_work_ += all * work;
    modal_damping_ += all * loss;
    contact_damping_ += all * contact.damping;
    friction_ += all * contact.friction;
  }

  struct Memory {
    contact::FrictionMemory friction;
    double ny = 0.0, nz = 0.0;
    bool remembers = false;
  };

  System system_;
  double h_;
  LoadSum loads_;
  PackedContacts contacts_;
  std::vector<contact::FrictionTable> tables_;
  std::int64_t steps_ = 0;
  kernels::Array q_, v_, k_, c_, load_, force_, before_q_, before_v_, scratch_, u_, w_;
  std::vector<ContactState> states_;
  std::vector<Memory> memory_;
  std::vector<int> active_;
  std::vector<const double*> row_;
  std::vector<double> factor_;
  Record record_;
  double load_work_ = 0.0, modal_damping_ = 0.0, contact_damping_ = 0.0, friction_ = 0.0;
};

} // namespace

std::unique_ptr<Scheme> make_euler(const Scene& scene, double step) {
  return std::make_unique<Euler>(scene, step);
}

} // namespace fretwork::transient
