// SPDX-License-Identifier: GPL-3.0-or-later
#include "vibration/polynomial_flow.hpp"
#include "kernels/vector_lanes.hpp"
#include "vibration/oscillator.hpp"
#include <cmath>

namespace fretwork::vibration {
namespace {

using namespace kernels;

/// Below this value of sqrt(k) t and c t closed forms cancel; power series are taken.
constexpr double series_limit = 1.5;
/// k/c^2 (critical: 1/4) below which the two decays are far enough apart to be told from each other.
constexpr double separate = 0.2;
constexpr int series_terms = 20; ///< 1.5^20/20! and less

constexpr std::array<double, 6> factorial = {1.0, 1.0, 2.0, 6.0, 24.0, 120.0};

/// g = sum g_j t^j with (j+1)(j+2) g_{j+2} = -c (j+1) g_{j+1} - k g_j, integrated term by term.
void add_series(double k, double c, double t, std::array<double, 6>& g) {
  double now = 0.0, next = 1.0, power = 1.0;
  for (int j = 0; j < series_terms; ++j) {
    double term = now * power;
    for (std::size_t n = 1; n < g.size(); ++n) {
      term *= t / (j + static_cast<double>(n));
      g[n] += term;
    }
    const double after = -(c * (j + 1) * next + k * now) / ((j + 1.0) * (j + 2.0));
    now = next;
    next = after;
    power *= t;
  }
}

/// Coefficients by q0, v0, F0, F1, F2 of the n-th integral of q (n = 0: q; -1: v).
std::array<double, 5> coefficients(const ImpulseChain& chain, double k, double c, double h, int n) {
  const auto g = [&](int i) { return i < 0 ? chain.rate : chain.g[static_cast<std::size_t>(i)]; };
  const double by_q0 = n < 0 ? -k * g(0) : g(n - 1) + c * g(n);
  const double constant = g(n + 1), slope = g(n + 2) / h, square = 2.0 * g(n + 3) / (h * h);
  return {by_q0, g(n), constant - 3.0 * slope + 2.0 * square, 4.0 * slope - 4.0 * square,
          2.0 * square - slope};
}

constexpr int rows_of_node = 20; ///< q, v, M_0, M_1 by 5 each

/// Coefficients of s^j, j = 0, 1, 2, of the quadratic through values at the nodes.
template <class T> FRETWORK_INLINE std::array<T, 3> through(const T& f0, const T& f1, const T& f2) {
  return {f0, 4.0 * f1 - 3.0 * f0 - f2, 2.0 * (f0 - 2.0 * f1 + f2)};
}

/// Five rows of the table by what they stand for.
template <class V>
FRETWORK_INLINE V mix(const double* row, const V& q0, const V& v0, const V& f0, const V& f1, const V& f2) {
  return at<V>(row) * q0 + at<V>(row + lanes) * v0 + at<V>(row + 2 * lanes) * f0 +
         at<V>(row + 3 * lanes) * f1 + at<V>(row + 4 * lanes) * f2;
}

template <class V>
FRETWORK_INLINE void predict_uncoupled_on(int np, const double* table, const Nodes& load,
                                          const Nodes& contact, Nodes& q, Nodes& v) {
  for_vectors<V>(
      np, [&](int pack, int part) __attribute__((always_inline)) {
        const int offset = part * size_of<V>, i = pack + offset;
        const double* row = table + 2 * rows_of_node * pack + offset;
        const V q0 = at<V>(&q.at[0][i]), v0 = at<V>(&v.at[0][i]);
        const V f0 = at<V>(&load.at[0][i]) + at<V>(&contact.at[0][i]);
        const V f1 = at<V>(&load.at[1][i]), f2 = at<V>(&load.at[2][i]);
        for (int node = 1; node <= 2; ++node, row += rows_of_node * lanes) {
          at<V>(&q.at[node][i]) = mix(row, q0, v0, f0, f1, f2);
          at<V>(&v.at[node][i]) = mix(row + 5 * lanes, q0, v0, f0, f1, f2);
        }
      });
}
FRETWORK_KERNEL(void, predict_uncoupled,
                (int np, const double* table, const Nodes& load, const Nodes& contact, Nodes& q, Nodes& v),
                (np, table, load, contact, q, v))

template <class V>
FRETWORK_INLINE PolynomialFlow::Works move_uncoupled_on(int np, const double* table, const Nodes& load,
                                                        const Nodes& contact, Nodes& q, Nodes& v) {
  Sums<V> of_load[2] = {}, of_contact[2] = {};
  for_vectors<V>(
      np, [&](int pack, int part) __attribute__((always_inline)) {
        const int offset = part * size_of<V>, i = pack + offset;
        const double* row = table + 2 * rows_of_node * pack + offset;
        const V q0 = at<V>(&q.at[0][i]), v0 = at<V>(&v.at[0][i]);
        const V l0 = at<V>(&load.at[0][i]), l1 = at<V>(&load.at[1][i]), l2 = at<V>(&load.at[2][i]);
        const V c0 = at<V>(&contact.at[0][i]), c1 = at<V>(&contact.at[1][i]), c2 = at<V>(&contact.at[2][i]);
        const V f0 = l0 + c0, f1 = l1 + c1, f2 = l2 + c2;
        const auto l = through(l0, l1, l2), c = through(c0, c1, c2);
#pragma GCC unroll 2
        for (int node = 1; node <= 2; ++node, row += rows_of_node * lanes) {
          const V qn = mix(row, q0, v0, f0, f1, f2), m0 = mix(row + 10 * lanes, q0, v0, f0, f1, f2),
                  m1 = mix(row + 15 * lanes, q0, v0, f0, f1, f2);
          const double s = 0.5 * node;
          const V moved = qn - q0, by_slope = s * qn - m0, by_square = s * s * qn - 2.0 * m1;
          of_load[node - 1][part] += l[0] * moved + l[1] * by_slope + l[2] * by_square;
          of_contact[node - 1][part] += c[0] * moved + c[1] * by_slope + c[2] * by_square;
          at<V>(&q.at[node][i]) = qn;
          at<V>(&v.at[node][i]) = mix(row + 5 * lanes, q0, v0, f0, f1, f2);
        }
      });
  return {{sum(of_load[0]), sum(of_load[1])}, {sum(of_contact[0]), sum(of_contact[1])}};
}
FRETWORK_KERNEL(PolynomialFlow::Works, move_uncoupled,
                (int np, const double* table, const Nodes& load, const Nodes& contact, Nodes& q, Nodes& v),
                (np, table, load, contact, q, v))

} // namespace

std::array<double, 5> decay_functions(double x) {
  std::array<double, 5> phi{};
  if (x >= series_limit) {
    phi[0] = -std::expm1(-x) / x;
    for (std::size_t n = 1; n < 5; ++n)
      phi[n] = (1.0 / factorial[n] - phi[n - 1]) / x;
    return phi;
  }
  double term = 1.0 / 120.0; // (-x)^j/(j+5)!
  for (int j = 0; j < 24; ++j) {
    phi[4] += term;
    term *= -x / (j + 6);
  }
  for (std::size_t n = 4; n > 0; --n)
    phi[n - 1] = 1.0 / factorial[n] - x * phi[n];
  return phi;
}

ImpulseChain impulse_chain(double k, double c, double t) {
  const Impulse impulse = impulse_response(k, c, t);
  ImpulseChain out{impulse.rate, {impulse.g}};
  auto& g = out.g;
  if (k * t * t < series_limit * series_limit && c * t < series_limit) {
    add_series(k, c, t, g);
  } else if (k < separate * c *
                     c) { // g = (exp(-slow t) - exp(-fast t))/(fast - slow): k may be as small as it likes
    const double root = std::sqrt(0.25 * c * c - k), fast = 0.5 * c + root, slow = k / fast;
    const auto p = decay_functions(slow * t), q = decay_functions(fast * t);
    double power = 1.0;
    for (std::size_t n = 1; n < g.size(); ++n) {
      power *= t;
      g[n] = power / (fast - slow) * (p[n - 1] - q[n - 1]);
    }
  } else { // the equation of motion integrated n times: G_{n-2} + c G_{n-1} + k G_n = t^(n-1)/(n-1)!
    double two_before = impulse.rate, before = impulse.g, power = 1.0;
    for (std::size_t n = 1; n < g.size(); ++n) {
      g[n] = (power / factorial[n - 1] - c * before - two_before) / k;
      two_before = before;
      before = g[n];
      power *= t;
    }
  }
  return out;
}

PolynomialFlow::PolynomialFlow(const System& system, double h, CoupledFlow* coupled, int halvings)
    : modes_(system.size()), coupled_(coupled && !coupled->empty() ? coupled : nullptr), halvings_(halvings),
      padded_modes_(padded(static_cast<int>(system.size()))) {
  table_.assign(static_cast<std::size_t>(2 * rows_of_node * padded_modes_), 0.0);
  for (Eigen::Index i = 0; i < system.size(); ++i)
    for (int node = 1; node <= 2; ++node) {
      double* row = &table_[static_cast<std::size_t>(i / lanes * 2 * rows_of_node * lanes +
                                                     (node - 1) * rows_of_node * lanes + i % lanes)];
      if (coupled_ && coupled_->couples(i)) { // stays where it is, until the matrix moves it
        const double s = 0.5 * node;
        row[0] = 1.0;
        row[10 * lanes] = s;
        row[15 * lanes] = 0.5 * s * s;
        continue;
      }
      const double k = system.stiffness(i), c = system.damping(i), t = 0.5 * node * h;
      const ImpulseChain chain = impulse_chain(k, c, t);
      const auto q = coefficients(chain, k, c, h, 0), v = coefficients(chain, k, c, h, -1),
                 once = coefficients(chain, k, c, h, 1), twice = coefficients(chain, k, c, h, 2);
      for (std::size_t b = 0; b < 5; ++b) {
        row[b * lanes] = q[b];
        row[(5 + b) * lanes] = v[b];
        row[(10 + b) * lanes] = once[b] / h;
        row[(15 + b) * lanes] = (t * once[b] - twice[b]) / (h * h);
      }
    }
}

/// The coupled modes to the nodes 1/2 and 1.
/// @param force  force(mode): values at the nodes   @param take  take(node, mode, q, v, moments), the moments of the motion up to the node
template <class Force, class Take>
void PolynomialFlow::move_coupled(const Nodes& q, const Nodes& v, const Force& force,
                                  const Take& take) const {
  for (int node = 1; node <= 2; ++node)
    coupled_->move(
        halvings_ + 2 - node, q.at[0].data(), v.at[0].data(),
        [&](Eigen::Index mode, int j) {
          return std::ldexp(force(mode)[static_cast<std::size_t>(j)], (node - 2) * j); // in shares of the way
        },
        [&](Eigen::Index mode, double to, double speed, const auto& moments) {
          take(static_cast<std::size_t>(node), mode, to, speed, moments);
        });
}

void PolynomialFlow::predict_coupled(const Nodes& load, const Nodes& contact, Nodes& q, Nodes& v) const {
  move_coupled(
      q, v,
      [&](Eigen::Index mode) {
        const auto i = static_cast<std::size_t>(mode);
        return through(load.at[0][i] + contact.at[0][i], load.at[1][i], load.at[2][i]);
      },
      [&](std::size_t node, Eigen::Index mode, double to, double speed, const auto&) {
        q.at[node][static_cast<std::size_t>(mode)] = to;
        v.at[node][static_cast<std::size_t>(mode)] = speed;
      });
}

void PolynomialFlow::move_coupled(const Nodes& load, const Nodes& contact, Nodes& q, Nodes& v,
                                  Works& works) const {
  const auto of = [](const Nodes& force, std::size_t i) {
    return through(force.at[0][i], force.at[1][i], force.at[2][i]);
  };
  move_coupled(
      q, v,
      [&](Eigen::Index mode) {
        const auto i = static_cast<std::size_t>(mode);
        const auto a = of(load, i), b = of(contact, i);
        return std::array<double, 3>{a[0] + b[0], a[1] + b[1], a[2] + b[2]};
      },
      [&](std::size_t node, Eigen::Index mode, double to, double speed, const auto& moments) {
        const auto i = static_cast<std::size_t>(mode);
        const double s = 0.5 * static_cast<double>(node);
        const auto work = [&](const std::array<double, 3>& f) { // int f q' dt by parts
          return f[0] * (to - q.at[0][i]) + s * f[1] * (to - moments[0]) +
                 s * s * f[2] * (to - 2.0 * moments[1]);
        };
        works.load[node - 1] += work(of(load, i));
        works.contact[node - 1] += work(of(contact, i));
        q.at[node][i] = to;
        v.at[node][i] = speed;
      });
}

void PolynomialFlow::respond(const double* force, int to, int from, double* q, double* v) const {
  for (Eigen::Index i = 0; i < modes_; ++i) {
    const double* row = &table_[static_cast<std::size_t>(i / lanes * 2 * rows_of_node * lanes +
                                                         (to - 1) * rows_of_node * lanes + i % lanes)];
    q[i] = row[(2 + from) * lanes] * force[i];
    v[i] = row[(7 + from) * lanes] * force[i];
  }
  if (!coupled_)
    return;
  Nodes rest;
  rest.at[0].assign(static_cast<std::size_t>(padded_modes_), 0.0);
  move_coupled(
      rest, rest,
      [&](Eigen::Index mode) {
        return through(0.0, from == 1 ? force[mode] : 0.0, from == 2 ? force[mode] : 0.0);
      },
      [&](std::size_t node, Eigen::Index mode, double there, double speed, const auto&) {
        if (static_cast<int>(node) == to) {
          q[mode] = there;
          v[mode] = speed;
        }
      });
}

void PolynomialFlow::predict(const Nodes& load, const Nodes& contact, Nodes& q, Nodes& v) const {
  predict_uncoupled(padded_modes_, table_.data(), load, contact, q, v);
  if (coupled_)
    predict_coupled(load, contact, q, v);
}

PolynomialFlow::Works PolynomialFlow::move(const Nodes& load, const Nodes& contact, Nodes& q,
                                           Nodes& v) const {
  Works works = move_uncoupled(padded_modes_, table_.data(), load, contact, q, v);
  if (coupled_)
    move_coupled(load, contact, q, v, works);
  return works;
}

std::array<double, 3> part_of(const std::array<double, 3>& force, double from, double length) {
  const auto f = through(force[0], force[1], force[2]);
  return {f[0] + from * (f[1] + from * f[2]), length * (f[1] + 2.0 * from * f[2]), length * length * f[2]};
}

PolynomialState state_under(double k, double c, double h, double t, double q0, double v0,
                            const std::array<double, 3>& force) {
  const ImpulseChain chain = impulse_chain(k, c, t);
  const auto q = coefficients(chain, k, c, h, 0), v = coefficients(chain, k, c, h, -1);
  const std::array<double, 5> by = {q0, v0, force[0], force[1], force[2]};
  PolynomialState out{};
  for (std::size_t b = 0; b < 5; ++b) {
    out.q += q[b] * by[b];
    out.v += v[b] * by[b];
  }
  return out;
}

} // namespace fretwork::vibration
