// SPDX-License-Identifier: GPL-3.0-or-later
#include "flow/cross_spectrum.hpp"
#include "core/error.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace fretwork::flow {
namespace {

constexpr double values_per_octave = 24.0; ///< of the slowly varying ratio: linear between, below 1e-3

Eigen::VectorXd correlations(const Eigen::VectorXd& s, double correlation_length) {
  Eigen::VectorXd r = Eigen::VectorXd::Zero(s.size());
  for (Eigen::Index k = 1; k < s.size(); ++k)
    r[k] = std::exp(-(s[k] - s[k - 1]) / correlation_length);
  return r;
}

Eigen::MatrixXd markov_sum(const Eigen::MatrixXd& a, const Eigen::VectorXd& r) {
  Eigen::MatrixXd b = a;
  for (Eigen::Index k = 1; k < a.cols(); ++k)
    b.col(k) += r[k] * b.col(k - 1);
  const Eigen::MatrixXd product = a * (b - 0.5 * a).transpose();
  return product + product.transpose();
}

} // namespace

CrossSpectrum::CrossSpectrum(const std::vector<TurbulentZone>& zones, Part part) : part_(part) {
  if (zones.empty())
    throw core::Error("a cross-spectrum of turbulence without a zone; give one at least");
  check(zones);
  modes_ = zones.front().modes();
  for (const TurbulentZone& from : zones) {
    Zone zone{ZoneSpectra(from), from.ds, correlations(from.s, from.correlation_length), {}, {}};
    for (const LoadAxis& axis : from.axes)
      zone.axes.push_back(std::sqrt(axis.weight) * axis.shapes * from.ds.asDiagonal());
    if (zone.spectra.separable()) {
      Eigen::VectorXd factors(from.patches());
      for (Eigen::Index k = 0; k < from.patches(); ++k)
        factors[k] = zone.spectra.factor(k);
      zone.unit = sum(zone, factors);
    }
    zones_.push_back(std::move(zone));
  }
}

Eigen::VectorXd CrossSpectrum::amplitudes(const Zone& zone, double f) const {
  Eigen::VectorXd out(zone.ds.size());
  for (Eigen::Index k = 0; k < out.size(); ++k)
    out[k] = part_ == Part::covered && !zone.spectra.covers(k, f) ? 0.0 : zone.spectra.amplitude(k, f);
  return out;
}

double CrossSpectrum::common(const Zone& zone, double f) const {
  return part_ == Part::covered && !zone.spectra.covers(0, f) ? 0.0 : zone.spectra.common(f);
}

Eigen::MatrixXd CrossSpectrum::sum(const Zone& zone, const Eigen::VectorXd& amplitudes) const {
  Eigen::MatrixXd g = Eigen::MatrixXd::Zero(modes_, modes_);
  for (const Eigen::MatrixXd& axis : zone.axes)
    g += markov_sum(axis * amplitudes.asDiagonal(), zone.r);
  return g;
}

Eigen::MatrixXd CrossSpectrum::operator()(double f) const {
  Eigen::MatrixXd g = Eigen::MatrixXd::Zero(modes_, modes_);
  for (const Zone& zone : zones_)
    if (zone.spectra.separable())
      g += common(zone, f) * zone.unit;
    else
      g += sum(zone, amplitudes(zone, f));
  return g;
}

std::vector<double> CrossSpectrum::breaks() const {
  std::vector<double> out;
  for (const Zone& zone : zones_) {
    const std::vector<double> of_zone = zone.spectra.breaks();
    out.insert(out.end(), of_zone.begin(), of_zone.end());
  }
  std::sort(out.begin(), out.end());
  return out;
}

CrossSpectrumTable::CrossSpectrumTable(CrossSpectrum exact, double low, double high)
    : exact_(std::move(exact)), first_(std::log(low)) {
  if (!(low > 0.0) || !(high > low) || !std::isfinite(high))
    throw core::Error(fmt::format(
        "a table of cross-spectra from {:g} Hz to {:g} Hz makes no sense; give ends with 0 < low < high", low,
        high));
  const auto intervals = static_cast<Eigen::Index>(std::ceil(values_per_octave * std::log2(high / low)));
  step_ = (std::log(high) - first_) / static_cast<double>(intervals);
  for (const CrossSpectrum::Zone& zone : exact_.zones_) {
    std::vector<Eigen::MatrixXd>& ratio = ratio_.emplace_back();
    if (zone.spectra.separable())
      continue;
    for (Eigen::Index i = 0; i <= intervals; ++i) {
      const Eigen::VectorXd a = exact_.amplitudes(zone, std::exp(first_ + step_ * static_cast<double>(i)));
      const double power = a.cwiseAbs2().dot(zone.ds);
      const double per_power = power > 0.0 ? 1.0 / power : 0.0;
      ratio.push_back(per_power * exact_.sum(zone, a));
    }
  }
}

void CrossSpectrumTable::operator()(double f, Eigen::MatrixXd& g) const {
  g.setZero(exact_.modes_, exact_.modes_);
  for (std::size_t z = 0; z < ratio_.size(); ++z) {
    const CrossSpectrum::Zone& zone = exact_.zones_[z];
    if (ratio_[z].empty()) {
      g += exact_.common(zone, f) * zone.unit;
      continue;
    }
    const double power = exact_.amplitudes(zone, f).cwiseAbs2().dot(zone.ds);
    const double end = static_cast<double>(ratio_[z].size() - 1);
    const double place = f > 0.0 ? std::clamp((std::log(f) - first_) / step_, 0.0, end) : 0.0;
    const auto i = static_cast<std::size_t>(std::min(place, end - 1.0));
    const double share = place - static_cast<double>(i);
    g += power * ((1.0 - share) * ratio_[z][i] + share * ratio_[z][i + 1]);
  }
}

} // namespace fretwork::flow
