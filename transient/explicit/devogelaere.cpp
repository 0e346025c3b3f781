// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The reference's scheme of order 4 (R5.06.04: Devogelaere), explicit, two evaluations of the contacts a step. With a = q'' (indices: steps):
///     q_1/2 = q_0 + (h/2) v_0 + (h^2/24)(4 a_0 - a_-1/2)
///     q_1   = q_0 + h v_0 + (h^2/6)(a_0 + 2 a_1/2)
///     w_1   = w_0 + (h/6)(w'_0 + 4 w'_1/2 + w'_1)          w = v and all other rates (motion_rates.hpp)
/// R. de Vogelaere, J. Res. Nat. Bur. Standards 54 (1955) 119, where forces do not depend on velocities. Those that do are evaluated with
/// predictions by the quadratic through the last three rates, of local error h^4 like the rest:
///     w_1/2 = w_0 + (h/24)(23 w'_0 - 16 w'_-1/2 + 5 w'_-1)
///     w_1   = w_0 + (h/6)(w'_-1/2 - 2 w'_0 + 7 w'_1/2)
/// (The reference takes v_1/2 = (q_1/2 - q_0)/(h/2) and v_1 = (q_1 - q_1/2)/(h/2) there, of local error h^2, and overwrites the memory of
/// friction at each evaluation; here it is integrated, or set once a step.) First step: rates before t = 0 from a trial half step,
/// w'_-1/2 = 2 w'_0 - w'_1/2, w'_-1 = 3 w'_0 - 2 w'_1/2. Between records: q and v by integrals of the quadratic through a_0, a_1/2, a_1.
///
/// Order 4 in displacement, velocity and force on a path without impacts, with dampers, stick and slip of return_map; 1 at best in the force
/// of a slip that turns in its plane where the spring is set once a step (`reference`, or C_T = 0); 2 through impacts, 1 where the force of
/// a normal damper jumps at a touch or a spring is set.
/// Stable for w h < 2.8 without damping (from 1.5 on 2 % of the amplitude are lost in a step), w h < 1.7 at 10 % of damping, and a damper's rate
/// c h < 0.59 (C_T W, C_N W, K_T/C_T).
#include "transient/explicit/end_record.hpp"
#include "transient/explicit/explicit_schemes.hpp"
#include "transient/scene/scheme.hpp"
#include <algorithm>

namespace fretwork::transient {
namespace {

class Devogelaere final : public Scheme {
public:
  Devogelaere(const Scene& scene, double step)
      : n_(scene.system.size()), h_(step), rates_(scene, step), record_(rates_) {
    for (kernels::Array* a : {&y0_, &y_half_, &y1_, &r_full_before_, &r_half_before_, &r0_, &r_half_, &r1_})
      a->assign(static_cast<std::size_t>(rates_.size()), 0.0);
    rates_.start(y0_.data());
    begin();
    rates_.rate(0.0, y0_.data(), r0_.data());
    record_.prepare(rates_, y0_.data(), 0.0);
  }

  const Record& advance() override {
    if (steps_ > 0) {
      y0_.swap(y1_);
      r_full_before_.swap(r0_);
      r_half_before_.swap(r_half_);
      r0_.swap(r1_);
    }
    record_.publish();
    record_.stand_for(steps_ == 0 ? 0.5 * h_ : h_);
    step();
    ++steps_;
    return record_.record();
  }

  void state_at(double time, double* q, double* v) override {
    const double t = steps_ == 0 ? 0.0 : (time - record_.record().time) / h_;
    const int np = rates_.modes();
    for (int i = 0; i < n_; ++i) {
      // a = a_0 + t b + t^2 c
      const double a0 = r0_[np + i], am = r_half_[np + i], a1 = r1_[np + i];
      const double b = 4.0 * am - 3.0 * a0 - a1, c = 2.0 * (a0 + a1) - 4.0 * am;
      q[i] = y0_[i] + t * h_ * (y0_[np + i] + t * h_ * (a0 / 2.0 + t * (b / 6.0 + t * c / 12.0)));
      v[i] = y0_[np + i] + t * h_ * (a0 + t * (b / 2.0 + t * c / 3.0));
    }
  }

  void load_at(double time, double* force) override { rates_.load_at(time, force); }

  [[nodiscard]] double next_time() const override { return static_cast<double>(steps_) * h_; }

  [[nodiscard]] StepCounts counts() const override {
    return {steps_, 0, rates_.contacts().count > 0 ? 2 * steps_ : 0, 0, h_, h_};
  }

  void visit(core::StateArchive& state) override {
    state(steps_, rates_, record_, y0_, y1_, r0_, r_half_, r1_);
  }

private:
  /// Rates before t = 0.
  void begin() {
    const int np = rates_.modes();
    rates_.rate(0.0, y0_.data(), r0_.data());
    for (int i = 0; i < rates_.size(); ++i)
      y_half_[i] = y0_[i] + 0.5 * h_ * r0_[i] + (i < np ? 0.125 * h_ * h_ * r0_[np + i] : 0.0);
    rates_.rate(0.5 * h_, y_half_.data(), r_half_.data());
    for (int i = 0; i < rates_.size(); ++i) {
      r_half_before_[i] = 2.0 * r0_[i] - r_half_[i];
      r_full_before_[i] = 3.0 * r0_[i] - 2.0 * r_half_[i];
    }
  }

  void step() {
    const int np = rates_.modes(), size = rates_.size();
    const double time = static_cast<double>(steps_) * h_;
    const double* a0 = &r0_[np];
    for (int i = 0; i < np; ++i)
      y_half_[i] = y0_[i] + h_ * (0.5 * y0_[np + i] + h_ / 24.0 * (4.0 * a0[i] - r_half_before_[np + i]));
    for (int i = np; i < size; ++i)
      y_half_[i] = y0_[i] + h_ / 24.0 * (23.0 * r0_[i] - 16.0 * r_half_before_[i] + 5.0 * r_full_before_[i]);
    rates_.rate(time + 0.5 * h_, y_half_.data(), r_half_.data());
    for (int i = 0; i < np; ++i)
      y1_[i] = y0_[i] + h_ * (y0_[np + i] + h_ / 6.0 * (a0[i] + 2.0 * r_half_[np + i]));
    for (int i = np; i < size; ++i)
      y1_[i] = y0_[i] + h_ / 6.0 * (r_half_before_[i] - 2.0 * r0_[i] + 7.0 * r_half_[i]);
    rates_.rate(time + h_, y1_.data(), r1_.data());
    for (int i = np; i < size; ++i)
      y1_[i] = y0_[i] + h_ / 6.0 * (r0_[i] + 4.0 * r_half_[i] + r1_[i]);
    rates_.commit(y1_.data());
    record_.prepare(rates_, y1_.data(), static_cast<double>(steps_ + 1) * h_);
  }

  Eigen::Index n_;
  double h_;
  MotionRates rates_;
  EndRecord record_;
  std::int64_t steps_ = 0;
  kernels::Array y0_, y_half_, y1_;
  kernels::Array r_full_before_, r_half_before_, r0_, r_half_, r1_; ///< rates at -1, -1/2, 0, 1/2 and 1 steps
};

} // namespace

std::unique_ptr<Scheme> make_devogelaere(const Scene& scene, double step) {
  return std::make_unique<Devogelaere>(scene, step);
}

} // namespace fretwork::transient
