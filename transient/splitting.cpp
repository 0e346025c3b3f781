// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Strang splitting of the modal motion and the contact forces, order 2 in displacement, velocity and force,
/// with damping and friction.
///
/// Between instants t_k = (k + 1/2) h the modes move freely: exact flow, loads linear in time
/// (oscillator.hpp). At t_k the contacts act once for the whole step, u being continuous and the velocity
/// jumping from v- to v+:
///     v+ = v- + h B^T f,    w = B (v- + v+)/2 = B v- + (h/2) W f,    W = B B^T
///     normal    p -+ theta h p'/2: mean penetration P over the step, its open part counted as 0 (theta =
///     0.7; p' from v-)
///               F_N = <K_N P + C_N p'(w)>+     explicit in position, implicit in velocity
///     friction  step_friction with the mean velocity w, implicit
/// The forces of all closed contacts are found together by Gauss-Seidel sweeps on w.
/// Stability: w_c h < 2, w_c^2 the largest eigenvalue of K_N^1/2 W K_N^1/2; h w_max away from multiples of
/// pi. Accuracy asks for less (step_rule.hpp). Cost: one evaluation of the contacts a step. Energy: the work
/// of each action h f.w and of each flow are exact; the ledger's residual is what the contact laws' discrete
/// work lacks.
#include "transient/load_sum.hpp"
#include "transient/oscillator.hpp"
#include "transient/packed_contacts.hpp"
#include "transient/scheme.hpp"
#include <algorithm>
#include <cmath>

namespace fretwork::transient {
namespace {

/// Share of the step over which the penetration is averaged with the velocity before the action. Between 0
/// (mean force too high) and 1 (too low) at w_c h near 1; below w_c h = 0.4 its effect is less than 1 %.
constexpr double window = 0.7;
/// Sweeps stop when no force changes by more than this share of its bound: far below the law's own accuracy.
constexpr double sweep_tolerance = 1e-6;
constexpr int most_sweeps = 60;
/// A spring that has relaxed to this share of what it had when its contact opened is forgotten (round-off of
/// the energy).
constexpr double forgotten = 1e-12;

/// What a contact needs in the step besides its state.
struct Working {
  double mean = 0.0;      ///< mean penetration P, m
  double damped = 0.0;    ///< (h/2) n.W.n
  contact::Mobility slip; ///< (h/2) W in the tangent plane
};

struct Memory {
  contact::FrictionMemory friction;
  contact::Vec2 force;       ///< friction of the step that committed it: a good first guess for the next
  double ny = 0.0, nz = 0.0; ///< normal when it was committed
  double left = 0.0; ///< share of the spring's force left since the contact opened; 0: nothing remembered
};

kernels::FlowTable flow_table(const System& system, double h) {
  kernels::FlowTable t;
  const auto n = static_cast<std::size_t>(kernels::padded(static_cast<int>(system.size())));
  for (kernels::Array* a :
       {&t.qq, &t.qv, &t.qf0, &t.qf1, &t.vq, &t.vv, &t.vf0, &t.vf1, &t.mq, &t.mv, &t.mf0, &t.mf1})
    a->assign(n, 0.0);
  for (Eigen::Index j = 0; j < system.size(); ++j) {
    const StepCoefficients s = step_coefficients(system.stiffness(j), system.damping(j), h);
    const auto i = static_cast<std::size_t>(j);
    t.qq[i] = s.qq, t.qv[i] = s.qv, t.qf0[i] = s.qf0, t.qf1[i] = s.qf1;
    t.vq[i] = s.vq, t.vv[i] = s.vv, t.vf0[i] = s.vf0, t.vf1[i] = s.vf1;
    t.mq[i] = s.mq, t.mv[i] = s.mv, t.mf0[i] = s.mf0, t.mf1[i] = s.mf1;
  }
  return t;
}

class Splitting final : public Scheme {
public:
  Splitting(const Scene& scene, double step)
      : system_(scene.system), h_(step), loads_(scene.loads, scene.system.size(), scene.duration, step),
        contacts_(scene.contacts, scene.system.size()), first_(flow_table(scene.system, 0.5 * step)),
        full_(flow_table(scene.system, step)) {
    const auto n = static_cast<std::size_t>(contacts_.padded_modes);
    for (kernels::Array* a : {&q_, &v_, &k_, &f_now_, &f_next_})
      a->assign(n, 0.0);
    std::copy_n(scene.q0.data(), scene.q0.size(), q_.begin());
    std::copy_n(scene.v0.data(), scene.v0.size(), v_.begin());
    std::copy_n(system_.stiffness.data(), system_.size(), k_.begin());
    const auto lanes = static_cast<std::size_t>(contacts_.stride());
    const auto count = static_cast<std::size_t>(contacts_.count);
    u_.assign(lanes, 0.0);
    w_.assign(lanes, 0.0);
    before_.assign(lanes, 0.0);
    near_.assign(static_cast<std::size_t>(contacts_.width), 0.0);
    states_.resize(count);
    working_.resize(count);
    memory_.resize(count);
    active_.reserve(count);
    shut_.reserve(count);
    remembering_.reserve(count);
    row_.reserve(3 * count);
    factor_.reserve(3 * count);
    for (const auto& support : contacts_.supports)
      tables_.push_back(contact::friction_table(support.friction, h_));
    loads_.at(0.0, f_now_.data());
    const double moving =
        0.5 * kernels::twice_energy(contacts_.padded_modes, k_.data(), q_.data(), v_.data());
    kernels::gather(contacts_.modes, contacts_.stride(), contacts_.gather.data(), q_.data(), v_.data(),
                    u_.data(), w_.data());
    record_.energy.initial = record_.energy.throughput = moving + contact_energy();
    after_action_ = moving;
    record_.contacts = contacts_.count;
    record_.q = q_.data();
    record_.uy = u_.data();
    record_.uz = u_.data() + contacts_.width;
    record_.states = states_;
    record_.step = h_;
  }

