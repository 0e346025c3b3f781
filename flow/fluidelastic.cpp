// SPDX-License-Identifier: GPL-3.0-or-later
#include "flow/fluidelastic.hpp"
#include "core/error.hpp"
#include "core/symmetric.hpp"
#include "flow/frozen_forces.hpp"
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

/// Tubes of one structure.
struct Structure {
  Eigen::Index first, slow;       ///< its modes among all; how many of them the lags are for
  std::vector<std::size_t> tubes; ///< numbers
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

/// Adds y' = -d r y + V^T a' for the directions V of the modes from `first` on that their force G sees, as real and imaginary part where d is
/// complex. @param rows  the modes that it acts on
void add_states(core::MotionForces& forces, std::complex<double> decay, const Eigen::MatrixXcd& g,
                const std::vector<Eigen::Index>& rows, Eigen::Index first) {
  const bool pair = decay.imag() != 0.0;
  MatrixXd parts(pair ? 2 * g.rows() : g.rows(), g.cols());
  parts.topRows(g.rows()) = g.real();
  if (pair)
    parts.bottomRows(g.rows()) = g.imag();
  const MatrixXd directions = seen(parts);
  const Eigen::Index r = directions.cols(), before = forces.states(), n = forces.stiffness.rows();
  const Eigen::Index all = before + (pair ? 2 * r : r);
  forces.rates.conservativeResizeLike(MatrixXd::Zero(all, all));
  forces.output.conservativeResizeLike(MatrixXd::Zero(all, n));
  forces.input.conservativeResizeLike(MatrixXd::Zero(n, all));
  const MatrixXd unit = MatrixXd::Identity(r, r);
  forces.rates.block(before, before, r, r) = -decay.real() * unit;
  forces.output.block(before, first, r, g.cols()) = directions.transpose();
  forces.input(rows, Eigen::seqN(before, r)) = g.real() * directions;
  if (!pair)
    return;
  forces.rates.block(before + r, before + r, r, r) = -decay.real() * unit;
  forces.rates.block(before, before + r, r, r) = decay.imag() * unit;
  forces.rates.block(before + r, before, r, r) = -decay.imag() * unit;
  forces.input(rows, Eigen::seqN(before + r, r)) = -g.imag() * directions;
}

/// Structure by structure, each with its modes up to the last one whose reduced velocity reaches `slow` anywhere.
std::vector<Structure> structures_of(const std::vector<TubeOfLaw>& tubes, double largest_factor) {
  double rate = 0.0;
  for (const TubeOfLaw& tube : tubes)
    for (const Station& station : tube.sampling.stations)
      rate = std::max(rate, largest_factor * station.flow.velocity / station.tube.outer_diameter);
  std::vector<Structure> out;
  for (std::size_t i = 0; i < tubes.size(); ++i) {
    auto at = std::find_if(out.begin(), out.end(),
                           [&](const Structure& one) { return one.first == tubes[i].first; });
    if (at == out.end()) {
      Eigen::Index m = tubes[i].sampling.modes();
      while (m > 0 && slow * tubes[i].sampling.frequency(m - 1) > rate)
        --m;
      at = out.insert(at, {tubes[i].first, m, {}});
    }
    at->tubes.push_back(i);
  }
  return out;
}

/// Block of a matrix of a law: the force on tube i by the motion of tube j.
template <class Matrix> auto block_of(const Matrix& matrix, std::size_t i, std::size_t j) {
  return matrix.template block<2, 2>(static_cast<Eigen::Index>(2 * i), static_cast<Eigen::Index>(2 * j));
}

/// f/q on tube i along n_i, where tube j moves by n_j at the reduced frequency kr = w D/V.
std::complex<double> along(const FluidelasticLaw& law, std::size_t i, std::size_t j,
                           const Eigen::Vector2d& ni, const Eigen::Vector2d& nj, double kr) {
  const std::complex<double> p(0.0, kr);
  std::complex<double> sum =
      ni.dot(block_of(law.stiffness, i, j) * nj) + p * ni.dot(block_of(law.damping, i, j) * nj);
  for (const FluidelasticLaw::Lag& lag : law.lags) {
    const std::complex<double> b = ni.cast<std::complex<double>>().dot(block_of(lag.force, i, j) * nj);
    sum += 0.5 * p * (b / (p + lag.rate) + std::conj(b) / (p + std::conj(lag.rate)));
  }
  return sum;
}

/// K_x and C_x; of fast modes what the law is at their frequency, on the diagonal.
void add_direct_forces(const std::vector<TubeOfLaw>& tubes, const FluidelasticLaw& law,
                       const std::vector<Structure>& structures,
                       const std::vector<std::vector<LawPlace>>& places, core::MotionForces& out) {
  for (const Structure& on : structures)
    for (const Structure& by : structures)
      for (const std::size_t i : on.tubes)
        for (const std::size_t j : by.tubes)
          for (std::size_t k = 0; k < places[i].size(); ++k) {
            const LawPlace& here = places[i][k];
            if (here.rate == 0.0)
              continue;
            const MatrixXd &mine = here.shapes, &its = places[j][k].shapes;
            for (Eigen::Index mode = on.slow; &on == &by && mode < mine.cols(); ++mode) {
              const double w = 2.0 * std::numbers::pi * tubes[i].sampling.frequency(mode);
              const std::complex<double> f = along(law, i, j, mine.col(mode), its.col(mode), w / here.rate);
              out.stiffness(on.first + mode, on.first + mode) += here.pressure * f.real();
              out.damping(on.first + mode, on.first + mode) += here.pressure * f.imag() / w;
            }
            const auto slow_on = mine.leftCols(on.slow), slow_by = its.leftCols(by.slow);
            out.stiffness.block(on.first, by.first, on.slow, by.slow) +=
                here.pressure * slow_on.transpose() * block_of(law.stiffness, i, j) * slow_by;
            out.damping.block(on.first, by.first, on.slow, by.slow) +=
                here.pressure / here.rate * slow_on.transpose() * block_of(law.damping, i, j) * slow_by;
          }
}

/// The lag of the motion of one structure at a node of V/D.
void add_lag(const FluidelasticLaw::Lag& lag, std::size_t node, double rate, const Structure& by,
             const std::vector<Structure>& structures, const std::vector<std::vector<LawPlace>>& places,
             core::MotionForces& out) {
  std::vector<const Structure*> moved;
  std::vector<Eigen::Index> rows;
  for (const Structure& on : structures) {
    const bool coupled = std::any_of(on.tubes.begin(), on.tubes.end(), [&](std::size_t i) {
      return std::any_of(by.tubes.begin(), by.tubes.end(),
                         [&](std::size_t j) { return !block_of(lag.force, i, j).isZero(0.0); });
    });
    if (!coupled || on.slow == 0)
      continue;
    moved.push_back(&on);
    for (Eigen::Index mode = 0; mode < on.slow; ++mode)
      rows.push_back(on.first + mode);
  }
  if (rows.empty() || by.slow == 0)
    return;
  Eigen::MatrixXcd g = Eigen::MatrixXcd::Zero(static_cast<Eigen::Index>(rows.size()), by.slow);
  Eigen::Index row = 0;
  for (const Structure* on : moved) {
    for (const std::size_t i : on->tubes)
      for (const std::size_t j : by.tubes)
        for (std::size_t k = 0; k < places[i].size(); ++k)
          if (const LawPlace& here = places[i][k]; here.rate > 0.0 && here.shares[node] != 0.0)
            g.middleRows(row, on->slow) +=
                here.pressure * here.shares[node] *
                (here.shapes.leftCols(on->slow).transpose() *
                 (block_of(lag.force, i, j) * places[j][k].shapes.leftCols(by.slow)));
    row += on->slow;
  }
  add_states(out, lag.rate * rate, g, rows, by.first);
}

} // namespace

