// SPDX-License-Identifier: GPL-3.0-or-later
#include "flow/fluidelastic.hpp"
#include "core/error.hpp"
#include "core/symmetric.hpp"
#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

namespace fretwork::flow {
namespace {

using Eigen::MatrixXd;

constexpr double equal_rates = 1e-9;      // relative
constexpr double unseen = 1e-9;           // of the largest singular value
constexpr double slow = 0.3;              // reduced velocity above which the memory counts
constexpr double interpolated = 1e-5;     // error of a lag between nodes
constexpr double least_rate = 1.0 / 20.0; // of the largest

/// Where lags are: values of V/D, 1/s, and the share of each at any other value.
class Nodes {
public:
  /// @param rates  V/D of the stations, > 0, at least one
  explicit Nodes(std::vector<double> rates) {
    std::sort(rates.begin(), rates.end());
    const double largest = rates.back(), least = std::max(rates.front(), least_rate * largest);
    least_ = least;
    rates.erase(
        std::unique(rates.begin(), rates.end(), [](double a, double b) { return b - a < equal_rates * b; }),
        rates.end());
    const double middle = 0.5 * std::log(largest * least), half = 0.5 * std::log(largest / least);
    const double y = std::numbers::pi / (2.0 * half);
    const double points = std::ceil(-std::log(interpolated) / std::asinh(y));
    if (half == 0.0 || static_cast<double>(rates.size()) <= points) {
      rates_ = std::move(rates);
      return;
    }
    exact_ = false;
    for (double k = 0.5; k < points; k += 1.0)
      rates_.push_back(std::exp(middle + half * std::cos(std::numbers::pi * k / points)));
  }

  [[nodiscard]] const std::vector<double>& rates() const { return rates_; }