  const Record& advance() override {
    flow();
    act();
    record_.active = active_;
    return record_;
  }

  void state_at(double time, double* q, double* v) override {
    // Exact flow from the last action under the load's slope of the step under way. The action stands for a
    // force f over the step around it: its impulse is spread out, so that the velocity is of order 2 at any
    // instant and not only in the middle between two actions.
    const double t = time - time_, span = next_time() - time_;
    if (!loads_.empty())
      loads_.at(next_time(), f_next_.data());
    for (Eigen::Index j = 0; j < system_.size(); ++j) {
      const auto i = static_cast<std::size_t>(j);
      const DenseCoefficients d = dense_coefficients(system_.stiffness(j), system_.damping(j), t);
      const double f = f_now_[i], slope = loads_.empty() ? 0.0 : (f_next_[i] - f) / span;
      q[j] = d.qq * q_[i] + d.qv * v_[i] + d.qf * f + d.qs * slope;
      v[j] = d.vq * q_[i] + d.vv * v_[i] + d.vf * f + d.vs * slope;
    }
    const double share = t / h_ - 0.5;
    for (std::size_t r = 0; r < row_.size(); ++r)
      for (Eigen::Index j = 0; j < system_.size(); ++j) {
        const double impulse = factor_[r] * row_[r][j];
        v[j] += share * impulse;
        q[j] += 0.5 * (share * share - 0.25) * h_ *
                impulse; // nothing at the actions, where the forces are made from q
      }
  }

  void load_at(double time, double* force) override {
    if (loads_.empty()) {
      std::fill_n(force, system_.size(), 0.0);
      return;
    }
    loads_.instant(time, f_next_.data());
    std::copy_n(f_next_.data(), system_.size(), force);
  }

  [[nodiscard]] std::int64_t unconverged() const override { return unconverged_; }

private:
  [[nodiscard]] double next_time() const { return (static_cast<double>(steps_) + 0.5) * h_; }

  /// From the last action (or the start) to the next.
  void flow() {
    const kernels::FlowTable& table = steps_ == 0 ? first_ : full_;
    time_ = next_time();
    ++steps_;
    double work = 0.0;
    if (loads_.empty()) {
      kernels::flow_free(contacts_.padded_modes, table, q_.data(), v_.data());
    } else {
      if (loads_.constant())
        f_next_ = f_now_;
      else
        loads_.at(time_, f_next_.data());
      work = kernels::flow_loaded(contacts_.padded_modes, table, q_.data(), v_.data(), f_now_.data(),
                                  f_next_.data());
      f_now_.swap(f_next_);
    }
    moving_ = 0.5 * kernels::twice_energy(contacts_.padded_modes, k_.data(), q_.data(), v_.data());
    Energy& energy = record_.energy;
    energy.load_work += work;
    energy.throughput += std::abs(work);
    energy.modal_damping +=
        work - (moving_ - after_action_); // the flow is exact: what the load gave and the modes did not keep
    after_action_ = moving_;
    record_.time = time_;
    record_.energy.stored = moving_;
  }

