// SPDX-License-Identifier: GPL-3.0-or-later
#include "transient/explicit/motion_rates.hpp"
#include <algorithm>
#include <cmath>

namespace fretwork::transient {

using contact::Vec2;

namespace {

constexpr double round_off = 1e-12; ///< of a friction force at its bound

} // namespace

MotionRates::MotionRates(const Scene& scene, double step)
    : system_(scene.system), loads_(scene, step), smeared_(step),
      contacts_(scene.contacts, scene.system.size()), motion_(contacts_), difference_(contacts_),
      obstacles_(scene, contacts_), imposed_(obstacles_.workspace()), trial_(contacts_.count),
      rows_(contacts_), regimes_(static_cast<std::size_t>(contacts_.count)),
      memory_(static_cast<std::size_t>(contacts_.count)), q0_(kernels::padded_copy(scene.q0)),
      v0_(kernels::padded_copy(scene.v0)), k_(kernels::padded_copy(system_.stiffness)),
      c_(kernels::padded_copy(system_.lone_damping())), load_(q0_.size(), 0.0) {}

void MotionRates::start(double* y) {
  std::fill_n(y, size(), 0.0);
  std::copy(q0_.begin(), q0_.end(), y);
  std::copy(v0_.begin(), v0_.end(), y + modes());
  obstacles_.place(0.0, y, y + modes(), imposed_, motion_);
  position_ = motion_.u;
  for (int c = 0; c < contacts_.count; ++c) {
    const Regime regime = regime_of_laws(c, motion_, {});
    set_regime(c, regime.closed, regime.slides);
  }
}

void MotionRates::rate(double time, const double* y, double* rate) {
  if (!loaded_ || !loads_.constant())
    smeared_ > 0.0 ? loads_.at(time, load_.data())
                   : loads_.instant(std::min(time, last_instant_), load_.data());
  loaded_ = true;
  structure(y, rate);
  std::fill_n(rate + 2 * modes(), size() - 2 * modes(), 0.0);
  double* totals = rate + 2 * modes() + 4 * contacts_.count;
  const double* v = y + modes();
  double power = 0.0, damping = 0.0;
  for (int i = 0; i < modes(); ++i) {
    power += load_[i] * v[i];
    damping += v[i] * (load_[i] - k_[i] * y[i] - rate[modes() + i]);
  }
  if (!system_.motion.empty())
    move_fluid(y, rate);
  if (contacts_.count > 0) {
    obstacles_.place(time, y, v, imposed_, motion_);
    act(springs(y), rate + 2 * modes());
    rows_.add_to(trial_, rate + modes());
    power -= product(contacts_, trial_, imposed_.w);
  }
  totals[0] = power;
  totals[1] = std::abs(power);
  totals[2] = damping;
}

void MotionRates::structure(const double* y, double* rate) {
  const int np = modes();
  const double* v = y + np;
  for (int i = 0; i < np; ++i) {
    rate[i] = v[i];
    rate[np + i] = load_[i] - k_[i] * y[i] - c_[i] * v[i];
  }
  if (system_.damping_matrix.size() > 0)
    for (Eigen::Index j = 0; j < system_.size(); ++j)
      for (Eigen::Index i = 0; i < system_.size(); ++i)
        rate[np + i] -= system_.damping_matrix(i, j) * v[j];
}

/// The forces that depend on the motion, with the rates of their work and states.
void MotionRates::move_fluid(const double* y, double* rate) {
  const core::MotionForces& f = system_.motion;
  const Eigen::Index n = system_.size(), r = f.states(), at = 2 * modes() + 4 * contacts_.count + 3;
  const Eigen::Map<const Eigen::VectorXd> v(y + modes(), n), z(y + at + 1, r);
  std::fill_n(load_.begin(), n, 0.0);
  add_motion_forces(y, load_.data());
  loaded_ = false;
  for (Eigen::Index i = 0; i < n; ++i) {
    const double force = load_[static_cast<std::size_t>(i)];
    rate[modes() + i] += force;
    rate[at] += force * v(i);
  }
  for (Eigen::Index i = 0; i < r; ++i)
    rate[at + 1 + i] = f.rates.row(i).dot(z) + f.output.row(i).dot(v);
}

void MotionRates::add_motion_forces(const double* y, double* force) const {
  const core::MotionForces& f = system_.motion;
  if (f.empty())
    return;
  const Eigen::Index n = system_.size();
  const Eigen::Map<const Eigen::VectorXd> q(y, n), v(y + modes(), n),
      z(y + 2 * modes() + 4 * contacts_.count + 4, f.states());
  for (Eigen::Index i = 0; i < n; ++i)
    force[i] += f.stiffness.row(i).dot(q) + f.damping.row(i).dot(v) + f.input.row(i).dot(z);
}

void MotionRates::act(const double* s, double* rate) {
  trial_.clear();
  motion_.find_near(0.0);
  for (int c = 0; c < contacts_.count; ++c) {
    const Vec2 spring{s[4 * c], s[4 * c + 1]};
    const bool held = located_ && regimes_[c].closed;
    if ((held || motion_.near(c)) && press(c, spring, rate + 4 * c))
      continue;
    if (rated(c)) { // the spring of an open contact dies out through its damper
      const contact::FrictionLaw& law = contacts_.supports[c].friction;
      const Vec2 stretching = (1.0 / law.damping) * spring;
      rate[4 * c] = -law.stiffness * stretching.x;
      rate[4 * c + 1] = -law.stiffness * stretching.t;
      rate[4 * c + 3] += dot(spring, stretching);
    }
  }
}

/// Whether there is a normal force; if not, the power of what the positive part cuts is in the rate.
bool MotionRates::press(int c, Vec2 spring, double* rate) {
  const auto at = face_of(c, motion_);
  const Normal normal = normal_of(c, motion_, at);
  const contact::NormalLaw& law = contacts_.supports[c].normal;
  const double elastic = law.stiffness * std::max(0.0, normal.penetration);
  trial_.springs += law.spring_energy(normal.penetration);
  const bool closed = located_ ? regimes_[c].closed : normal.penetration >= 0.0 && normal.force > 0.0;
  const double force = closed ? normal.force : 0.0;
  rate[3] = (force - elastic) * normal.rate;
  if (!closed)
    return false;
  ContactState& state = trial_.states[c];
  state.normal_force = force;
  state.axes = at.axes();
  state.approach = normal.rate;
  if (contacts_.supports[c].friction.active())
    rub(c, spring, state, rate);
  trial_.active.push_back(c);
  return true;
}

void MotionRates::rub(int c, Vec2 in_state, ContactState& state, double* rate) const {
  const contact::FrictionLaw& law = contacts_.supports[c].friction;
  const Vec2 velocity = motion_.slip(c, state.axes);
  state.displacement =
      motion_.tangential(c, state.axes, motion_.u) - motion_.tangential(c, state.axes, position_);
  const Vec2 spring = touches(c) ? stretched_since_touch(c, state) : used_spring(c, in_state, state.axes);
  contact::Friction friction{law.trial(spring, velocity), regimes_[c].slides};
  if (!located_ || !locates_friction(c)) {
    friction = contact::evaluate(law, {spring, regimes_[c].slides}, state.normal_force, {}, velocity);
    // A spring that was set to the bound at the end of a slide is still there when the next step begins.
    const double bound = law.mu_dynamic * state.normal_force;
    friction.slides = friction.slides || (regimes_[c].slides && dot(friction.force, velocity) < 0.0 &&
                                          norm(friction.force) >= (1.0 - round_off) * bound);
  } else if (friction.slides) {
    const double size = norm(friction.force);
    friction.force = size > 0.0 ? (law.mu_dynamic * state.normal_force / size) * friction.force : Vec2{};
  }
  state.friction = friction.force;
  state.slides = friction.slides;
  state.slid = state.slides ? norm(state.displacement) : 0.0;
  const Vec2 stretching = rated(c) ? (1.0 / law.damping) * (spring - friction.force) : velocity;
  rate[0] = -law.stiffness * stretching.x;
  rate[1] = -law.stiffness * stretching.t;
  if (rated(c)) {
    rate[2] -= dot(friction.force, velocity - stretching);
    rate[3] += law.damping * dot(stretching, stretching);
  } else {
    rate[friction.slides ? 2 : 3] -= dot(friction.force, velocity);
  }
}

void MotionRates::commit(double* y) {
  double* s = y + 2 * modes();
  for (int c = 0; c < contacts_.count; ++c)
    if (contacts_.supports[c].friction.active())
      set_spring(c, s + 4 * c);
  for (int c = 0; c < contacts_.count; ++c) {
    const ContactState& state = trial_.states[c];
    const bool closed = located_ ? regimes_[c].closed : state.normal_force > 0.0;
    if (!located_ || !locates_friction(c))
      set_regime(c, closed, closed && state.slides);
    if (closed)
      regimes_[c].axes = state.axes;
    else if (double& excess = regimes_[c].excess; excess > 0.0)
      excess = std::clamp(closing_force(c, motion_, motion_.locate(c)), 0.0, excess);
  }
  position_ = motion_.u;
}

void MotionRates::set_spring(int c, double* s) {
  const contact::FrictionLaw& law = contacts_.supports[c].friction;
  const ContactState& state = trial_.states[c];
  Memory& memory = memory_[c];
  const bool closed = state.axes.ny != 0.0 || state.axes.nz != 0.0; // in the trial
  Vec2 spring{s[0], s[1]};
  if (closed) {
    const Vec2 loaded = used_spring(c, spring, state.axes);
    const Vec2 kept = used_spring(c, memory.spring, state.axes); // of what there was at the last commit
    if (rated(c)) {
      s[3] += law.spring_energy(spring) - law.spring_energy(loaded);
      memory.forgotten += law.spring_energy(spring) - law.spring_energy(loaded);
      spring = loaded;
    } else {
      spring = state.slides || touches(c) ? state.friction : loaded;
      s[3] += law.spring_energy(memory.spring) - law.spring_energy(kept);
      memory.forgotten += law.spring_energy(memory.spring) - law.spring_energy(kept);
      const bool by_slider = state.slides && law.kind == contact::FrictionMemoryKind::return_map;
      s[by_slider ? 2 : 3] -= law.spring_energy(spring) - law.spring_energy(kept);
      if (by_slider && !memory.slid && regimes_[c].closed) {
        // at an event, where the spring kept mu_s F_N, or within a step
        const double normal = located_ ? norm(kept) / law.mu_static : state.normal_force;
        const double work = law.damper_work_at_slip_onset(normal);
        s[2] -= work;
        s[3] += work;
      }
    }
    memory.slid = state.slides;
    memory.axes = state.axes;
  } else if (!rated(c)) {
    spring = {};
    s[3] += law.spring_energy(memory.spring);
    memory.slid = false;
  }
  s[0] = spring.x;
  s[1] = spring.t;
  memory.spring = spring;
}

double MotionRates::moving_energy(const double* y) const {
  double sum = 0.5 * kernels::twice_energy(modes(), k_.data(), y, y + modes());
  for (int c = 0; c < contacts_.count; ++c)
    if (contacts_.supports[c].friction.active())
      sum += contacts_.supports[c].friction.spring_energy(spring(y, c));
  return sum;
}

double MotionRates::norm2(const double* difference) {
  double sum = 2.0 * moving_energy(difference);
  difference_.gather(difference, difference + modes());
  const int lanes = contacts_.stride(), width = contacts_.width;
  for (int c = 0; c < contacts_.count; ++c)
    if (regimes_[c].closed)
      for (int lane = c; lane < lanes; lane += width)
        sum += contacts_.supports[c].normal.stiffness * difference_.u[lane] * difference_.u[lane];
  return sum;
}

/// The branches of `reference` depend on what the last step has set: they have no bounds in time.
bool MotionRates::locates_friction(int c) const {
  const contact::FrictionLaw& law = contacts_.supports[c].friction;
  return law.active() && law.kind == contact::FrictionMemoryKind::return_map;
}

bool MotionRates::sets_springs() const {
  for (int c = 0; c < contacts_.count; ++c)
    if (contacts_.supports[c].friction.active() && !rated(c))
      return true;
  return false;
}

Energy MotionRates::energy(const double* y) const {
  const double* s = springs(y);
  const double* totals = s + 4 * contacts_.count;
  Energy energy;
  energy.load_work = totals[0];
  energy.scale = totals[1];
  energy.modal_damping = totals[2];
  if (!system_.motion.empty())
    energy.fluid_work = totals[3];
  energy.stored = moving_energy(y) + trial_.springs;
  for (int c = 0; c < contacts_.count; ++c)
    if (const contact::FrictionLaw& law = contacts_.supports[c].friction; law.active() && !rated(c))
      energy.stored +=
          law.spring_energy(memory_[c].spring) - law.spring_energy(spring(y, c)); // counted when it is set
  for (int c = 0; c < contacts_.count; ++c) {
    energy.friction += s[4 * c + 2];
    energy.contact_damping += s[4 * c + 3];
  }
  return energy;
}

bool MotionRates::rated(int c) const {
  const contact::FrictionLaw& law = contacts_.supports[c].friction;
  return law.active() && law.kind == contact::FrictionMemoryKind::return_map && law.damping > 0.0;
}

void MotionRates::close(int c, const contact::ContactAxes& face) {
  const auto here = motion_.locate(c).axes();
  set_regime(c, true, false);
  regimes_[c].axes = here.opposite(face) ? here.reversed() : here;
}

void MotionRates::set_regime(int c, bool closed, bool slides) {
  Regime& regime = regimes_[c];
  if (closed && !regime.closed)
    regime.axes = motion_.locate(c).axes();
  if (closed || !located_)
    regime.excess = 0.0;
  else if (regime.closed)
    regime.excess = std::max(0.0, closing_force(c, motion_, face_of(c, motion_)));
  regime.closed = closed;
  regime.slides = slides;
}

/// What has to be positive for contact c to be closed, N.
double MotionRates::closing_force(int c, const ContactMotion& motion, const contact::Location& at) const {
  const Normal normal = normal_of(c, motion, at);
  return std::min(contacts_.supports[c].normal.stiffness * normal.penetration, normal.force);
}

/// Where a contact is; of one that is closed, from its face.
contact::Location MotionRates::face_of(int c, const ContactMotion& motion) const {
  const auto at = motion.locate(c);
  const Regime& regime = regimes_[c];
  const bool opposite = located_ && regime.closed && regime.axes.opposite(at.axes());
  return opposite ? at.from_opposite() : at;
}

/// The force is that of the closed branch: where it ends, negative.
MotionRates::Normal MotionRates::normal_of(int c, const ContactMotion& motion,
                                           const contact::Location& at) const {
  const double p = -at.gap, rate = motion.penetration_rate(c, at.axes());
  return {p, rate, contacts_.supports[c].normal.spring_and_damper(p, rate)};
}

/// On another face than where the contact was last closed, only what has been loaded since the last commit.
Vec2 MotionRates::used_spring(int c, Vec2 spring, const contact::ContactAxes& axes) const {
  const Memory& memory = memory_[c];
  return memory.axes.opposite(axes) ? spring - memory.spring : spring;
}

/// Whether a contact without damper has been open at the last commit: rates cannot tell its spring from when on it is stretched.
bool MotionRates::touches(int c) const {
  return !located_ && !regimes_[c].closed && locates_friction(c) && !rated(c);
}

Vec2 MotionRates::stretched_since_touch(int c, const ContactState& state) const {
  const auto lane = static_cast<std::size_t>(c), z = static_cast<std::size_t>(contacts_.width) + lane;
  const double deeper = -state.axes.normal(motion_.u[lane] - position_[lane],
                                           motion_.u[z] - position_[z]); // m, since the commit
  const double penetration = -motion_.locate(c).gap;
  const double share = deeper > penetration ? penetration / deeper : 1.0;
  return (-share * contacts_.supports[c].friction.stiffness) * state.displacement;
}

Margins MotionRates::margin(int c, const ContactMotion& motion, Vec2 in_state) const {
  const auto at = face_of(c, motion);
  const Normal normal = normal_of(c, motion, at);
  const contact::FrictionLaw& law = contacts_.supports[c].friction;
  const Regime& regime = regimes_[c];
  Margins margins{closing_force(c, motion, at), -1.0};
  if (located_ && !regime.axes.opposite(at.axes()))
    margins.normal -= regime.excess;
  if (law.active() && !locates_friction(c)) {
    margins.friction = regime.slides ? 1.0 : -1.0;
  } else if (law.active()) {
    const Vec2 trial = law.trial(used_spring(c, in_state, at.axes()), motion.slip(c, at.axes()));
    // at a touch the force is 0 up to round-off: a contact without damper, whose spring is 0 then, sticks
    margins.friction = norm(trial) - law.coefficient(regime.slides) * std::max(0.0, normal.force);
  }
  return margins;
}

Regime MotionRates::regime_of_laws(int c, const ContactMotion& motion, Vec2 spring) const {
  const Margins margins = margin(c, motion, spring);
  const bool closed = margins.normal > 0.0;
  return {closed, closed && margins.friction > 0.0, {}};
}

} // namespace fretwork::transient
