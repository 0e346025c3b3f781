// SPDX-License-Identifier: GPL-3.0-or-later
#include "flow/response.hpp"
#include "core/error.hpp"
#include <algorithm>
#include <cassert>
#include <cmath>
#include <complex>
#include <fmt/format.h>
#include <limits>
#include <memory>
#include <numbers>

namespace fretwork::flow {
namespace {

constexpr double two_pi = 2.0 * std::numbers::pi;
constexpr double panel_per_distance = 0.6; ///< widths of panels against the distance to the nearest pole
constexpr double share_of_first =
    0.01; ///< of the lowest mode's frequency: the distance of f = 0, a branch point of power laws
constexpr std::array<int, 4> powers = {0, 1, 2, 4};

struct GaussPoint {
  double place, weight; ///< on [0, 1]
};
/// Gauss and Legendre, 10 points; abscissas and weights: Abramowitz and Stegun, table 25.4.
constexpr std::array<GaussPoint, 10> gauss() {
  constexpr double x[5] = {0.148874338981631211, 0.433395394129247191, 0.679409568299024406,
                           0.865063366688984511, 0.973906528517171720};
  constexpr double w[5] = {0.295524224714752870, 0.269266719309996355, 0.219086362515982044,
                           0.149451349150580593, 0.066671344308688138};
  std::array<GaussPoint, 10> out{};
  for (std::size_t i = 0; i < 5; ++i) {
    out[2 * i] = {0.5 - 0.5 * x[i], 0.5 * w[i]};
    out[2 * i + 1] = {0.5 + 0.5 * x[i], 0.5 * w[i]};
  }
  return out;
}

void check(const LinearModes& m, double low, double high) {
  if (m.omega.size() != m.mass.size() || m.omega.size() != m.damping.size() || m.omega.size() == 0)
    throw core::Error(fmt::format(
        "modes of a linear response have {} masses, {} frequencies and {} damping ratios; give as many of "
        "all, at least one",
        m.mass.size(), m.omega.size(), m.damping.size()));
  if (!(low >= 0.0) || !(high > low) || !std::isfinite(high))
    throw core::Error(fmt::format(
        "a linear response from {:g} Hz to {:g} Hz makes no sense; give 0 <= low < high", low, high));
  for (Eigen::Index i = 0; i < m.omega.size(); ++i) {
    if (!(m.mass[i] > 0.0) || !std::isfinite(m.mass[i]))
      throw core::Error(
          fmt::format("mode {}: modal mass = {:g} makes no sense; give a number > 0", i + 1, m.mass[i]));
    if (!(m.omega[i] >= 0.0) || !std::isfinite(m.omega[i]))
      throw core::Error(
          fmt::format("mode {}: {:g} rad/s makes no sense; give a number >= 0", i + 1, m.omega[i]));
    if (m.omega[i] == 0.0 && low == 0.0)
      throw core::Error(fmt::format(
          "mode {} is a rigid motion, whose response has no end towards 0 Hz; begin above 0 Hz", i + 1));
    if (m.omega[i] > 0.0 && !(m.damping[i] > 0.0 && m.damping[i] < 1.0))
      throw core::Error(fmt::format(
          "mode {}: a damping ratio of {:g} gives no stationary response; give one between 0 and 1", i + 1,
          m.damping[i]));
  }
}

/// Ends of panels, Hz.
class Panels {
public:
  Panels(const LinearModes& modes, const std::vector<double>& breaks, double low, double high) {
    double first = high;
    for (Eigen::Index i = 0; i < modes.omega.size(); ++i)
      if (modes.omega[i] > 0.0) {
        const double f = modes.omega[i] / two_pi, xi = modes.damping[i];
        poles_.emplace_back(f * std::sqrt(1.0 - xi * xi), f * xi);
        first = std::min(first, f);
      }
    poles_.emplace_back(0.0, share_of_first * first);
    std::vector<double> ends = {low, high};
    for (const double f : breaks)
      if (f > low && f < high)
        ends.push_back(f);
    std::sort(ends.begin(), ends.end());
    for (std::size_t i = 1; i < ends.size(); ++i)
      if (ends[i] > ends[i - 1])
        divide(ends[i - 1], ends[i]);
  }
  std::vector<std::array<double, 2>> panels;

private:
  void divide(double a, double b) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const std::complex<double>& p : poles_)
      nearest = std::min(nearest, std::hypot(std::max({0.0, a - p.real(), p.real() - b}), p.imag()));
    if (b - a <= panel_per_distance * nearest) {
      panels.push_back({a, b});
      return;
    }
    const double middle = 0.5 * (a + b);
    divide(a, middle);
    divide(middle, b);
  }
  std::vector<std::complex<double>> poles_; ///< those of the upper half plane
};

} // namespace

LoadSpectrum load_spectrum(const std::vector<TurbulentZone>& zones, double low, double high, Part part) {
  const CrossSpectrum exact(zones, part);
  const auto table = std::make_shared<const CrossSpectrumTable>(exact, low, high);
  return {[table](double f, Eigen::MatrixXd& g) { (*table)(f, g); }, {}, exact.breaks()};
}