  /// The contacts act.
  void act() {
    if (contacts_.count == 0)
      return;
    kernels::gather(contacts_.modes, contacts_.stride(), contacts_.gather.data(), q_.data(), v_.data(),
                    u_.data(), w_.data());
    for (const int c : active_)
      states_[c] = {};
    active_.clear();
    shut_.clear();
    row_.clear();
    factor_.clear();
    const double springs_before = springs_;
    const int width = contacts_.width;
    const bool any = kernels::near(width, contacts_.reach, u_.data(), u_.data() + width, w_.data(),
                                   w_.data() + width, 0.5 * window * h_, near_.data());
    double stored = 0.0;
    if (any)
      for (int c = 0; c < contacts_.count; ++c)
        if (near_[c] != 0.0)
          stored += meet(c);
    relax_open();
    double work = 0.0, jump = 0.0;
    if (!shut_.empty()) {
      before_ = w_;
      solve_forces();
      for (const int c : shut_) {
        work += close(c);
        jump += velocity_jump(c);
      }
      kernels::scatter(contacts_.padded_modes, static_cast<int>(row_.size()), row_.data(), factor_.data(),
                       v_.data());
    }
    // The record stands in the middle of the action: half of its losses belong to it, and its velocity is (v-
    // + v+)/2, whose energy is moving + work/2 - (h^2/8) f.W.f.
    Energy& energy = record_.energy;
    energy.contact_damping = contact_damping_ + 0.5 * step_damping_;
    energy.friction = friction_ + 0.5 * step_friction_;
    energy.stored = moving_ + 0.5 * work - 0.25 * jump + stored + 0.5 * (springs_before + springs_);
    contact_damping_ += step_damping_;
    friction_ += step_friction_;
    step_damping_ = step_friction_ = 0.0;
    after_action_ = moving_ + work;
  }

  /// A contact near its obstacle: its place, and whether it is shut in this step. Returns the energy of its
  /// normal spring.
  double meet(int c) {
    const contact::Support& support = contacts_.supports[c];
    const int width = contacts_.width;
    const auto at = contact::locate(support.obstacle, u_[c] + contacts_.reach.rest_y[c],
                                    u_[width + c] + contacts_.reach.rest_z[c]);
    const double p = -at.gap;
    const double rate = -(at.ny * w_[c] + at.nz * w_[width + c]);
    const double reach = 0.5 * window * h_ * rate;
    const double mean = contact::mean_penetration(p - reach, p + reach);
    const double energy = p > 0.0 ? 0.5 * support.normal.stiffness * p * p : 0.0;
    if (!(mean > 0.0))
      return energy;
    ContactState& state = states_[c];
    state.ny = at.ny;
    state.nz = at.nz;
    state.approach = rate;
    Working& work = working_[c];
    work.mean = mean;
    const double half = 0.5 * h_;
    const double yy = contacts_.own_mobility(c, 0, 0), yz = contacts_.own_mobility(c, 0, 1),
                 zz = contacts_.own_mobility(c, 1, 1);
    work.damped = half * (at.ny * at.ny * yy + 2.0 * at.ny * at.nz * yz + at.nz * at.nz * zz);
    if (support.friction.active()) { // t = (nz, -ny)
      const double xy = contacts_.own_mobility(c, 2, 0), xz = contacts_.own_mobility(c, 2, 1);
      work.slip.xx = half * contacts_.own_mobility(c, 2, 2);
      work.slip.xt = half * (at.nz * xy - at.ny * xz);
      work.slip.tt = half * (at.nz * at.nz * yy - 2.0 * at.ny * at.nz * yz + at.ny * at.ny * zz);
      Memory& memory = memory_[c];
      if (memory.left > 0.0 && memory.ny * at.ny + memory.nz * at.nz < 0.0)
        forget(c); // the opposite face: another surface
    }
    shut_.push_back(c);
    return energy;
  }

  /// Open contacts: their tangential springs die out.
  void relax_open() {
    for (const int c : remembering_)
      if (std::find(shut_.begin(), shut_.end(), c) == shut_.end())
        relax(c);
    std::erase_if(remembering_, [&](int c) { return !(memory_[c].left > 0.0); });
  }