std::vector<LawPlace> law_places(const Sampling& sampling) {
  std::vector<LawPlace> out;
  for (const Station& station : sampling.stations) {
    const double v = station.flow.velocity;
    if (v > 0.0 && station.flow.drag.isZero(0.0))
      throw core::Error("the zone has no direction, which fluidelastic forces need; give direction, or the "
                        "velocity as a vector");
    MatrixXd shapes(2, sampling.modes());
    shapes << station.flow.drag.transpose() * station.shapes, station.flow.lift.transpose() * station.shapes;
    out.push_back({std::move(shapes), 0.5 * station.flow.density * v * v * station.weight,
                   v / station.tube.outer_diameter});
  }
  return out;
}

core::MotionForces motion_forces(const std::vector<TubeOfLaw>& tubes, const FluidelasticLaw& law,
                                 Eigen::Index modes, double largest_factor) {
  core::MotionForces out;
  out.stiffness = out.damping = MatrixXd::Zero(modes, modes);
  out.input = MatrixXd::Zero(modes, 0);
  out.output = MatrixXd::Zero(0, modes);
  const std::vector<Structure> structures = structures_of(tubes, largest_factor);
  std::vector<std::vector<LawPlace>> places;
  std::vector<double> rates;
  for (const TubeOfLaw& tube : tubes) {
    places.push_back(law_places(tube.sampling));
    for (const LawPlace& place : places.back())
      if (place.rate > 0.0)
        rates.push_back(place.rate);
  }
  add_direct_forces(tubes, law, structures, places, out);
  if (rates.empty() || law.lags.empty())
    return out;
  const Nodes nodes(std::move(rates));
  for (std::vector<LawPlace>& of_tube : places)
    for (LawPlace& place : of_tube)
      if (place.rate > 0.0)
        place.shares = nodes.shares(place.rate);
  for (const FluidelasticLaw::Lag& lag : law.lags)
    for (std::size_t l = 0; l < nodes.rates().size(); ++l)
      for (const Structure& by : structures)
        add_lag(lag, l, nodes.rates()[l], by, structures, places, out);
  return out;
}

core::MotionForces scaled(core::MotionForces forces, double factor) {
  forces.stiffness *= factor * factor;
  forces.damping *= factor;
  forces.input *= factor * factor;
  forces.rates *= factor;
  return forces;
}

ForcesOverFactor forces_over_factor(const std::vector<TubeOfLaw>& tubes, const FluidelasticLaw& law,
                                    Eigen::Index modes, double largest_factor) {
  if (!law.frozen)
    return [forces = motion_forces(tubes, law, modes, largest_factor)](double factor) {
      return scaled(forces, factor);
    };
  const TubeOfLaw& tube = tubes.front();
  return [places = law_places(tube.sampling), frequency = tube.sampling.frequency, first = tube.first, modes,
          frozen = *law.frozen](double factor) {
    return frozen_forces(places, frozen, frequency, first, modes, factor);
  };
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
