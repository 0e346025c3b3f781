// SPDX-License-Identifier: GPL-3.0-or-later
#include "vibration/modal_flow.hpp"
#include "kernels/state_kernels.hpp"
#include "vibration/oscillator.hpp"
#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

namespace fretwork::vibration {

namespace {
/// w h from which on the motion over a step shows beside a cubic: its mean is off by (w h)^4/720 of its amplitude.
constexpr double least_bow = 0.1;
/// Of a mode that another flow moves.
constexpr kernels::StepCoefficients stays{1, 0, 0, 0, 0, 1, 0, 0, 1, 0, 0, 0};

/// The force of a mode's own, linear over the step, by what displacement and velocity at its end differ from without it; none above highest_followed (the matrix is singular at 2 pi).
std::array<double, 4> own_force(double k, const kernels::StepCoefficients& s, double h) {
  if (std::sqrt(k) * h > highest_followed)
    return {};
  const double det = s.qf0 * s.vf1 - s.qf1 * s.vf0;
  return {s.vf1 / det, -s.qf1 / det, -s.vf0 / det, s.qf0 / det};
}

/// Of q0, v0 and the forces at both ends: the mean of the motion less that of the cubic, (q0 + q1)/2 + h (v0 - v1)/12.
std::array<double, 4> bow_by(const kernels::StepCoefficients& s, double h) {
  return {s.mq - 0.5 * (1.0 + s.qq) + h / 12.0 * s.vq, s.mv - 0.5 * s.qv - h / 12.0 * (1.0 - s.vv),
          s.mf0 - 0.5 * s.qf0 + h / 12.0 * s.vf0, s.mf1 - 0.5 * s.qf1 + h / 12.0 * s.vf1};
}

} // namespace

ModalFlow::ModalFlow(const ForcedSystem& forced, double step, const std::vector<int>& lengths)
    : system_(with_diagonal(forced.system)), h_(step), loads_(forced, step, LoadSum::Records::by_polygon),
      lone_k_(system_.stiffness), lone_c_(system_.damping), lengths_(lengths),
      bow_(kernels::padded(static_cast<int>(system_.size()))) {
  std::vector<CoupledBlock> blocks = coupled_blocks(system_);
  apart_.assign(static_cast<std::size_t>(system_.size()), 1);
  if (fed()) {
    std::erase_if(blocks, [&](const CoupledBlock& block) {
      if (!acts_alone(system_, block))
        return false;
      const Eigen::Index j = block.modes.front();
      lone_k_(j) -= system_.motion.stiffness(j, j);
      lone_c_(j) -= system_.motion.damping(j, j);
      return true;
    });
  }
  for (const CoupledBlock& block : blocks)
    for (const Eigen::Index j : block.modes)
      apart_[static_cast<std::size_t>(j)] = 0;
  coupled_ = {system_, blocks, step};
  assert(fed() || coupled_.empty() || (lengths.size() == 1 && lengths.front() == 1));
  for (const int length : lengths)
    make_tables(length * step);
  const auto n = static_cast<std::size_t>(kernels::padded(static_cast<int>(system_.size())));
  for (kernels::Array* a : {&k_, &none_, &a_, &b_, &moved_, &rate_, &own0_, &own1_, &mean_})
    a->assign(n, 0.0);
  states_.assign(static_cast<std::size_t>(system_.motion.states()), 0.0);
  std::copy_n(system_.stiffness.data(), system_.size(), k_.begin());
  per_force_.assign(n, 0.0);
  rate_per_force_.assign(n, 0.0);
  for (Eigen::Index j = 0; j < system_.size(); ++j) {
    const kernels::StepCoefficients s = step_coefficients(lone_k_(j), lone_c_(j), h_);
    per_force_[static_cast<std::size_t>(j)] = s.qf0 + s.qf1;
    rate_per_force_[static_cast<std::size_t>(j)] = s.vf0 + s.vf1;
    if (apart_[static_cast<std::size_t>(j)] && std::sqrt(lone_k_(j)) * h_ > least_bow) {
      const std::array<double, 4> by = bow_by(s, h_);
      bow_.set(j, {by[0], by[1], by[2], by[3]});
      has_bow_ = true;
    }
  }
}

/// Of a step of this length.
void ModalFlow::make_tables(double h) {
  const int np = kernels::padded(static_cast<int>(system_.size()));
  kernels::FlowTable& apart = tables_.emplace_back(np);
  kernels::MiddleTable& middle = middles_.emplace_back(np);
  for (Eigen::Index j = 0; j < system_.size(); ++j) {
    const bool moves = apart_[static_cast<std::size_t>(j)] != 0;
    apart.set(j, system_.stiffness(j), moves ? step_coefficients(lone_k_(j), lone_c_(j), h) : stays);
    const kernels::StepCoefficients s = step_coefficients(system_.stiffness(j), system_.damping(j), 0.5 * h);
    if (moves || fed()) // under a load that goes to the mean of both ends by then
      middle.set(j, {s.qq, s.qv, s.qf0 + 0.5 * s.qf1, 0.5 * s.qf1});
  }
  if (!fed())
    return;
  kernels::FlowTable& own = own_.emplace_back(np);
  kernels::MiddleTable& inverse = inverses_.emplace_back(np);
  for (Eigen::Index j = 0; j < system_.size(); ++j) {
    const double k = system_.stiffness(j);
    const kernels::StepCoefficients s = step_coefficients(k, system_.damping(j), h);
    own.set(j, k, s);
    const std::array<double, 4> by = own_force(k, s, h);
    if (!apart_[static_cast<std::size_t>(j)] || lone_k_(j) != k || lone_c_(j) != system_.damping(j))
      inverse.set(j, {by[0], by[1], by[2], by[3]});
  }
}

std::size_t ModalFlow::place(int length) const {
  return static_cast<std::size_t>(std::find(lengths_.begin(), lengths_.end(), length) - lengths_.begin());
}

void ModalFlow::middle(int length, const State& from, const kernels::Array& load0,
                       const kernels::Array& load1, const ModalForce* force, kernels::Array& q) {
  const kernels::Array &mean = force ? force->mean : none_, &slope = force ? force->slope : none_;
  const auto uncoupled = [&](const kernels::Array& f0, const kernels::Array& f1) {
    kernels::middle(padded(), middles_[place(length)], from.q.data(), from.v.data(), f0.data(), f1.data(),
                    mean.data(), slope.data(), q.data());
  };
  if (fed()) {
    for (std::size_t i = 0; i < a_.size(); ++i) {
      a_[i] = load0[i] + own0_[i];
      b_[i] = load1[i] + own1_[i];
    }
    return uncoupled(a_, b_);
  }
  uncoupled(load0, load1);
  if (coupled_.empty())
    return;
  for (std::size_t i = 0; i < a_.size(); ++i) {
    a_[i] = load0[i] + mean[i] - slope[i];
    b_[i] = 0.5 * (load0[i] + load1[i]) + mean[i];
  }
  std::copy_n(from.q.begin(), moved_.size(), moved_.begin());
  std::copy_n(from.v.begin(), rate_.size(), rate_.begin());
  (void)coupled_.advance(1, moved_.data(), rate_.data(), a_.data(), b_.data());
  for (Eigen::Index j = 0; j < system_.size(); ++j)
    if (coupled_.couples(j))
      q[static_cast<std::size_t>(j)] = moved_[static_cast<std::size_t>(j)];
}

void ModalFlow::bow(const State& from, const kernels::Array& load0, const kernels::Array& load1,
                    const kernels::Array& force, kernels::Array& bow) const {
  kernels::middle(padded(), bow_, from.q.data(), from.v.data(), load0.data(), load1.data(), force.data(),
                  none_.data(), bow.data());
}

void ModalFlow::linear_for_bends(BentForce& by) const {
  for (Eigen::Index j = 0; j < system_.size(); ++j) {
    const double k = lone_k_(j), c = lone_c_(j), wh = std::sqrt(k) * h_;
    if (!(wh > least_bow && wh < highest_followed))
      continue;
    const std::array<LinearForce, 2> of = vibration::linear_for_bends(k, c, h_, step_coefficients(k, c, h_));
    for (std::size_t i = 0; i < by.size(); ++i) {
      by[i].mean[static_cast<std::size_t>(j)] = of[i].mean;
      by[i].slope[static_cast<std::size_t>(j)] = of[i].slope;
    }
  }
}

kernels::Array ModalFlow::squares_of_followed() const {
  kernels::Array out(k_.size(), 0.0);
  for (Eigen::Index j = 0; j < system_.size(); ++j)
    if (std::sqrt(lone_k_(j)) * h_ < highest_followed)
      out[static_cast<std::size_t>(j)] = h_ * h_;
  return out;
}

void ModalFlow::load_in_step(double start, double end, kernels::Array& load0, kernels::Array& load1,
                             double* bend) {
  if (!loads_.empty())
    loads_.in_step(start, end, load0.data(), load1.data(), bend);
}

void ModalFlow::copy_modes(const State& from, State& to) const {
  std::copy_n(from.q.begin(), padded(), to.q.begin());
  std::copy_n(from.v.begin(), padded(), to.v.begin());
}

ModalFlow::Sums ModalFlow::move(int length, const State& from, const kernels::Array& load0,
                                const kernels::Array& load1, State& to) {
  if (fed() || !coupled_.empty())
    return move_all(length, from, load0, load1, none_, none_, to);
  const kernels::FlowTable& table = tables_[place(length)];
  copy_modes(from, to);
  const kernels::FlowSums s = loads_.empty() ? kernels::flow_free(padded(), table, to.q.data(), to.v.data())
                                             : kernels::flow_loaded(padded(), table, to.q.data(), to.v.data(),
                                                                    load0.data(), load1.data());
  return {s.work, 0.0, 0.5 * s.twice_energy};
}

ModalFlow::Sums ModalFlow::push(const State& from, const kernels::Array& load0, const kernels::Array& load1,
                                const kernels::Array& mean, const kernels::Array& slope, State& to) {
  return move_all(1, from, load0, load1, mean, slope, to);
}

ModalFlow::Sums ModalFlow::move_all(int length, const State& from, const kernels::Array& load0,
                                    const kernels::Array& load1, const kernels::Array& mean,
                                    const kernels::Array& slope, State& to) {
  const std::size_t at = place(length);
  copy_modes(from, to);
  const kernels::ForcedSums s = kernels::flow_forced(padded(), tables_[at], to.q.data(), to.v.data(),
                                                     load0.data(), load1.data(), mean.data(), slope.data());
  Sums sums{s.load_work, s.contact_work, 0.5 * s.twice_energy};
  if (!fed()) {
    if (!coupled_.empty())
      move_coupled(from, load0, load1, mean, slope, to, sums);
    return sums;
  }
  to.z = from.z;
  move_remembering(length, load0, load1, mean, slope, to);
  return own_works(at, from, load0, load1, mean, slope, to);
}

/// The coupled modes with their states, step by step.
void ModalFlow::move_remembering(int length, const kernels::Array& load0, const kernels::Array& load1,
                                 const kernels::Array& mean, const kernels::Array& slope, State& to) {
  if (coupled_.empty())
    return;
  for (int step = 0; step < length; ++step) {
    const double early = static_cast<double>(step) / length, late = static_cast<double>(step + 1) / length;
    for (std::size_t i = 0; i < a_.size(); ++i) {
      const double grows = load1[i] - load0[i];
      a_[i] = load0[i] + early * grows + mean[i] - slope[i];
      b_[i] = load0[i] + late * grows + mean[i] + slope[i];
    }
    (void)coupled_.advance(0, to.q.data(), to.v.data(), a_.data(), b_.data(), to.z.data());
  }
}

ModalFlow::Sums ModalFlow::own_works(std::size_t at, const State& from, const kernels::Array& load0,
                                     const kernels::Array& load1, const kernels::Array& mean,
                                     const kernels::Array& slope, const State& to) {
  const kernels::OwnWorks s = kernels::own_works(
      padded(), own_[at], inverses_[at].data(), from.q.data(), from.v.data(), to.q.data(), to.v.data(),
      load0.data(), load1.data(), mean.data(), slope.data(), own0_.data(), own1_.data(), mean_.data());
  return {s.load, s.contact, 0.5 * s.twice_energy, s.own + work_between_modes(from, to, lengths_[at] * h_)};
}

/// That a damping matrix takes beside its diagonal, J, which is no work of the fluid: int v_i v_j by means and first Legendre coefficients.
double ModalFlow::work_between_modes(const State& from, const State& to, double duration) const {
  if (system_.damping_matrix.size() == 0)
    return 0.0;
  double work = 0.0;
  for (Eigen::Index j = 0; j < system_.size(); ++j)
    for (Eigen::Index i = 0; i < system_.size(); ++i) {
      if (i == j || system_.damping_matrix(i, j) == 0.0)
        continue;
      const auto way = [&](Eigen::Index k) { return to.q[std::size_t(k)] - from.q[std::size_t(k)]; };
      const auto bend = [&](Eigen::Index k) {
        return to.q[std::size_t(k)] + from.q[std::size_t(k)] - 2.0 * mean_[std::size_t(k)];
      };
      work += system_.damping_matrix(i, j) * (way(i) * way(j) + 3.0 * bend(i) * bend(j)) / duration;
    }
  return work;
}

/// The coupled modes, over one step.
void ModalFlow::move_coupled(const State& from, const kernels::Array& load0, const kernels::Array& load1,
                             const kernels::Array& mean, const kernels::Array& slope, State& to, Sums& sums) {
  for (std::size_t i = 0; i < a_.size(); ++i) {
    a_[i] = load0[i] + mean[i] - slope[i];
    b_[i] = load1[i] + mean[i] + slope[i];
  }
  double work = coupled_.advance(0, to.q.data(), to.v.data(), a_.data(), b_.data());
  for (Eigen::Index j = 0; j < system_.size(); ++j)
    if (coupled_.couples(j)) {
      const auto i = static_cast<std::size_t>(j);
      const double centre =
          0.5 * (from.q[i] + to.q[i]) + h_ / 12.0 * (from.v[i] - to.v[i]); // mean of q, to order 4
      const double by_force =
          (mean[i] - slope[i]) * (to.q[i] - from.q[i]) + 2.0 * slope[i] * (to.q[i] - centre);
      sums.contact_work += by_force;
      work -= by_force;
    }
  sums.load_work += work;
  sums.energy = energy(to);
}

double ModalFlow::energy(const State& state) const {
  return 0.5 * kernels::twice_energy(padded(), k_.data(), state.q.data(), state.v.data());
}

void ModalFlow::inside(double time, double duration, const State& from, const kernels::Array& load0,
                       const kernels::Array& load1, const ModalForce* force, double* q, double* v) {
  for (std::size_t i = 0; i < a_.size(); ++i) {
    const double mean = force ? force->mean[i] : 0.0, slope = force ? force->slope[i] : 0.0;
    a_[i] = load0[i] + mean - slope;
    b_[i] = (load1[i] - load0[i] + 2.0 * slope) / duration;
  }
  for (Eigen::Index j = 0; j < system_.size(); ++j) {
    const auto i = static_cast<std::size_t>(j);
    if (!apart_[i])
      continue;
    const DenseCoefficients d = dense_coefficients(lone_k_(j), lone_c_(j), time);
    q[j] = d.qq * from.q[i] + d.qv * from.v[i] + d.qf * a_[i] + d.qs * b_[i];
    v[j] = d.vq * from.q[i] + d.vv * from.v[i] + d.vf * a_[i] + d.vs * b_[i];
  }
  coupled_.inside(time, from.q.data(), from.v.data(), a_.data(), b_.data(), q, v,
                  fed() ? from.z.data() : nullptr);
  if (fed()) {
    std::copy_n(q, system_.size(), moved_.begin());
    std::copy_n(v, system_.size(), rate_.begin());
  }
}

void ModalFlow::add_motion_forces(double* force) const {
  if (!fed())
    return;
  coupled_.add_forces(force);
  for (Eigen::Index j = 0; j < system_.size(); ++j)
    if (const auto i = static_cast<std::size_t>(j); apart_[i])
      force[j] +=
          (system_.stiffness(j) - lone_k_(j)) * moved_[i] + (system_.damping(j) - lone_c_(j)) * rate_[i];
}

void ModalFlow::response(const double* force, double* moved, double* velocity) {
  std::fill(a_.begin(), a_.end(), 0.0);
  std::fill(b_.begin(), b_.end(), 0.0);
  std::fill(states_.begin(), states_.end(), 0.0);
  (void)coupled_.advance(0, a_.data(), b_.data(), force, force, states_.data());
  for (std::size_t i = 0; i < apart_.size(); ++i)
    if (apart_[i]) {
      a_[i] = per_force_[i] * force[i];
      b_[i] = rate_per_force_[i] * force[i];
    }
  std::copy(a_.begin(), a_.end(), moved);
  std::copy(b_.begin(), b_.end(), velocity);
}

} // namespace fretwork::vibration