  void relax(int c) {
    Memory& memory = memory_[c];
    const auto step = contact::open_step(contacts_.supports[c].friction, tables_[c], memory.friction);
    memory.friction = step.memory;
    memory.left *= tables_[c].relaxation;
    springs_ -= step.damper_work;
    step_damping_ += step.damper_work;
    if (memory.left < forgotten)
      forget(c);
  }

  void forget(int c) {
    const double energy = contact::spring_energy(contacts_.supports[c].friction, memory_[c].friction);
    springs_ -= energy;
    step_damping_ += energy;
    memory_[c] = {};
  }

  /// The forces of all shut contacts, by sweeps over w = B v- + (h/2) W f.
  void solve_forces() {
    bool coupled = false;
    for (const int c : shut_) {
      const contact::Support& support = contacts_.supports[c];
      const double normal =
          contact::step_normal(support.normal, working_[c].mean, states_[c].approach, working_[c].damped);
      const contact::Vec2 guess = memory_[c].left == 1.0 ? memory_[c].force : contact::Vec2{};
      const double bound = support.friction.mu_dynamic * normal, size = contact::norm(guess);
      change(c, normal, size > bound ? (bound / size) * guess : guess);
      coupled = coupled || support.friction.active() || support.normal.damps();
    }
    if (!coupled)
      return;
    for (int sweep = 0; sweep < most_sweeps; ++sweep) {
      bool settled = true;
      for (const int c : shut_)
        settled = improve(c) && settled;
      if (settled)
        return;
    }
    ++unconverged_;
  }

  /// One contact solved with all others held. Returns whether its forces stayed within the tolerance.
  bool improve(int c) {
    const contact::Support& support = contacts_.supports[c];
    const Working& work = working_[c];
    const ContactState& state = states_[c];
    const int width = contacts_.width;
    double normal = 0.0;
    if (support.normal.damps()) {
      const double rate = -(state.ny * w_[c] + state.nz * w_[width + c]) + work.damped * state.normal_force;
      normal = contact::step_normal(support.normal, work.mean, rate, work.damped) - state.normal_force;
    }
    const bool normal_settled = std::abs(normal) <= sweep_tolerance * support.normal.stiffness * work.mean;
    if (!support.friction.active()) {
      if (normal != 0.0)
        change(c, normal, {});
      return normal_settled;
    }
    const contact::Friction friction = friction_of(c, state.normal_force + normal);
    states_[c].slides = friction.slides;
    const contact::Vec2 tangential = friction.force - state.friction;
    change(c, normal, tangential);
    const double limit = sweep_tolerance * support.friction.mu_static * support.normal.stiffness * work.mean;
    return normal_settled && contact::dot(tangential, tangential) <= limit * limit;
  }

  /// Friction of one contact under a normal force, all other forces held.
  [[nodiscard]] contact::Friction friction_of(int c, double normal_force) const {
    const contact::FrictionLaw& law = contacts_.supports[c].friction;
    const contact::Mobility& a = working_[c].slip;
    const contact::Vec2 slip = slip_velocity(c), f = states_[c].friction;
    if (contacts_.components == 2)
      return contact::step_friction_line(law, tables_[c], memory_[c].friction, normal_force,
                                         slip.t - a.tt * f.t, a.tt);
    const contact::Vec2 free{slip.x - a.xx * f.x - a.xt * f.t, slip.t - a.xt * f.x - a.tt * f.t};
    return contact::step_friction_plane(law, tables_[c], memory_[c].friction, normal_force, free, a);
  }

  [[nodiscard]] contact::Vec2 slip_velocity(int c) const {
    const ContactState& state = states_[c];
    const int width = contacts_.width;
    return {contacts_.components == 3 ? w_[2 * width + c] : 0.0, state.nz * w_[c] - state.ny * w_[width + c]};
  }

  /// Adds to the force of a contact; all velocities answer.
  void change(int c, double normal, contact::Vec2 tangential) {
    ContactState& state = states_[c];
    state.normal_force += normal;
    state.friction = state.friction + tangential;
    const double half = 0.5 * h_;
    const double force[3] = {half * (normal * state.ny + tangential.t * state.nz),
                             half * (normal * state.nz - tangential.t * state.ny), half * tangential.x};
    kernels::answer(contacts_.stride(), contacts_.column(c), force, w_.data());
  }

