// SPDX-License-Identifier: GPL-3.0-or-later
#include "flow/fluidelastic_law.hpp"
#include "core/symmetric.hpp"
#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numbers>

namespace fretwork::flow {
namespace {

using Complex = std::complex<double>;

FluidelasticLaw steady_part(double drag, double lift, const Eigen::MatrixXd& gradients) {
  FluidelasticLaw law;
  law.stiffness = gradients;
  law.damping << -2.0 * drag, lift, -2.0 * lift, -drag;
  law.damping = for_each_tube(law.damping, law.tubes());
  return law;
}

// e^-x ~ D(-x)/D(x), D = 120 + 60 x + 12 x^2 + x^3
Complex pade(Complex x) { return 120.0 + x * (60.0 + x * (12.0 + x)); }
Complex pade_rate(Complex x) { return 60.0 + x * (24.0 + 3.0 * x); }

/// The root of D(-d) near a first value, by Newton's method.
Complex pade_root(Complex d) {
  for (int i = 0; i < 20; ++i)
    d += pade(-d) / pade_rate(-d);
  return d;
}

constexpr int rates_tried = 16;
constexpr double slowest_rate = 0.2; // of the least kr
constexpr double damping_weight = 10.0;
constexpr double ridge =
    1e-5; // of the largest diagonal: coefficients stay small where the rows do not tell lags apart

/// The least squares for given rates: unknowns c_k, c_d of K, C and the B_i; rows c_k, then c_d of each measurement.
struct Fit {
  Eigen::MatrixXd rows; ///< without weights
  Eigen::VectorXd measured, coefficients;
  double squares = 0.0;

  Fit(const std::vector<MeasuredForce>& table, const std::vector<double>& rates) {
    const auto n = static_cast<Eigen::Index>(table.size()), lags = static_cast<Eigen::Index>(rates.size());
    rows = Eigen::MatrixXd::Zero(2 * n, 2 + lags);
    measured.resize(2 * n);
    for (Eigen::Index i = 0; i < n; ++i) {
      const MeasuredForce& force = table[static_cast<std::size_t>(i)];
      const double kr = 2.0 * std::numbers::pi / force.reduced_velocity;
      measured(i) = force.stiffness;
      measured(n + i) = force.damping;
      rows(i, 0) = rows(n + i, 1) = 1.0;
      for (Eigen::Index l = 0; l < lags; ++l) {
        const double d = rates[static_cast<std::size_t>(l)], size = kr * kr + d * d;
        rows(i, 2 + l) = kr * kr / size;
        rows(n + i, 2 + l) = d / size;
      }
    }
    Eigen::VectorXd weights = Eigen::VectorXd::Ones(2 * n);
    weights.tail(n).setConstant(damping_weight);
    const Eigen::MatrixXd weighted = weights.asDiagonal() * rows;
    Eigen::MatrixXd normal = weighted.transpose() * weighted;
    normal.diagonal().array() += ridge * normal.diagonal().maxCoeff();
    coefficients = core::Cholesky(normal).solve(weighted.transpose() * weights.asDiagonal() * measured);
    squares = (weights.asDiagonal() * (rows * coefficients - measured)).squaredNorm();
  }
};

} // namespace

FluidelasticLaw quasi_steady_law(double drag, double lift, const Eigen::MatrixXd& gradients, double delay) {
  FluidelasticLaw law = steady_part(drag, lift, gradients);
  if (delay == 0.0)
    return law;
  for (const Complex first : {Complex(4.64, 0.0), Complex(3.68, 3.51)}) {
    const Complex d = pade_root(first), share = pade(d) / (pade_rate(-d) * d);
    const double pair = first.imag() == 0.0 ? 1.0 : 2.0;
    law.lags.push_back({d / delay, -pair * share * gradients.cast<Complex>()});
  }
  law.lags.front().rate = law.lags.front().rate.real(); // without round-off beside it
  return law;
}

FluidelasticLaw quasi_unsteady_law(double drag, double lift, const Eigen::MatrixXd& gradients,
                                   const std::vector<Memory>& memory) {
  FluidelasticLaw law = steady_part(drag, lift, gradients);
  for (const Memory& m : memory)
    law.lags.push_back({m.rate, (-m.share * gradients).cast<Complex>()});
  return law;
}

FluidelasticLaw connors_law(double constant) {
  FluidelasticLaw law;
  law.stiffness(0, 1) = 8.0 * std::numbers::pi / (constant * constant);
  law.stiffness(1, 0) = -law.stiffness(0, 1);
  return law;
}

FluidelasticLaw connors_damping_law(double constant) {
  FluidelasticLaw law;
  law.frozen.emplace().connors = 4.0 / (constant * constant);
  return law;
}

FluidelasticLaw frozen_law(std::vector<MeasuredForce> rows) {
  std::sort(rows.begin(), rows.end(),
            [](const auto& a, const auto& b) { return a.reduced_velocity < b.reduced_velocity; });
  FluidelasticLaw law;
  law.range = {rows.front().reduced_velocity, rows.back().reduced_velocity};
  law.frozen = FrozenForce{{{}, {}}, {{}, {}}};
  for (const MeasuredForce& row : rows) {
    law.frozen->stiffness.s.push_back(row.reduced_velocity);
    law.frozen->stiffness.values.push_back(row.stiffness);
    law.frozen->damping.values.push_back(row.damping);
  }
  law.frozen->damping.s = law.frozen->stiffness.s;
  return law;
}

FittedLaw fitted_law(const std::vector<MeasuredForce>& table, int lags) {
  const auto [slowest, fastest] =
      std::minmax_element(table.begin(), table.end(), [](const auto& a, const auto& b) {
        return a.reduced_velocity < b.reduced_velocity;
      });
  const double least = slowest_rate * 2.0 * std::numbers::pi / fastest->reduced_velocity,
               most = 2.0 * std::numbers::pi / slowest->reduced_velocity;
  std::vector<double> best;
  double squares = std::numeric_limits<double>::infinity();
  for (unsigned chosen = 1; chosen < 1u << rates_tried; ++chosen) { // every choice of so many rates
    if (std::popcount(chosen) != lags)
      continue;
    std::vector<double> rates;
    for (int k = 0; k < rates_tried; ++k)
      if (chosen >> k & 1u)
        rates.push_back(least * std::pow(most / least, k / (rates_tried - 1.0)));
    if (const double sum = Fit(table, rates).squares; sum < squares) {
      squares = sum;
      best = rates;
    }
  }
  const Fit fit(table, best);
  FittedLaw out;
  out.law.stiffness(1, 1) = fit.coefficients(0);
  out.law.damping(1, 1) = fit.coefficients(1);
  for (std::size_t l = 0; l < best.size(); ++l) {
    Eigen::MatrixXcd force = Eigen::MatrixXcd::Zero(2, 2);
    force(1, 1) = fit.coefficients(2 + static_cast<Eigen::Index>(l));
    out.law.lags.push_back({best[l], force});
  }
  out.law.range = {slowest->reduced_velocity, fastest->reduced_velocity};
  const Eigen::VectorXd missed = (fit.rows * fit.coefficients - fit.measured).cwiseAbs();
  const auto n = static_cast<Eigen::Index>(table.size());
  out.stiffness_error = missed.head(n).maxCoeff();
  out.damping_error = missed.tail(n).maxCoeff();
  return out;
}

} // namespace fretwork::flow
