// SPDX-License-Identifier: GPL-3.0-or-later
#include "bench/reference_flow.hpp"
#include "core/error.hpp"
#include <algorithm>
#include <cmath>
#include <limits>

// One text for all processors: the loader takes the clone that the processor has.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__)
#define FRETWORK_CLONES __attribute__((target_clones("arch=skylake-avx512", "arch=haswell", "default")))
#else
#define FRETWORK_CLONES
#endif

namespace fretwork::bench {
namespace {

constexpr double two_pi = 6.283185307179586;
constexpr double line_phase = 0.03, parabola_phase = 0.25; ///< rad of the fastest load
constexpr double mode_phase =
    1.0; ///< rad of the highest mode in the longest flow: what contacts do in it is smooth
constexpr int most_levels = 16;

FRETWORK_CLONES void flow_step(std::size_t n, const double* __restrict qq, const double* __restrict qv,
                               const double* __restrict vq, const double* __restrict vv,
                               const double* __restrict qf, const double* __restrict vf,
                               const double* __restrict slope, double* __restrict f, double* __restrict q,
                               double* __restrict v) {
  for (std::size_t i = 0; i < n; ++i) {
    const double u = q[i], w = v[i];
    q[i] = qq[i] * u + qv[i] * w + qf[i] * f[i];
    v[i] = vq[i] * u + vv[i] * w + vf[i] * f[i];
    f[i] += slope[i];
  }
}

using Matrix5 = Eigen::Matrix<double, 5, 5>;

/// exp(A) by the series of A/2^s, squared s times.
Matrix5 exponential(Matrix5 a) {
  int squarings = 0;
  for (double size = a.cwiseAbs().maxCoeff(); size > 0.25; size *= 0.5)
    ++squarings;
  a *= std::pow(0.5, squarings);
  Matrix5 sum = Matrix5::Identity(), term = sum;
  for (int k = 1; k <= 14; ++k) {
    term = (term * a / k).eval();
    sum += term;
  }
  for (; squarings > 0; --squarings)
    sum = (sum * sum).eval();
  return sum;
}

bool is_supported(const signals::TimeFunction& function) {
  return std::holds_alternative<signals::Random>(function) ||
         std::holds_alternative<signals::Harmonic>(function) ||
         std::holds_alternative<signals::Constant>(function) ||
         std::holds_alternative<signals::Table>(function);
}

} // namespace

FRETWORK_CLONES double inner(std::size_t n, const double* a, const double* b) {
  double sum = 0.0;
#pragma omp simd reduction(+ : sum)
  for (std::size_t i = 0; i < n; ++i)
    sum += a[i] * b[i];
  return sum;
}

FRETWORK_CLONES void add(std::size_t n, double s, const double* __restrict a, double* __restrict to) {
  for (std::size_t i = 0; i < n; ++i)
    to[i] += s * a[i];
}

ReferenceFlow::ReferenceFlow(const transient::Scene& scene, double step)
    : n_(static_cast<std::size_t>(scene.system.size())), h_(step), duration_(scene.duration) {
  sort(scene);
  for (const Eigen::Index i : order_) {
    q.push_back(scene.q0(i));
    v.push_back(scene.v0(i));
    stiffness_.push_back(scene.system.stiffness(i));
    damping_.push_back(scene.system.damping(i));
  }
  for (auto* a : {&load_, &slope_, &middle_, &last_, &far_q, &far_v})
    a->assign(n_, 0.0);
  double fastest = 0.0;
  for (const vibration::Load& load : scene.loads) {
    if (!is_supported(load.function))
      throw core::Error("the reference solution takes constant, harmonic and random loads and tables only");
    if (const auto* table = std::get_if<signals::Table>(&load.function)) {
      if (std::adjacent_find(table->time.begin(), table->time.end()) != table->time.end())
        throw core::Error("the reference solution takes no tables with jumps");
      rows_.insert(rows_.end(), table->time.begin(), table->time.end());
    }
    signals_.emplace_back(load.function, scene.duration);
    fastest = std::max(fastest, two_pi * signals::highest_frequency(load.function));
    auto& shape = shapes_.emplace_back();
    for (const Eigen::Index i : order_)
      shape.push_back(load.modal_force(i));
  }
  std::sort(rows_.begin(), rows_.end());
  const double highest = std::sqrt(scene.system.stiffness.maxCoeff());
  double longest = duration_ / 1000.0;
  longest = fastest > 0.0 ? std::min(longest, parabola_phase / fastest) : longest;
  longest = highest > 0.0 ? std::min(longest, mode_phase / highest) : longest;
  for (double length = h_; flows_.empty() || (length <= longest && levels() < most_levels); length *= 2)
    flows_.push_back(table_of(length));
  line_steps_ = fastest > 0.0
                    ? std::max<std::int64_t>(1, static_cast<std::int64_t>(line_phase / (fastest * h_)))
                    : 1000;
}

void ReferenceFlow::sort(const transient::Scene& scene) {
  const auto moves = [&](Eigen::Index mode, Eigen::Index row) {
    return std::any_of(scene.contacts.begin(), scene.contacts.end(),
                       [&](const transient::ContactPoint& point) { return point.b(row, mode) != 0.0; });
  };
  std::vector<Eigen::Index> groups[4]; // y only, both, z only, neither
  for (Eigen::Index i = 0; i < scene.system.size(); ++i) {
    const bool y = moves(i, 1), z = moves(i, 2);
    groups[y ? (z ? 1 : 0) : (z ? 2 : 3)].push_back(i);
  }
  for (const auto& group : groups)
    order_.insert(order_.end(), group.begin(), group.end());
  y_ = {0, groups[0].size() + groups[1].size()};
  z_ = {groups[0].size(), groups[0].size() + groups[1].size() + groups[2].size()};
}

/// From the exponential of the equations of (q, v, f, f', f'').
ReferenceFlow::Table ReferenceFlow::table_of(double length) const {
  Table out;
  out.length = length;
  for (std::size_t i = 0; i < n_; ++i) {
    const double scale = std::max(std::sqrt(stiffness_[i]), 1.0 / length); // q and v alike
    Matrix5 a = Matrix5::Zero();                                           // in times of `length`
    a(0, 1) = scale * length;
    a(1, 0) = -stiffness_[i] * length / scale;
    a(1, 1) = -damping_[i] * length;
    a(1, 2) = length / scale;
    a(2, 3) = a(3, 4) = 1.0;
    const Matrix5 e = exponential(a);
    out.qq.push_back(e(0, 0));
    out.qv.push_back(e(0, 1) / scale);
    out.vq.push_back(e(1, 0) * scale);
    out.vv.push_back(e(1, 1));
    out.q0.push_back(e(0, 2));
    out.q1.push_back(e(0, 3));
    out.q2.push_back(e(0, 4));
    out.v0.push_back(e(1, 2) * scale);
    out.v1.push_back(e(1, 3) * scale);
    out.v2.push_back(e(1, 4) * scale);
  }
  return out;
}

void ReferenceFlow::load_at(double time, std::vector<double>& force) const {
  std::fill(force.begin(), force.end(), 0.0);
  for (std::size_t k = 0; k < signals_.size(); ++k)
    add(n_, signals_[k](time), shapes_[k].data(), force.data());
}

std::int64_t ReferenceFlow::steps_to_row() {
  constexpr double round_off = 1e-6; // of a step: a row that is so near is at its end
  const double time = static_cast<double>(unit_) * h_ + round_off * h_;
  while (row_ < rows_.size() && rows_[row_] <= time)
    ++row_;
  if (row_ == rows_.size())
    return std::numeric_limits<std::int64_t>::max();
  return static_cast<std::int64_t>((rows_[row_] - time) / h_ + 2.0 * round_off);
}

/// The line on which the loads are for the next steps, `line_steps_` or those to the next row, at the middle of the first.
void ReferenceFlow::renew_line() {
  line_left_ = std::clamp(steps_to_row(), std::int64_t{1}, line_steps_);
  const double time = static_cast<double>(unit_) * h_, share = 1.0 / static_cast<double>(line_left_);
  load_at(time, load_);
  load_at(std::min(time + static_cast<double>(line_left_) * h_, duration_), last_);
  for (std::size_t i = 0; i < n_; ++i) {
    slope_[i] = share * (last_[i] - load_[i]);
    load_[i] += 0.5 * slope_[i];
  }
}

void ReferenceFlow::advance() {
  if (line_left_ == 0)
    renew_line();
  const Table& t = flows_.front();
  flow_step(n_, t.qq.data(), t.qv.data(), t.vq.data(), t.vv.data(), t.q0.data(), t.v0.data(), slope_.data(),
            load_.data(), q.data(), v.data());
  --line_left_;
  ++unit_;
}

void ReferenceFlow::extrapolate(int level) {
  const Table& t = flows_[static_cast<std::size_t>(level)];
  const double time = static_cast<double>(unit_) * h_;
  level_ = level;
  line_left_ = 0;
  load_at(time, load_);
  load_at(time + 0.5 * t.length, middle_);
  load_at(time + t.length, last_);
  for (std::size_t i = 0; i < n_; ++i) {
    const double f = load_[i], df = 4.0 * middle_[i] - 3.0 * f - last_[i],
                 ddf = 4.0 * (f - 2.0 * middle_[i] + last_[i]);
    far_q[i] = t.qq[i] * q[i] + t.qv[i] * v[i] + t.q0[i] * f + t.q1[i] * df + t.q2[i] * ddf;
    far_v[i] = t.vq[i] * q[i] + t.vv[i] * v[i] + t.v0[i] * f + t.v1[i] * df + t.v2[i] * ddf;
  }
}

void ReferenceFlow::accept() {
  q.swap(far_q);
  v.swap(far_v);
  unit_ += std::int64_t{1} << level_;
}

} // namespace fretwork::bench