  /// Force found: commits the memory, books the energy, queues the impulse. Returns the work on the modes.
  double close(int c) {
    const contact::Support& support = contacts_.supports[c];
    ContactState& state = states_[c];
    const int width = contacts_.width;
    const double sinking = -h_ * (state.ny * w_[c] + state.nz * w_[width + c]);
    double work = -state.normal_force * sinking;
    const double loss = (state.normal_force - support.normal.stiffness * working_[c].mean) * sinking;
    state.damper_work = loss;
    if (support.friction.active() && state.normal_force > 0.0) {
      Memory& memory = memory_[c];
      state.displacement = h_ * slip_velocity(c);
      work += contact::dot(state.friction, state.displacement);
      const double before = contact::spring_energy(support.friction, memory.friction);
      const auto step = contact::close_step(support.friction, tables_[c], memory.friction,
                                            {state.friction, state.slides}, state.displacement);
      springs_ += contact::spring_energy(support.friction, step.memory) - before;
      if (!(memory.left > 0.0))
        remember(c);
      memory = {step.memory, state.friction, state.ny, state.nz, 1.0};
      state.friction_work = step.friction_work;
      state.damper_work += step.damper_work;
      step_friction_ += step.friction_work;
    }
    step_damping_ += state.damper_work;
    if (!(state.normal_force > 0.0)) { // the damper holds the contact free of force: it is open
      relax(c);
      state = {};
      return 0.0;
    }
    active_.push_back(c);
    queue(c, state.normal_force * state.ny + state.friction.t * state.nz,
          state.normal_force * state.nz - state.friction.t * state.ny, state.friction.x);
    return work;
  }

  /// h f.(w - B v-) of one contact; over all contacts (h^2/2) f.W.f.
  [[nodiscard]] double velocity_jump(int c) const {
    const ContactState& s = states_[c];
    const auto change = [&](int component) {
      return w_[component * contacts_.width + c] - before_[component * contacts_.width + c];
    };
    const double along_x = contacts_.components == 3 ? s.friction.x * change(2) : 0.0;
    return h_ * ((s.normal_force * s.ny + s.friction.t * s.nz) * change(0) +
                 (s.normal_force * s.nz - s.friction.t * s.ny) * change(1) + along_x);
  }

  void remember(int c) {
    if (std::find(remembering_.begin(), remembering_.end(), c) == remembering_.end())
      remembering_.push_back(c);
  }

  void queue(int c, double fy, double fz, double fx) {
    const double force[3] = {fy, fz, fx};
    for (int k = 0; k < contacts_.components; ++k) {
      row_.push_back(contacts_.row(c, k));
      factor_.push_back(h_ * force[k]);
    }
  }

  /// Energy of the normal springs at the present displacements.
  [[nodiscard]] double contact_energy() const {
    double sum = 0.0;
    for (int c = 0; c < contacts_.count; ++c) {
      const auto at = contact::locate(contacts_.supports[c].obstacle, u_[c] + contacts_.reach.rest_y[c],
                                      u_[contacts_.width + c] + contacts_.reach.rest_z[c]);
      if (at.gap < 0.0)
        sum += 0.5 * contacts_.supports[c].normal.stiffness * at.gap * at.gap;
    }
    return sum;
  }

  System system_;
  double h_;
  LoadSum loads_;
  PackedContacts contacts_;
  kernels::FlowTable first_, full_;
  std::vector<contact::FrictionTable> tables_;

  std::int64_t steps_ = 0, unconverged_ = 0;
  double time_ = 0.0;
  kernels::Array q_, v_, k_, f_now_, f_next_;
  kernels::Array u_, w_, before_,
      near_; ///< contact lanes: displacement; velocity, mean and before the action
  std::vector<ContactState> states_;
  std::vector<Working> working_;
  std::vector<Memory> memory_;
  std::vector<int> active_, shut_,
      remembering_; ///< contacts with force; with a solve in this step; with a tangential memory
  std::vector<const double*> row_;
  std::vector<double> factor_;

  Record record_;
  double moving_ = 0.0, after_action_ = 0.0; ///< modal energy before and after the action
  double springs_ = 0.0;                     ///< energy of the tangential springs
  double contact_damping_ = 0.0, friction_ = 0.0, step_damping_ = 0.0, step_friction_ = 0.0;
};

} // namespace

std::unique_ptr<Scheme> make_splitting(const Scene& scene, double step) {
  return std::make_unique<Splitting>(scene, step);
}

} // namespace fretwork::transient
