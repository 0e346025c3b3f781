// SPDX-License-Identifier: GPL-3.0-or-later
#include "transient/modes/loaded_flow.hpp"
#include "transient/modes/modal_flow.hpp"
#include "transient/modes/oscillator.hpp"
#include <algorithm>

namespace fretwork::transient {

LoadedFlow::LoadedFlow(const Scene& scene, double step)
    : system_(with_diagonal(scene.system)), h_(step),
      loads_(scene.loads, scene.system.size(), scene.duration, step, scene.sampled_loads),
      coupled_(system_, step), first_(flow_table(system_, coupled_, 0.5 * step)),
      full_(flow_table(system_, coupled_, step)) {
  const auto n = static_cast<std::size_t>(kernels::padded(static_cast<int>(system_.size())));
  for (kernels::Array* a : {&q, &v, &k_, &f_now_, &f_next_, &slope_})
    a->assign(n, 0.0);
  std::copy_n(scene.q0.data(), scene.q0.size(), q.begin());
  std::copy_n(scene.v0.data(), scene.v0.size(), v.begin());
  std::copy_n(system_.stiffness.data(), system_.size(), k_.begin());
  // With the slopes from the start to h/2 and on to 3h/2 the first two forces weigh h/4 and 3h/4: both stand for the first step.
  loads_.at(0.0, {0.0, step}, f_now_.data());
}

double LoadedFlow::energy() const {
  return 0.5 * kernels::twice_energy(static_cast<int>(k_.size()), k_.data(), q.data(), v.data());
}

void LoadedFlow::state_at(double time, double* q_at, double* v_at) {
  const double t = time - time_, next = instant(1);
  if (!loads_.empty()) {
    loads_.at(next, f_next_.data());
    for (std::size_t i = 0; i < slope_.size(); ++i)
      slope_[i] = (f_next_[i] - f_now_[i]) / (next - time_);
  }
  for (Eigen::Index j = 0; j < system_.size(); ++j) {
    if (coupled_.couples(j))
      continue;
    const auto i = static_cast<std::size_t>(j);
    const DenseCoefficients d = dense_coefficients(system_.stiffness(j), system_.damping(j), t);
    q_at[j] = d.qq * q[i] + d.qv * v[i] + d.qf * f_now_[i] + d.qs * slope_[i];
    v_at[j] = d.vq * q[i] + d.vv * v[i] + d.vf * f_now_[i] + d.vs * slope_[i];
  }
  coupled_.inside(t, q.data(), v.data(), f_now_.data(), slope_.data(), q_at, v_at);
}

void LoadedFlow::load_at(double time, double* force) {
  if (loads_.empty()) {
    std::fill_n(force, system_.size(), 0.0);
    return;
  }
  loads_.instant(time, f_next_.data());
  std::copy_n(f_next_.data(), system_.size(), force);
}

} // namespace fretwork::transient