  /// Of the nodes, for a lag at this V/D; they add up to 1.
  [[nodiscard]] std::vector<double> shares(double rate) const {
    std::vector<double> out(rates_.size(), exact_ ? 0.0 : 1.0);
    if (exact_) {
      const auto near = std::min_element(rates_.begin(), rates_.end(), [rate](double a, double b) {
        return std::abs(a - rate) < std::abs(b - rate);
      });
      out[static_cast<std::size_t>(near - rates_.begin())] = 1.0;
      return out;
    }
    const double x = std::log(std::max(rate, least_));
    for (std::size_t l = 0; l < rates_.size(); ++l)
      for (std::size_t k = 0; k < rates_.size(); ++k)
        if (k != l)
          out[l] *= (x - std::log(rates_[k])) / std::log(rates_[l] / rates_[k]);
    return out;
  }

private:
  std::vector<double> rates_;
  double least_ = 0.0; ///< below it shares are those at it
  bool exact_ = true;
};

/// A station in the flow.
struct Wet {
  MatrixXd shapes;            ///< along drag and lift, 2 x m
  double pressure;            ///< q w, Pa m
  double rate;                ///< V/D, 1/s
  std::vector<double> shares; ///< of the nodes
};

/// Right singular vectors of A that count.
MatrixXd seen(const MatrixXd& a) {
  const Eigen::Index rows = a.rows(), columns = a.cols();
  MatrixXd pairs = MatrixXd::Zero(rows + columns, rows + columns); // eigenvalues +-sigma
  pairs.topRightCorner(rows, columns) = a;
  pairs.bottomLeftCorner(columns, rows) = a.transpose();
  const core::Eigenpairs found = core::symmetric_eigenpairs(pairs);
  const Eigen::Index last = rows + columns - 1;
  Eigen::Index count = 0;
  while (count < columns && found.values(last - count) > unseen * found.values(last))
    ++count;
  return std::numbers::sqrt2 * found.vectors.rightCols(count).bottomRows(columns);
}

/// Adds y' = -d r y + V^T a' for the directions V that the force G of the modes on themselves sees, as real and imaginary part where d is complex.
void add_states(core::MotionForces& forces, std::complex<double> decay, const Eigen::MatrixXcd& g) {
  const bool pair = decay.imag() != 0.0;
  MatrixXd parts(pair ? 2 * g.rows() : g.rows(), g.cols());
  parts.topRows(g.rows()) = g.real();
  if (pair)
    parts.bottomRows(g.rows()) = g.imag();
  const MatrixXd directions = seen(parts);
  const Eigen::Index r = directions.cols(), m = g.rows(), first = forces.states(),
                     n = forces.stiffness.rows();
  const Eigen::Index all = first + (pair ? 2 * r : r);
  forces.rates.conservativeResizeLike(MatrixXd::Zero(all, all));
  forces.output.conservativeResizeLike(MatrixXd::Zero(all, n));
  forces.input.conservativeResizeLike(MatrixXd::Zero(n, all));
  const MatrixXd unit = MatrixXd::Identity(r, r);
  forces.rates.block(first, first, r, r) = -decay.real() * unit;
  forces.output.block(first, 0, r, m) = directions.transpose();
  forces.input.block(0, first, m, r) = g.real() * directions;
  if (!pair)
    return;
  forces.rates.block(first + r, first + r, r, r) = -decay.real() * unit;
  forces.rates.block(first, first + r, r, r) = decay.imag() * unit;
  forces.rates.block(first + r, first, r, r) = -decay.imag() * unit;
  forces.input.block(0, first + r, m, r) = -g.imag() * directions;
}

/// How many modes the lags are for: up to the last one whose reduced velocity reaches `slow` anywhere.
Eigen::Index slow_modes(const Sampling& sampling, double largest_factor) {
  double rate = 0.0;
  for (const Station& station : sampling.stations)
    rate = std::max(rate, largest_factor * station.flow.velocity / station.tube.outer_diameter);
  Eigen::Index m = sampling.modes();
  while (m > 0 && slow * sampling.frequency(m - 1) > rate)
    --m;
  return m;
}

/// f/(q u) of a motion of shape n at the reduced frequency kr = w D/V.
std::complex<double> along(const FluidelasticLaw& law, const Eigen::Vector2d& n, double kr) {
  const std::complex<double> p(0.0, kr);
  std::complex<double> sum = n.dot(law.stiffness * n) + p * n.dot(law.damping * n);
  for (const FluidelasticLaw::Lag& lag : law.lags) {
    const std::complex<double> b = n.cast<std::complex<double>>().dot(lag.force * n);
    sum += 0.5 * p * (b / (p + lag.rate) + std::conj(b) / (p + std::conj(lag.rate)));
  }
  return sum;
}

} // namespace

core::MotionForces motion_forces(const Sampling& sampling, const FluidelasticLaw& law, Eigen::Index modes,
                                 double largest_factor) {
  core::MotionForces out;
  out.stiffness = out.damping = MatrixXd::Zero(modes, modes);
  out.input = MatrixXd::Zero(modes, 0);
  out.output = MatrixXd::Zero(0, modes);
  const Eigen::Index m = slow_modes(sampling, largest_factor);
  std::vector<Wet> wet;
  std::vector<double> rates;
  for (const Station& station : sampling.stations) {
    const double v = station.flow.velocity;
    if (v == 0.0)
      continue;
    if (station.flow.drag.isZero(0.0))
      throw core::Error("the zone has no direction, which fluidelastic forces need; give direction, or the "
                        "velocity as a vector");
    MatrixXd all(2, sampling.modes());
    all << station.flow.drag.transpose() * station.shapes, station.flow.lift.transpose() * station.shapes;
    const double rate = v / station.tube.outer_diameter,
                 pressure = 0.5 * station.flow.density * v * v * station.weight;
    for (Eigen::Index j = m; j < all.cols(); ++j) {
      const std::complex<double> f =
          along(law, all.col(j), 2.0 * std::numbers::pi * sampling.frequency(j) / rate);
      out.stiffness(j, j) += pressure * f.real();
      out.damping(j, j) += pressure * f.imag() / (2.0 * std::numbers::pi * sampling.frequency(j));
    }
    MatrixXd shapes = all.leftCols(m);
    out.stiffness.topLeftCorner(m, m) += pressure * shapes.transpose() * law.stiffness * shapes;
    out.damping.topLeftCorner(m, m) += pressure / rate * shapes.transpose() * law.damping * shapes;
    wet.push_back({std::move(shapes), pressure, rate, {}});
    rates.push_back(rate);
  }
  if (m == 0 || wet.empty() || law.lags.empty())
    return out;
  const Nodes nodes(std::move(rates));
  for (Wet& station : wet)
    station.shares = nodes.shares(station.rate);
  for (const FluidelasticLaw::Lag& lag : law.lags)
    for (std::size_t l = 0; l < nodes.rates().size(); ++l) {
      Eigen::MatrixXcd g = Eigen::MatrixXcd::Zero(m, m);
      for (const Wet& station : wet)
        if (station.shares[l] != 0.0)
          g += station.pressure * station.shares[l] *
               (station.shapes.transpose() * (lag.force * station.shapes));
      add_states(out, lag.rate * nodes.rates()[l], g);
    }
  return out;
}

core::MotionForces scaled(core::MotionForces forces, double factor) {
  forces.stiffness *= factor * factor;
  forces.damping *= factor;
  forces.input *= factor * factor;
  forces.rates *= factor;
  return forces;
}

MatrixXd state_matrix(const Eigen::VectorXd& k, const Eigen::VectorXd& c, const core::MotionForces& forces) {
  const Eigen::Index n = k.size(), r = forces.states();
  MatrixXd a = MatrixXd::Zero(2 * n + r, 2 * n + r);
  a.block(0, n, n, n).setIdentity();
  a.block(n, 0, n, n) = forces.stiffness - MatrixXd(k.asDiagonal());
  a.block(n, n, n, n) = forces.damping - MatrixXd(c.asDiagonal());
  a.block(n, 2 * n, n, r) = forces.input;
  a.block(2 * n, n, r, n) = forces.output;
  a.block(2 * n, 2 * n, r, r) = forces.rates;
  return a;
}

} // namespace fretwork::flow
