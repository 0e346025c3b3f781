// SPDX-License-Identifier: GPL-3.0-or-later
#include "vibration/oscillator.hpp"
#include <algorithm>
#include <array>
#include <cmath>

namespace fretwork::vibration {
namespace {

/// Below this value of sqrt(k) t and c t the closed forms of the load responses cancel; their power series is
/// taken instead.
constexpr double series_limit = 1.5;
/// Value of k/c^2 (critical: 1/4) below which the two decays are far enough apart to be told from each other.
constexpr double separate = 0.2;
/// Terms of a series are taken down to this share of the first one.
constexpr double negligible = 1e-18;
constexpr std::size_t most_terms = 32; ///< series_limit^j/j! is negligible before

/// 1/j.
constexpr auto per = [] {
  std::array<double, most_terms + 4> out{};
  for (std::size_t j = 1; j < out.size(); ++j)
    out[j] = 1.0 / static_cast<double>(j);
  return out;
}();

/// Responses to loads that start with the step.
struct LoadResponse {
  double r0, r1; ///< int g, int (t - s) g(s) ds: to a constant unit load, to a load of unit slope
  double d0, d1; ///< their derivatives
  double i0, i1; ///< their integrals
};

/// By the power series g = sum g_j t^j: (j+1) g_{j+1} = -c g_j - k g_{j-1}/j, g_0 = 0, g_1 = 1. With x = max(sqrt(k), c) t, which no
/// root of s^2 + c s + k exceeds, |g_j| t^j <= t x^(j-1)/(j-1)!.
LoadResponse series_response(double k, double c, double t, const Impulse& im) {
  const double ct = c * t, kt2 = k * t * t, x = std::max(ct, std::sqrt(kt2));
  double last = 0.0, now = t; // g_{j-1} t^{j-1}, g_j t^j
  double r0 = 0.0, r1 = 0.0, i1 = 0.0, bound = 1.0;
  for (std::size_t j = 1; bound > negligible; ++j) {
    const double once = now * per[j + 1], twice = once * per[j + 2]; // integrated
    r0 += once;
    r1 += twice;
    i1 += twice * per[j + 3];
    const double next = -(ct * now + kt2 * per[j] * last) * per[j + 1];
    last = now;
    now = next;
    bound *= x * per[j];
  }
  r0 *= t, r1 *= t * t, i1 *= t * t * t;
  return {r0, r1, im.g, r0, r1, i1};
}

/// k > 0: particular solutions (1 for a constant load k, t - c/k for a slope k) less the homogeneous motion
/// that starts from them.
LoadResponse closed_response(double k, double c, double t, const Impulse& im) {
  const double a = im.rate + c * im.g;
  LoadResponse out{};
  out.r0 = (1.0 - a) / k;
  out.d0 = im.g;
  out.r1 = (t - im.g - c * out.r0) / k; // from the equation integrated once: g + c r0 + k r1 = t
  out.d1 = out.r0;
  out.i0 = out.r1;
  out.i1 = (0.5 * t * t - out.r0 - c * out.r1) / k; // integrated twice
  return out;
}

/// phi_n = int_0^1 exp(-x (1 - s)) s^(n-1)/(n-1)! ds, n = 1, 2, 3, for x >= 0.
struct Phi {
  double one, two, three;
};

Phi phi(double x) {
  if (x >= series_limit) {
    const double one = -std::expm1(-x) / x, two = (1.0 - one) / x;
    return {one, two, (0.5 - two) / x};
  }
  double three = 0.0, term = 1.0 / 6.0; // (-x)^j/(j+3)!
  for (int j = 0; j < 24; ++j) {
    three += term;
    term *= -x / (j + 4);
  }
  const double two = 0.5 - x * three;
  return {1.0 - x * two, two, three};
}

/// Two separate decays (k = 0 included): g = (exp(-slow t) - exp(-fast t))/(fast - slow), each integrated by
/// itself, since k may be as small as it likes.
LoadResponse decay_response(double k, double c, double t, const Impulse& im) {
  const double root = std::sqrt(0.25 * c * c - k), fast = 0.5 * c + root, slow = k / fast;
  const Phi p = phi(slow * t), q = phi(fast * t);
  const double scale = t / (fast - slow);
  LoadResponse out{};
  out.d0 = im.g;
  out.r0 = out.d1 = scale * (p.one - q.one);
  out.r1 = out.i0 = scale * t * (p.two - q.two);
  out.i1 = scale * t * t * (p.three - q.three);
  return out;
}

LoadResponse load_response(double k, double c, double t, const Impulse& im) {
  if (k * t * t < series_limit * series_limit && c * t < series_limit)
    return series_response(k, c, t, im);
  return k < separate * c * c ? decay_response(k, c, t, im) : closed_response(k, c, t, im);
}

} // namespace

Impulse impulse_response(double k, double c, double t) {
  const double decay = 0.5 * c;
  const double discriminant = k - decay * decay;
  const double x2 = discriminant * t * t;
  if (std::abs(x2) <
      1e-4) { // near critical damping: sin(x)/x and cos(x) by their series, error below x2^3/5040
    const double e = std::exp(-decay * t);
    const double sinc = 1.0 - x2 / 6.0 * (1.0 - x2 / 20.0);
    const double cosine = 1.0 - 0.5 * x2 * (1.0 - x2 / 12.0);
    return {e * t * sinc, e * (cosine - decay * t * sinc)};
  }
  if (discriminant > 0.0) {
    const double wd = std::sqrt(discriminant), e = std::exp(-decay * t);
    const double s = std::sin(wd * t) / wd;
    return {e * s, e * (std::cos(wd * t) - decay * s)};
  }
  // overdamped: two decaying exponentials, the slow root from the product of roots (no cancellation)
  const double root = std::sqrt(-discriminant);
  const double fast = decay + root, slow = k / fast;
  const double es = std::exp(-slow * t), ef = std::exp(-fast * t);
  return {(es - ef) / (2.0 * root), (fast * ef - slow * es) / (2.0 * root)};
}

kernels::StepCoefficients step_coefficients(double k, double c, double h) {
  const Impulse im = impulse_response(k, c, h);
  const LoadResponse r = load_response(k, c, h, im);
  kernels::StepCoefficients s{};
  s.qq = im.rate + c * im.g;
  s.qv = im.g;
  s.qf1 = r.r1 / h;
  s.qf0 = r.r0 - s.qf1;
  s.vq = -k * im.g;
  s.vv = im.rate;
  s.vf1 = r.d1 / h;
  s.vf0 = r.d0 - s.vf1;
  // means: int a = g + c int g
  s.mq = (im.g + c * r.r0) / h;
  s.mv = r.r0 / h;
  s.mf1 = r.i1 / (h * h);
  s.mf0 = r.i0 / h - s.mf1;
  return s;
}

std::array<LinearForce, 2> linear_for_bends(double k, double c, double h,
                                            const kernels::StepCoefficients& s) {
  const double q0 = s.qf0 + s.qf1, q1 = s.qf1, v0 = s.vf0 + s.vf1, v1 = s.vf1;
  const double v2 = 2.0 / h * q1, q2 = (1.0 - c * v2 - 2.0 / h * v1) / k; // Q_2'' = 2 Q_1'/h
  const double v3 = 3.0 / h * q2, q3 = (1.0 - c * v3 - 6.0 / (h * h) * q1) / k;
  const double q_slope = 2.0 * q1 - q0, v_slope = 2.0 * v1 - v0, det = q0 * v_slope - q_slope * v0;
  const auto linear = [&](double q, double v) {
    return LinearForce{(v_slope * q - q_slope * v) / det, (q0 * v - v0 * q) / det};
  };
  return {linear(6.0 * (q2 - q1) + q0, 6.0 * (v2 - v1) + v0),
          linear(20.0 * q3 - 30.0 * q2 + 12.0 * q1 - q0, 20.0 * v3 - 30.0 * v2 + 12.0 * v1 - v0)};
}

DenseCoefficients dense_coefficients(double k, double c, double t) {
  const Impulse im = impulse_response(k, c, t);
  const LoadResponse r = load_response(k, c, t, im);
  return {im.rate + c * im.g, im.g, r.r0, r.r1, -k * im.g, im.rate, r.d0, r.d1};
}

} // namespace fretwork::vibration
