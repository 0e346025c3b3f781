// SPDX-License-Identifier: GPL-3.0-or-later
#include "transient/modes/modal_flow.hpp"
#include "transient/modes/oscillator.hpp"
#include <algorithm>

namespace fretwork::transient {

namespace {
/// Of a mode that another flow moves.
constexpr StepCoefficients stays{1, 0, 0, 0, 0, 1, 0, 0, 1, 0, 0, 0};
} // namespace

kernels::FlowTable flow_table(const System& system, const MatrixFlow& coupled, double h) {
  kernels::FlowTable t(kernels::padded(static_cast<int>(system.size())));
  for (Eigen::Index j = 0; j < system.size(); ++j) {
    const double k = system.stiffness(j);
    t.set(j, k, coupled.couples(j) ? stays : step_coefficients(k, system.damping(j), h));
  }
  return t;
}

namespace {

/// Under a load that goes to the mean of both ends by then; coupled modes as above.
kernels::MiddleTable middle_table(const System& system, const MatrixFlow& coupled, double h) {
  kernels::MiddleTable t(kernels::padded(static_cast<int>(system.size())));
  for (Eigen::Index j = 0; j < system.size(); ++j) {
    const StepCoefficients s = step_coefficients(system.stiffness(j), system.damping(j), 0.5 * h);
    if (!coupled.couples(j))
      t.set(j, {s.qq, s.qv, s.qf0 + 0.5 * s.qf1, 0.5 * s.qf1});
  }
  return t;
}

/// What is left to MatrixFlow: nothing where forces of motion have taken the damping matrix.
System without_matrix(System system) {
  if (!system.motion.empty())
    system.damping_matrix.resize(0, 0);
  return system;
}

} // namespace

ModalFlow::ModalFlow(const Scene& scene, double step, const std::vector<int>& lengths)
    : system_(with_diagonal(scene.system)), h_(step),
      loads_(scene.loads, scene.system.size(), scene.duration, step, scene.sampled_loads),
      fed_(system_, step), coupled_(without_matrix(system_), step), lengths_(lengths) {
  for (const int length : lengths) {
    tables_.push_back(flow_table(system_, coupled_, length * step));
    middles_.push_back(middle_table(system_, coupled_, length * step));
    for (Eigen::Index j = 0; j < system_.size(); ++j)
      if (fed_.couples(j)) {
        tables_.back().set(j, system_.stiffness(j), stays);
        middles_.back().set(j, {0, 0, 0, 0});
      }
  }
  const auto n = static_cast<std::size_t>(kernels::padded(static_cast<int>(system_.size())));
  for (kernels::Array* a : {&k_, &none_, &a_, &b_, &moved_, &rate_})
    a->assign(n, 0.0);
  states_.assign(states(), 0.0);
  std::copy_n(system_.stiffness.data(), system_.size(), k_.begin());
  per_force_.assign(n, 0.0);
  for (Eigen::Index j = 0; j < system_.size(); ++j) {
    const StepCoefficients s = step_coefficients(system_.stiffness(j), system_.damping(j), h_);
    per_force_[static_cast<std::size_t>(j)] = s.qf0 + s.qf1;
  }
}

std::size_t ModalFlow::place(int length) const {
  return static_cast<std::size_t>(std::find(lengths_.begin(), lengths_.end(), length) - lengths_.begin());
}

void ModalFlow::middle(int length, const State& from, const kernels::Array& load0,
                       const kernels::Array& load1, const ModalForce* force, kernels::Array& q) {
  const kernels::Array &mean = force ? force->mean : none_, &slope = force ? force->slope : none_;
  kernels::middle(padded(), middles_[place(length)], from.q.data(), from.v.data(), load0.data(), load1.data(),
                  mean.data(), slope.data(), q.data());
  if (!fed_.empty()) {
    const double h = h_;
    for (std::size_t i = 0; i < a_.size(); ++i) {
      a_[i] = load0[i] + mean[i] - slope[i];
      b_[i] = (load1[i] - load0[i] + 2.0 * slope[i]) / h;
    }
    fed_.inside(0.5 * h, from.q.data(), from.v.data(), from.z.data(), a_.data(), b_.data(), q.data(),
                rate_.data());
  }
  if (coupled_.empty())
    return;
  for (std::size_t i = 0; i < a_.size(); ++i) {
    a_[i] = load0[i] + mean[i] - slope[i];
    b_[i] = 0.5 * (load0[i] + load1[i]) + mean[i];
  }
  moved_ = from.q;
  rate_ = from.v;
  (void)coupled_.advance(1, moved_.data(), rate_.data(), a_.data(), b_.data());
  for (Eigen::Index j = 0; j < system_.size(); ++j)
    if (coupled_.couples(j))
      q[static_cast<std::size_t>(j)] = moved_[static_cast<std::size_t>(j)];
}

void ModalFlow::load_about(double time, kernels::Array& load) {
  if (!loads_.empty())
    loads_.corner(time, load.data());
}

ModalFlow::Sums ModalFlow::move(int length, const State& from, const kernels::Array& load0,
                                const kernels::Array& load1, State& to) {
  to.q = from.q;
  to.v = from.v;
  to.z = from.z;
  const kernels::FlowTable& flow = tables_[place(length)];
  const kernels::FlowSums s = loads_.empty() ? kernels::flow_free(padded(), flow, to.q.data(), to.v.data())
                                             : kernels::flow_loaded(padded(), flow, to.q.data(), to.v.data(),
                                                                    load0.data(), load1.data());
  Sums sums{s.work, 0.0, 0.5 * s.twice_energy};
  if (!coupled_.empty())
    move_coupled(from, load0, load1, none_, none_, to, sums);
  if (!fed_.empty())
    move_fed(load0, load1, none_, none_, to, sums);
  return sums;
}

ModalFlow::Sums ModalFlow::move(int length, const State& from, const kernels::Array& load0,
                                const kernels::Array& load1, const kernels::Array& constant, State& to) {
  return move(length, from, load0, load1, constant, none_, to);
}

ModalFlow::Sums ModalFlow::move(int length, const State& from, const kernels::Array& load0,
                                const kernels::Array& load1, const ModalForce& force, State& to) {
  return move(length, from, load0, load1, force.mean, force.slope, to);
}

ModalFlow::Sums ModalFlow::move(int length, const State& from, const kernels::Array& load0,
                                const kernels::Array& load1, const kernels::Array& mean,
                                const kernels::Array& slope, State& to) {
  to.q = from.q;
  to.v = from.v;
  to.z = from.z;
  const kernels::ForcedSums s =
      kernels::flow_forced(padded(), tables_[place(length)], to.q.data(), to.v.data(), load0.data(),
                           load1.data(), mean.data(), slope.data());
  Sums sums{s.load_work, s.contact_work, 0.5 * s.twice_energy};
  if (!coupled_.empty())
    move_coupled(from, load0, load1, mean, slope, to, sums);
  if (!fed_.empty())
    move_fed(load0, load1, mean, slope, to, sums);
  return sums;
}

/// The modes that forces of motion couple, over one step.
void ModalFlow::move_fed(const kernels::Array& load0, const kernels::Array& load1, const kernels::Array& mean,
                         const kernels::Array& slope, State& to, Sums& sums) {
  const FeedbackFlow::Works works = fed_.advance(to.q.data(), to.v.data(), to.z.data(), load0.data(),
                                                 load1.data(), mean.data(), slope.data());
  sums.load_work += works.load;
  sums.contact_work += works.contact;
  sums.fluid_work += works.motion;
  sums.energy = energy(to);
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
    if (!apart(j))
      continue;
    const auto i = static_cast<std::size_t>(j);
    const DenseCoefficients d = dense_coefficients(system_.stiffness(j), system_.damping(j), time);
    q[j] = d.qq * from.q[i] + d.qv * from.v[i] + d.qf * a_[i] + d.qs * b_[i];
    v[j] = d.vq * from.q[i] + d.vv * from.v[i] + d.vf * a_[i] + d.vs * b_[i];
  }
  fed_.inside(time, from.q.data(), from.v.data(), from.z.data(), a_.data(), b_.data(), q, v);
  coupled_.inside(time, from.q.data(), from.v.data(), a_.data(), b_.data(), q, v);
}

void ModalFlow::load_at(double time, double* force) {
  if (loads_.empty()) {
    std::fill_n(force, system_.size(), 0.0);
    return;
  }
  loads_.instant(time, a_.data());
  std::copy_n(a_.data(), system_.size(), force);
}

void ModalFlow::answer(const double* force, double* moved) {
  std::fill(a_.begin(), a_.end(), 0.0);
  std::fill(b_.begin(), b_.end(), 0.0);
  (void)coupled_.advance(0, a_.data(), b_.data(), force, force);
  std::fill(states_.begin(), states_.end(), 0.0);
  if (!fed_.empty())
    (void)fed_.advance(a_.data(), b_.data(), states_.data(), force, force, none_.data(), none_.data());
  for (Eigen::Index j = 0; j < system_.size(); ++j)
    if (apart(j))
      a_[static_cast<std::size_t>(j)] = per_force_[static_cast<std::size_t>(j)] * force[j];
  std::copy(a_.begin(), a_.end(), moved);
}

} // namespace fretwork::transient