LoadSpectrum load_spectrum(const MatrixLoad& load, std::vector<double> breaks) {
  return {[load](double f, Eigen::MatrixXd& g) { g = cross_spectrum(load, f).real(); },
          [load](double f, Eigen::MatrixXd& g) { g = cross_spectrum(load, f).imag(); }, std::move(breaks)};
}

LinearResponse::LinearResponse(const LinearModes& modes, const LoadSpectrum& load, double low, double high) {
  check(modes, low, high);
  const Eigen::Index n = modes.omega.size();
  for (Eigen::MatrixXd& m : moments_)
    m = Eigen::MatrixXd::Zero(n, n);
  Eigen::MatrixXd real(n, n), imaginary(n, n), s(n, n);
  Eigen::VectorXd a(n), b(n); // 1/Z = a + i b
  for (const auto& [from, to] : Panels(modes, load.breaks, low, high).panels)
    for (const GaussPoint& point : gauss()) {
      const double f = from + point.place * (to - from), w = two_pi * f;
      for (Eigen::Index i = 0; i < n; ++i) {
        const double wi = modes.omega[i], damping = wi > 0.0 ? modes.damping[i] : 0.0;
        const std::complex<double> h =
            1.0 / (modes.mass[i] * std::complex<double>(wi * wi - w * w, 2.0 * damping * wi * w));
        a[i] = h.real();
        b[i] = h.imag();
      }
      load.real(f, real);
      assert(real.rows() == n && real.cols() == n);
      // Re[G_ij h_i conj h_j], h_i conj h_j = a_i a_j + b_i b_j + i (b_i a_j - a_i b_j)
      s.noalias() = a * a.transpose();
      s.noalias() += b * b.transpose();
      s.array() *= real.array();
      if (load.imaginary) {
        load.imaginary(f, imaginary);
        s.array() -= imaginary.array() * (b * a.transpose() - a * b.transpose()).array();
      }
      for (std::size_t k = 0; k < powers.size(); ++k)
        moments_[k] += (point.weight * (to - from) * std::pow(w, powers[k])) * s;
      ++evaluations_;
    }
}

const Eigen::MatrixXd& LinearResponse::moment(int k) const {
  const auto at = std::find(powers.begin(), powers.end(), k);
  assert(at != powers.end());
  return moments_[static_cast<std::size_t>(at - powers.begin())];
}

SpectralMoments LinearResponse::at(const Eigen::VectorXd& shape) const {
  const auto of = [&](std::size_t k) { return std::max(0.0, shape.dot(moments_[k] * shape)); };
  return {of(0), of(1), of(2), of(3)};
}

std::vector<SpectralMoments> LinearResponse::at_points(const Eigen::MatrixXd& shapes) const {
  std::vector<SpectralMoments> out;
  for (Eigen::Index p = 0; p < shapes.rows(); ++p)
    out.push_back(at(shapes.row(p).transpose()));
  return out;
}

double SpectralMoments::rms() const { return std::sqrt(L0); }
double SpectralMoments::rms_velocity() const { return std::sqrt(L2); }
double SpectralMoments::up_crossings() const { return L0 > 0.0 ? std::sqrt(L2 / L0) / two_pi : 0.0; }
double SpectralMoments::irregularity() const { return L0 > 0.0 && L4 > 0.0 ? L2 / std::sqrt(L0 * L4) : 0.0; }

std::optional<double> SpectralMoments::maximum(double duration, double probability) const {
  if (!(duration > 0.0) || !(probability > 0.0 && probability < 1.0))
    throw core::Error(fmt::format("no maximum over {:g} s at a probability of {:g}; give a duration > 0 and "
                                  "a probability between 0 and "
                                  "1",
                                  duration, probability));
  if (!(L0 > 0.0))
    return 0.0;
  const double crossings = -duration * up_crossings() / std::log(probability); // N
  if (!(2.0 * crossings > 1.0) || duration * up_crossings() < 1.0)
    return std::nullopt;
  const double width = std::sqrt(std::max(0.0, 1.0 - L1 * L1 / (L0 * L2))); // d
  const double clumps =
      1.0 - std::exp(-std::pow(width, 1.2) * std::sqrt(std::numbers::pi * std::log(2.0 * crossings)));
  if (!(2.0 * crossings * clumps > 1.0))
    return std::nullopt;
  return rms() * std::sqrt(2.0 * std::log(2.0 * crossings * clumps));
}

Eigen::VectorXd share_outside(const LinearModes& modes, const std::vector<TurbulentZone>& zones, double low,
                              double high, const Eigen::MatrixXd& shapes) {
  const LinearResponse all(modes, load_spectrum(zones, low, high), low, high);
  LoadSpectrum covered = load_spectrum(zones, low, high, Part::covered);
  const LinearResponse inside(modes, covered, low, high);
  Eigen::VectorXd out(shapes.rows());
  for (Eigen::Index p = 0; p < shapes.rows(); ++p) {
    const double whole = all.at(shapes.row(p).transpose()).L0;
    out[p] = whole > 0.0 ? std::clamp(1.0 - inside.at(shapes.row(p).transpose()).L0 / whole, 0.0, 1.0) : 0.0;
  }
  return out;
}

} // namespace fretwork::flow
