// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The scheme that keeps the energy at any step: exact motion of the modes under loads that are linear and contact forces that are
/// constant over a step (oscillator.hpp; coupled_flow.hpp where a damping matrix couples them), the forces made from both ends of the step (conserving_contacts.hpp). Order 2 in displacement,
/// velocity and force, with damping and friction. Implicit: a step has no limit of stability, neither by the contacts nor by the modes;
/// what it does not resolve is still wrong.
///
/// Energy: the work of a constant force on an exact motion is f.(u1 - u0), which is what the springs store and the dampers and sliders
/// take: the residual of the energy balance is round-off, and without losses the energy is constant. Obstacles that move (obstacle_motion.hpp) move
/// the contacts at both ends of the step; they bring -f.(imposed (s1 - s0)).
///
/// A record stands in the middle of its step, where the mean forces are of order 2. Its contact springs hold what the constant force
/// has left them, V0 - f.(u - u0) less half of the step's losses, written (V0 + V1)/2 + f.((u0 + u1)/2 - u).
///
/// A step whose forces are not found is cut in two, at most `halvings` times; the next whole step is tried whole again.
#include "transient/conserving/energy_conserving.hpp"
#include "transient/conserving/conserving_contacts.hpp"
#include "transient/contacts/obstacle_motion.hpp"
#include "vibration/coupled_flow.hpp"
#include "vibration/load_sum.hpp"
#include "vibration/oscillator.hpp"
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace fretwork::transient {
namespace {

constexpr std::size_t halvings = 8;
constexpr std::int64_t parts = std::int64_t{1} << halvings; ///< of a whole step

double dot(const kernels::Array& force, const kernels::Array& to, const kernels::Array& from) {
  double sum = 0.0;
  for (std::size_t i = 0; i < force.size(); ++i)
    sum += force[i] * (to[i] - from[i]);
  return sum;
}

class EnergyConserving final : public Scheme {
public:
  EnergyConserving(const Scene& scene, double step)
      : system_(vibration::with_diagonal(scene.system)), h_(step), loads_(scene, step),
        contacts_(scene.contacts, scene.system.size()), start_(contacts_), end_(contacts_),
        middle_(contacts_),
        obstacles_(scene, contacts_), imposed_{obstacles_.workspace(), obstacles_.workspace(),
                                               obstacles_.workspace()},
        memory_(contacts_), solver_(contacts_), rows_(contacts_), coupled_(system_, step, 1, halvings + 1),
        q_(kernels::padded_copy(scene.q0)), v_(kernels::padded_copy(scene.v0)),
        k_(kernels::padded_copy(system_.stiffness)), load_(q_.size(), 0.0), middle_load_(load_),
        contact_(load_), moved_(load_), slope_(load_), steps_{Step(contacts_), Step(contacts_)} {
    for (Tables& t : tables_)
      t.reserve(contacts_);
    loads_.at(0.0, load_.data());
    next_load_ = load_;
    obstacles_.place(0.0, q_.data(), v_.data(), imposed_[2], end_);
    springs_ = end_.spring_energy();
    moving_ = moving(q_, v_);
    energy_.start(moving_ + springs_);
    record_.energy = energy_;
    show(steps_[0]);
    make(steps_[ahead_]);
  }

  const Record& advance() override {
    if (failure_ != StepFailure::none)
      return record_;
    const Step& now = steps_[ahead_];
    show(now);
    counts_.add(now.length);
    ahead_ = 1 - ahead_;
    make(steps_[ahead_]);
    return record_;
  }

  void state_at(double time, double* q, double* v) override {
    const Step &now = steps_[1 - ahead_], &next = steps_[ahead_];
    const bool before =
        counts_.steps > 0 && (time <= now.start + now.length || failure_ != StepFailure::none);
    const Step& s = before ? now : next;
    const double t = time - s.start;
    for (std::size_t i = 0; i < slope_.size(); ++i)
      slope_[i] = (s.f1[i] - s.f0[i]) / s.length;
    for (Eigen::Index j = 0; j < system_.size(); ++j) {
      if (coupled_.couples(j))
        continue;
      const auto i = static_cast<std::size_t>(j);
      const vibration::DenseCoefficients d =
          vibration::dense_coefficients(system_.stiffness(j), system_.damping(j), t);
      q[j] = d.qq * s.q[i] + d.qv * s.v[i] + d.qf * s.f0[i] + d.qs * slope_[i];
      v[j] = d.vq * s.q[i] + d.vv * s.v[i] + d.vf * s.f0[i] + d.vs * slope_[i];
    }
    coupled_.inside(t, s.q.data(), s.v.data(), s.f0.data(), slope_.data(), q, v);
  }

  void load_at(double time, double* force) override { loads_.observe(time, force); }

  [[nodiscard]] double next_time() const override {
    const Step& next = steps_[ahead_];
    return failure_ == StepFailure::none ? next.start + 0.5 * next.length
                                         : std::numeric_limits<double>::infinity();
  }

  [[nodiscard]] StepCounts counts() const override {
    StepCounts counts = counts_;
    counts.evaluations = solver_.evaluations();
    return counts;
  }

  [[nodiscard]] StepFailure failure() const override { return failure_; }

  void visit(core::StateArchive& state) override {
    state(q_, v_, load_, next_load_, end_, memory_, solver_, steps_, ahead_, whole_, part_, level_);
    state(springs_, moving_, energy_, counts_, failure_);
  }

private:
  /// What a step of one length needs.
  struct Tables {
    double length = 0.0; ///< s; 0: not made yet
    kernels::FlowTable half{0};
    ConservingContacts::Mobilities mobilities;
    void reserve(const PackedContacts& contacts) {
      half = kernels::FlowTable(contacts.padded_modes);
      for (kernels::Array* a : {&mobilities.place, &mobilities.rate})
        a->assign(static_cast<std::size_t>(contacts.count) * 3 * contacts.stride(), 0.0);
    }
  };

  /// A step made: its start, its middle and what acted.
  struct Step {
    explicit Step(const PackedContacts& contacts) : trial(contacts.count) {
      const auto n = static_cast<std::size_t>(contacts.padded_modes);
      for (kernels::Array* a : {&q, &v, &f0, &f1, &middle_q, &middle_v})
        a->assign(n, 0.0);
      middle_u.assign(static_cast<std::size_t>(contacts.stride()), 0.0);
    }
    double start = 0.0, length = 0.0;
    std::size_t level = 0;       ///< how often it was cut in two
    kernels::Array q, v, f0, f1; ///< at the start; modal forces, contacts included, at both ends
    kernels::Array middle_q, middle_v, middle_u;
    ContactTrial trial;
    Energy energy; ///< in the middle
    void visit(core::StateArchive& state) {
      state(start, length, level, q, v, f0, f1, middle_q, middle_v, middle_u, trial, energy);
    }
  };

  [[nodiscard]] double moving(const kernels::Array& q, const kernels::Array& v) const {
    return 0.5 * kernels::twice_energy(contacts_.padded_modes, k_.data(), q.data(), v.data());
  }

  void show(const Step& s) {
    record_.time = s.start + 0.5 * s.length;
    record_.step = s.length;
    transient::show(record_, contacts_, s.middle_q.data(), s.middle_u.data(), s.trial);
    if (s.length > 0.0)
      record_.energy = s.energy;
  }

  const Tables& tables(std::size_t level) {
    Tables& t = tables_[level];
    if (t.length > 0.0)
      return t;
    t.length = std::ldexp(h_, -static_cast<int>(level));
    for (Eigen::Index j = 0; j < system_.size(); ++j) {
      constexpr kernels::StepCoefficients none{1, 0, 0, 0, 0, 1,
                                               0, 0, 1, 0, 0, 0}; // coupled: they follow by themselves
      const double k = system_.stiffness(j), c = system_.damping(j);
      t.half.set(j, k, coupled_.couples(j) ? none : vibration::step_coefficients(k, c, 0.5 * t.length));
    }
    for (int c = 0; c < contacts_.count; ++c)
      for (int k = 0; k < contacts_.components; ++k)
        answer(t, level, c, k);
    return t;
  }

  /// A column of W and of W': from rest the modes move under a constant unit force at a contact.
  void answer(Tables& t, std::size_t level, int contact, int component) {
    const double* force = contacts_.row(contact, component);
    std::fill(moved_.begin(), moved_.end(), 0.0);
    std::fill(slope_.begin(), slope_.end(), 0.0);
    (void)coupled_.advance(static_cast<int>(level), moved_.data(), slope_.data(), force, force);
    for (Eigen::Index j = 0; j < system_.size(); ++j)
      if (!coupled_.couples(j)) {
        const auto i = static_cast<std::size_t>(j);
        const kernels::StepCoefficients s =
            vibration::step_coefficients(system_.stiffness(j), system_.damping(j), t.length);
        moved_[i] = (s.qf0 + s.qf1) * force[i];
        slope_[i] = (s.vf0 + s.vf1) * force[i];
      }
    const int stride = contacts_.stride(), width = contacts_.width;
    const auto first = static_cast<std::size_t>((contact * 3 + component) * stride);
    for (int to = 0; to < contacts_.count; ++to)
      for (int k = 0; k < contacts_.components; ++k) {
        const double* row = contacts_.row(to, k);
        double place = 0.0, rate = 0.0;
        for (std::size_t i = 0; i < moved_.size(); ++i) {
          place += row[i] * moved_[i];
          rate += row[i] * slope_[i];
        }
        const std::size_t at = first + static_cast<std::size_t>(k * width + to);
        t.mobilities.place[at] = place;
        t.mobilities.rate[at] = rate;
      }
  }

  /// Makes the step that starts at q_, v_, load_, and goes to its end.
  void make(Step& s) {
    start_.u.swap(end_.u);
    start_.w.swap(end_.w);
    s.q = q_;
    s.v = v_;
    s.start = (static_cast<double>(whole_) + static_cast<double>(part_) / static_cast<double>(parts)) * h_;
    for (;;) {
      const Tables& t = tables(level_);
      s.length = t.length;
      s.level = level_;
      if (!loads_.constant())
        loads_.at(s.start + s.length, next_load_.data());
      for (std::size_t k = 0; k < 3; ++k)
        obstacles_.at(s.start + 0.5 * static_cast<double>(k) * s.length, imposed_[k]);
      std::fill(contact_.begin(), contact_.end(), 0.0);
      Work work = move(t, s);
      if (contacts_.count > 0) {
        if (!solver_.solve(t.length, t.mobilities, memory_, start_, end_, s.trial)) {
          if (!shorten())
            return;
          continue;
        }
        if (!s.trial.active.empty()) {
          rows_.add_to(s.trial, contact_.data());
          work = move(t, s);
        }
      }
      balance_energy(s, work);
      break;
    }
    part_ += parts >> level_;
    if (part_ == parts) {
      part_ = 0;
      level_ = 0;
      ++whole_;
    }
    load_.swap(next_load_);
    if (loads_.constant())
      next_load_ = load_;
  }

  [[nodiscard]] bool shorten() {
    ++counts_.rejected;
    if (level_ == halvings)
      failure_ = StepFailure::contacts;
    else
      ++level_;
    return failure_ == StepFailure::none;
  }

  /// On the modes, by all forces and by the contacts alone, and of the contact forces on what carries the contacts, over the two halves
  /// of a step, J.
  struct Work {
    double all[2] = {0.0, 0.0}, contact[2] = {0.0, 0.0}, imposed[2] = {0.0, 0.0};
    /// On the contacts' whole motion.
    [[nodiscard]] double on_contacts(std::size_t half) const { return contact[half] + imposed[half]; }
  };

  /// From s.q, s.v through the middle to the end of the step.
  Work move(const Tables& t, Step& s) {
    const int n = contacts_.padded_modes, half = static_cast<int>(s.level) + 1;
    q_ = s.q;
    v_ = s.v;
    Work work;
    for (std::size_t i = 0; i < q_.size(); ++i) {
      s.f0[i] = load_[i] + contact_[i];
      middle_load_[i] = 0.5 * (load_[i] + next_load_[i]) + contact_[i];
      s.f1[i] = next_load_[i] + contact_[i];
    }
    work.all[0] =
        kernels::flow_loaded(n, t.half, q_.data(), v_.data(), s.f0.data(), middle_load_.data()).work;
    work.all[0] += coupled_.advance(half, q_.data(), v_.data(), s.f0.data(), middle_load_.data());
    s.middle_q = q_;
    s.middle_v = v_;
    work.all[1] =
        kernels::flow_loaded(n, t.half, q_.data(), v_.data(), middle_load_.data(), s.f1.data()).work;
    work.all[1] += coupled_.advance(half, q_.data(), v_.data(), middle_load_.data(), s.f1.data());
    work.contact[0] = dot(contact_, s.middle_q, s.q);
    work.contact[1] = dot(contact_, q_, s.middle_q);
    end_.gather(q_.data(), v_.data());
    imposed_[2].add_to(end_);
    return work;
  }

  /// The step is accepted.
  void balance_energy(Step& s, Work work) {
    double places[3];
    for (std::size_t k = 0; k < 3; ++k)
      places[k] = product(contacts_, s.trial, imposed_[k].u);
    for (std::size_t half = 0; half < 2; ++half)
      work.imposed[half] = places[half + 1] - places[half];
    const double springs = springs_ + memory_.spring_energy();
    const ContactLosses losses = solver_.commit(s.length, end_, memory_, s.trial);
    springs_ = s.trial.springs;
    const double springs_end = springs_ + memory_.spring_energy();
    middle_.gather(s.middle_q.data(), s.middle_v.data());
    imposed_[1].add_to(middle_);
    s.middle_u = middle_.u;
    const double middle = moving(s.middle_q, s.middle_v);
    pass(losses, work, 0, middle);
    s.energy = energy_;
    s.energy.stored =
        middle + 0.5 * (springs + springs_end) + 0.5 * (work.on_contacts(1) - work.on_contacts(0));
    pass(losses, work, 1, moving(q_, v_));
  }

  /// Losses and works of half a step; the modes then have the energy `moving_now`.
  void pass(const ContactLosses& losses, const Work& work, std::size_t half, double moving_now) {
    const double input = (loads_.empty() ? 0.0 : work.all[half] - work.contact[half]) - work.imposed[half];
    energy_.load_work += input;
    energy_.scale += std::abs(input);
    energy_.modal_damping +=
        work.all[half] - (moving_now - moving_); // the flow is exact: what the modes did not keep
    energy_.contact_damping += 0.5 * losses.damping;
    energy_.friction += 0.5 * losses.friction;
    moving_ = moving_now;
  }

  vibration::System system_;
  double h_;
  vibration::LoadSum loads_;
  PackedContacts contacts_;
  ContactMotion start_, end_, middle_; ///< of the step that is made
  ObstacleMotion obstacles_;
  std::array<ImposedMotion, 3> imposed_; ///< at its start, middle and end
  FrictionMemories memory_;
  ConservingContacts solver_;
  ContactRows rows_;
  std::array<Tables, halvings + 1> tables_;
  vibration::CoupledFlow coupled_;
  kernels::Array q_, v_, k_, load_, next_load_, middle_load_, contact_, moved_, slope_;

  std::array<Step, 2> steps_; ///< that of the last record, and the next
  std::size_t ahead_ = 0;
  std::int64_t whole_ = 0, part_ = 0; ///< where the next step starts: whole steps and `parts` of one
  std::size_t level_ = 0;
  double springs_ = 0.0, moving_ = 0.0; ///< J, normal springs and modes at the end of the last step
  Energy energy_;                       ///< up to there; `stored` is not kept
  Record record_;
  StepCounts counts_;
  StepFailure failure_ = StepFailure::none;
};

} // namespace

std::unique_ptr<Scheme> make_energy_conserving(const Scene& scene, double step) {
  return std::make_unique<EnergyConserving>(scene, step);
}

} // namespace fretwork::transient
