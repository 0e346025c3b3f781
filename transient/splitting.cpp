// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Strang splitting of the modal motion and the contact forces, order 2 in displacement, velocity and force,
/// with damping and friction.
///
/// Between instants t_k = (k + 1/2) h the modes move freely: loaded_flow.hpp. At t_k the contacts act once for the whole step:
/// contact_solver.hpp, with residual flexibility flexible_contacts.hpp.
/// Stability: w_c h < 2.7, w_c^2 the largest eigenvalue of K_N^1/2 W K_N^1/2; h w_max away from multiples of
/// pi (mass_scaling.hpp). Accuracy asks for less (step_rule.hpp). Cost: one evaluation of the contacts a step. Energy: the work
/// of each action h f.w and of each flow are exact; the ledger's residual is what the contact laws' discrete
/// work lacks.
///
/// Flights: while no contact can meet its obstacle, `flight` steps are made by one exact flow. Over a time L a free displacement is, to
/// (w_max L)^4/384, the cubic of its ends u0, u1 and velocities w0, w1, which stays in the hull of u0, u0 + w0 L/3, u1 - w1 L/3, u1; gaps
/// are concave functions of it. So no contact is met where these four leave a gap; where they do not, the flight is not made. Records
/// stand for half of the flights before and after them. So that sums over them are integrals in spite of the longer step, those between
/// flights or steps of lengths L0 and L1 show displacements that lean by (L1^2 - L0^2)/(12 step) times their velocities (the correction
/// of trapezoidal sums by Euler and Maclaurin), and no flight begins at a speed that would take a contact further than a quarter of its
/// clearance.
#include "transient/flexible_contacts.hpp"
#include "transient/flights.hpp"
#include "transient/loaded_flow.hpp"
#include "transient/mass_scaling.hpp"
#include "transient/obstacle_motion.hpp"
#include "transient/sliding_paths.hpp"
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace fretwork::transient {
namespace {

/// Of a contact's clearance.
constexpr double longest_flight = 0.25;

/// On cache lines of its own: where the heap put its members otherwise took up to a tenth of a step (`high modes`).
class alignas(64) Splitting final : public Scheme {
public:
  /// @param scene  in the coordinates p of mass_scaling.hpp   @param shown  n, q = shown p; empty: all 1
  /// @param flight  the most steps of a flight; 1: none
  Splitting(const Scene& scene, double step, const Eigen::VectorXd& shown, int flight)
      : h_(step), modes_(scene, step), contacts_(scene.contacts, scene.system.size()), motion_(contacts_),
        obstacles_(scene, contacts_, step), carried_(obstacles_.room()), memory_(contacts_, step),
        solver_(contacts_, step), trial_(contacts_.count),
        paths_(contacts_, step, scene.residual.size() == 0), rows_(contacts_), duration_(scene.duration),
        impulse_(modes_.q.size(), 0.0), shown_q_(modes_.q.size(), 0.0) {
    motion_.gather(modes_.q.data(), modes_.v.data());
    obstacles_.at(0.0, carried_);
    carried_.add_to(motion_);
    double given = 0.0; // J, of the residual flexibility
    if (scene.residual.size() > 0) {
      flexible_.emplace(contacts_, scene.residual, step);
      given = flexible_->start(motion_);
    }
    memory_.start(motion_);
    near_only_ = !flexible_ && carried_.u.empty() && !(solver_.window() > 0.0);
    if (may_fly(scene))
      for (int length = flight; length > 1 && far_.size() < 3; length /= 2)
        far_.push_back(modes_.flight(length));
    record_.energy.initial = record_.energy.throughput = modes_.energy() + motion_.spring_energy() + given;
    press_from_start();
    after_action_ = modes_.energy();
    if (shown.size() > 0) {
      shown_.assign(modes_.q.size(), 0.0);
      std::copy_n(shown.data(), shown.size(), shown_.begin());
    }
    seen_ = speeds_ = motion_.u;
  }

  void leave_out_positions() override { positions_ = false; }

  const Record& advance() override {
    const int flown = stride_;
    lean_ = 0.0;
    flow();
    if (contacts_.count > 0) {
      if (flown > 1)
        rest(flown);
      else
        act();
      if (positions_)
        see();
    }
    look_ahead();
    record_.step = 0.5 * (flown + stride_) * h_;
    if (positions_ && flown != stride_)
      lean(h_ * h_ * (stride_ * stride_ - flown * flown) / (12.0 * record_.step));
    show(record_, contacts_, positions_ ? displacements() : nullptr, positions_ ? seen_.data() : nullptr,
         trial_);
    return record_;
  }

  void state_at(double time, double* q, double* v) override {
    // Exact flow from the last action under the load's slope of the step under way. The action stands for a
    // force f over the step around it: its impulse is spread out, so that the velocity is of order 2 at any
    // instant and not only in the middle between two actions.
    modes_.state_at(time, stride_, q, v);
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
    if (!shown_.empty())
      for (Eigen::Index j = 0; j < contacts_.modes; ++j) {
        q[j] *= shown_[static_cast<std::size_t>(j)];
        v[j] *= shown_[static_cast<std::size_t>(j)];
      }
  }

  void load_at(double time, double* force) override {
    modes_.load_at(time, force);
    if (!shown_.empty())
      for (Eigen::Index j = 0; j < contacts_.modes; ++j)
        force[j] /= shown_[static_cast<std::size_t>(j)];
  }

  [[nodiscard]] double next_time() const override { return modes_.instant(stride_); }

  [[nodiscard]] StepCounts counts() const override {
    return {modes_.steps(), 0, contacts_.count > 0 ? modes_.steps() - flown_ : 0, unconverged_, h_, h_};
  }

  void visit(core::StateArchive& state) override {
    state(modes_, unconverged_, trial_, paths_, memory_);
    state(record_.energy, moving_, after_action_, load_work_, lost_);
    if (flexible_)
      state(*flexible_);
    if (modes_.steps() > 0)
      rows_.set(trial_, h_);
    state(stride_, flown_, wait_);
    for (const LoadedFlow::Flight& flight : far_)
      if (flight.steps == stride_)
        fly(flight);
  }

private:
  /// Contacts that are pressed at the start have been so: half a step after an action that stands for these forces modes are (h^2/24) W f
  /// before their mean between two actions. From the mean itself a tube that rests would ring, at w_c h = 1 with 4 % of its forces.
  void press_from_start() {
    for (int c = 0; c < contacts_.count; ++c) {
      const contact::Location at = motion_.locate(c);
      const double force =
          contact::normal_force(contacts_.supports[c].normal, -at.gap, motion_.sinking(c, at.ny, at.nz));
      if (!(at.gap < 0.0 && force > 0.0))
        continue;
      ContactState& state = trial_.states[c];
      state.normal_force = force;
      state.ny = at.ny;
      state.nz = at.nz;
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
    const double* mean = trial_.active.empty() && lean_ == 0.0 ? modes_.q.data() : shown_q_.data();
    if (shown_.empty())
      return mean;
    for (std::size_t i = 0; i < shown_.size(); ++i)
      shown_q_[i] = shown_[i] * mean[i];
    return shown_q_.data();
  }

  /// From the last action (or the start) to the next.
  void flow() {
    const kernels::FlowSums sums = stride_ > 1 ? modes_.land(stride_) : modes_.advance();
    flown_ += stride_ - 1;
    moving_ = 0.5 * sums.twice_energy;
    const double work = sums.work;
    Energy& energy = record_.energy;
    load_work_ += work;
    energy.load_work = load_work_;
    energy.throughput += std::abs(work);
    energy.modal_damping +=
        work - (moving_ - after_action_); // the flow is exact: what the load gave and the modes did not keep
    after_action_ = moving_;
    record_.time = modes_.time();
    record_.energy.stored = moving_;
  }

  /// The state after a flight, and how the contacts stand and move then.
  void fly(const LoadedFlow::Flight& flight) {
    modes_.fly(flight);
    motion_.gather(modes_.flown_q().data(), modes_.flown_v().data());
  }

  /// The next step is a flight where one meets no contact.
  void look_ahead() {
    const bool flew = std::exchange(stride_, 1) > 1;
    if (far_.empty() || !trial_.active.empty() || !motion_.places.first.empty())
      return;
    if (wait_ > 0) {
      --wait_;
      return;
    }
    if (!flew)
      motion_.gather_velocities(modes_.v.data());
    if (positions_)
      speeds_ = motion_.w;
    for (const LoadedFlow::Flight& flight : far_) {
      const double time = flight.steps * h_, third = time / 3.0;
      if (modes_.instant(flight.steps) > duration_ || !motion_.moves_less(time, longest_flight) ||
          !motion_.opens_after(third) || !motion_.opens_after(time))
        continue;
      fly(flight);
      if (motion_.opens_after(0.0) && motion_.opens_after(-third))
        stride_ = flight.steps;
      else
        wait_ = 1;
      return;
    }
    wait_ = 1;
  }

  /// Shows where all will be after `time` seconds.
  void lean(double time) {
    lean_ = time;
    for (std::size_t i = 0; i < seen_.size(); ++i)
      seen_[i] += time * speeds_[i];
    for (std::size_t i = 0; i < shown_q_.size(); ++i)
      shown_q_[i] = modes_.q[i] + time * modes_.v[i];
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

  /// Where the contacts stand. Returns whether any may act.
  bool gather() {
    const double *q = modes_.q.data(), *v = modes_.v.data();
    if (near_only_ && !motion_.places.all.few()) {
      motion_.gather_near(q, v, memory_.closed());
      return !motion_.places.first.empty();
    }
    if (carried_.u.empty() && !flexible_)
      return motion_.meet(q, v, solver_.window());
    motion_.gather(q, v);
    if (!carried_.u.empty()) {
      obstacles_.at(modes_.time(), carried_);
      carried_.add_to(motion_);
    }
    return flexible_ || motion_.find_near(solver_.window());
  }

  /// No contact acts, nor has acted at the end of the last step: at the end of a flight or of a single step.
  void rest(int steps) {
    const double springs = memory_.spring_energy();
    const ContactLosses losses = memory_.pass(motion_, steps, trial_);
    rows_.clear();
    Energy& energy = record_.energy;
    energy.contact_damping = lost_.damping + 0.5 * losses.damping;
    energy.friction = lost_.friction;
    energy.stored = moving_ + 0.5 * (springs + memory_.spring_energy());
    lost_.damping += losses.damping;
  }

  ContactSolver::Action solve() {
    if (flexible_) // whose contacts move at once by their own forces
      return flexible_->solve(memory_, motion_, trial_);
    memory_.follow(motion_, 0.5 * h_);
    return solver_.solve_near(memory_, motion_, trial_);
  }

  /// The contacts act.
  void act() {
    if (!gather() && memory_.closed().empty()) {
      rest(1);
      return;
    }
    const int lone = flexible_ ? -1 : motion_.lone();
    if (!(lone >= 0 && memory_.only(lone) && act_alone(lone)))
      act_together();
  }

  /// The one contact that is near, where no other was closed. Returns whether its step could be made by itself.
  bool act_alone(int c) {
    kernels::NormalPush& push = paths_.push(c);
    const bool closes = push.y == 0.0 && push.z == 0.0;
    const kernels::LoneStep step = memory_.step_alone(c, motion_, solver_.rule(), push, trial_);
    if (!step.found)
      return false;
    ContactLosses losses{step.damping, step.friction};
    if (paths_.ends(c)) {
      paths_.end_alone(c, closes, step, motion_, trial_.states[c]);
      paths_.end_slides(trial_, losses);
    }
    if (trial_.active.empty())
      rows_.clear();
    else
      rows_.set(c, step.force_y, step.force_z, h_);
    end_action({step.work, step.jump}, losses, memory_.spring_energy() - step.stored);
    return true;
  }

  void act_together() {
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
    end_action(action, losses, springs_before);
  }

  /// Forces found and committed: the modes take them.
  void end_action(const ContactSolver::Action& action, const ContactLosses& losses, double springs_before) {
    if (positions_)
      rows_.add_to(modes_.v.data(), h_ / 12.0, modes_.q.data(), shown_q_.data());
    else
      rows_.add_to(modes_.v.data());
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

  double h_;
  LoadedFlow modes_;
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

  double duration_;
  std::vector<LoadedFlow::Flight> far_; ///< the longest first
  int stride_ = 1;                      ///< steps of what follows the last action
  double lean_ = 0.0;                   ///< s
  kernels::Array speeds_;               ///< m/s, lanes, at the last record
  int wait_ = 0;                        ///< steps until flights are looked for again
  std::int64_t flown_ = 0, unconverged_ = 0;
  kernels::Array impulse_;
  bool positions_ = true;  ///< records show them
  kernels::Array shown_;   ///< with scaled masses
  kernels::Array shown_q_; ///< in the mean over the step
  kernels::Array seen_;    ///< m, lanes, likewise

  Record record_;
  double moving_ = 0.0, after_action_ = 0.0; ///< modal energy before and after the action
  double load_work_ = 0.0;                   ///< up to the last action, all of it included
  ContactLosses lost_;                       ///< likewise
};

} // namespace

std::unique_ptr<Scheme> make_splitting(const Scene& scene, double step, double fastest, int flight) {
  const Eigen::VectorXd masses = scaled_masses(scene, fastest);
  if ((masses.array() == 1.0).all())
    return std::make_unique<Splitting>(scene, step, Eigen::VectorXd(), flight);
  return std::make_unique<Splitting>(with_masses(scene, masses), step, masses.cwiseSqrt().cwiseInverse(),
                                     flight);
}

} // namespace fretwork::transient
