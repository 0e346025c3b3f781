// SPDX-License-Identifier: GPL-3.0-or-later
#include "flow/load_band.hpp"
#include "core/error.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace fretwork::flow {
namespace {

constexpr double scanned_from = 1e-3, scanned_to = 1e5; ///< Hz
/// Of the sums in ln f: spectra are smooth but for corners, at which a step errs by some 1e-3 of what it holds.
constexpr double points_per_octave = 12.0;
constexpr double fewest_block_lines = 1024.0;
constexpr double blocks_held = 2.0;

double weight_of(const TurbulentZone& zone) {
  double sum = 0.0;
  for (const LoadAxis& axis : zone.axes)
    sum += axis.weight;
  return sum;
}

/// Points of equal distance in ln f, both ends included.
std::vector<double> frequencies(double low, double high) {
  const int steps = std::max(1, static_cast<int>(std::ceil(points_per_octave * std::log2(high / low))));
  std::vector<double> out;
  for (int k = 0; k <= steps; ++k)
    out.push_back(low * std::pow(high / low, static_cast<double>(k) / steps));
  return out;
}

/// int P df from the first frequency to each.
std::vector<double> cumulated(const std::vector<TurbulentZone>& zones, const std::vector<double>& f) {
  std::vector<double> density(f.size(), 0.0), out(f.size(), 0.0);
  for (const TurbulentZone& zone : zones) {
    const ZoneSpectra spectra(zone);
    const double weight = weight_of(zone);
    for (std::size_t j = 0; j < f.size(); ++j)
      for (Eigen::Index k = 0; k < zone.patches(); ++k) {
        const double amplitude = spectra.amplitude(k, f[j]);
        density[j] += weight * amplitude * amplitude * zone.ds(k);
      }
  }
  for (std::size_t j = 1; j < f.size(); ++j)
    out[j] = out[j - 1] + 0.5 * std::log(f[j] / f[j - 1]) * (f[j] * density[j] + f[j - 1] * density[j - 1]);
  return out;
}

double at(const std::vector<double>& f, const std::vector<double>& sums, double where) {
  const auto next = static_cast<std::size_t>(std::upper_bound(f.begin(), f.end(), where) - f.begin());
  if (next == 0)
    return 0.0;
  if (next == f.size())
    return sums.back();
  const double share = std::log(where / f[next - 1]) / std::log(f[next] / f[next - 1]);
  return sums[next - 1] + share * (sums[next] - sums[next - 1]);
}

double period_of(double high) { return std::exp2(std::ceil(std::log2(fewest_block_lines / high))); }

std::vector<double> checked_sums(const std::vector<TurbulentZone>& zones, const std::vector<double>& f) {
  check(zones);
  std::vector<double> sums = cumulated(zones, f);
  if (!(sums.back() > 0.0))
    throw core::Error(
        fmt::format("the flow exerts no random force between {:g} and {:g} Hz; give lift, drag or the "
                    "spectrum values above 0",
                    scanned_from, scanned_to));
  return sums;
}

} // namespace

LoadBand load_band(const std::vector<TurbulentZone>& zones) {
  const std::vector<double> f = frequencies(scanned_from, scanned_to), sums = checked_sums(zones, f);
  std::size_t k = 1; // the interval with the upper end of the band
  while (sums.back() - sums[k] > lost_above_band * sums.back())
    ++k;
  const double wanted = (1.0 - lost_above_band) * sums.back();
  const double share = (wanted - sums[k - 1]) / (sums[k] - sums[k - 1]);
  const double high = f[k - 1] * std::pow(f[k] / f[k - 1], share);
  return {0.0, high, 0.0, lost_above_band, period_of(high)};
}

LoadBand load_band(const std::vector<TurbulentZone>& zones, double low, double high) {
  if (!(low >= 0.0) || !(high > low) || !std::isfinite(high))
    throw core::Error(
        fmt::format("a band from {:g} Hz to {:g} Hz makes no sense; give 0 <= low < high", low, high));
  const std::vector<double> f = frequencies(scanned_from, scanned_to), sums = checked_sums(zones, f);
  const double all = sums.back();
  return {low, high, at(f, sums, low) / all, 1.0 - at(f, sums, high) / all, period_of(high)};
}

Eigen::VectorXd modal_mean_squares(const std::vector<TurbulentZone>& zones, const LoadBand& band) {
  const std::vector<double> f = frequencies(std::max(band.low, 1.0 / band.block_period), band.high);
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(zones.front().modes());
  for (const TurbulentZone& zone : zones) {
    const ZoneSpectra spectra(zone);
    std::vector<Eigen::MatrixXd> shapes;
    for (const LoadAxis& axis : zone.axes)
      shapes.push_back(std::sqrt(axis.weight) * axis.shapes * zone.ds.asDiagonal());
    Eigen::VectorXd density, before = Eigen::VectorXd::Zero(sum.size());
    for (std::size_t j = 0; j < f.size(); ++j) {
      density = Eigen::VectorXd::Zero(sum.size());
      for (const Eigen::MatrixXd& phi : shapes) {
        Eigen::ArrayXd running = Eigen::ArrayXd::Zero(sum.size()), a; // sum of a_kl r of all patches up to k
        for (Eigen::Index k = 0; k < zone.patches(); ++k) {
          const double r = k > 0 ? std::exp(-(zone.s(k) - zone.s(k - 1)) / zone.correlation_length) : 0.0;
          a = spectra.amplitude(k, f[j]) * phi.col(k).array();
          running = r * running + a;
          density.array() += a * (2.0 * running - a);
        }
      }
      if (j > 0)
        sum += 0.5 * std::log(f[j] / f[j - 1]) * (f[j] * density + f[j - 1] * before);
      before = density;
    }
  }
  return sum;
}

double draw_bytes(const std::vector<TurbulentZone>& zones, const LoadBand& band) {
  const double lines = band.high * band.block_period, samples = DrawOptions{}.samples_per_period * lines;
  double numbers = blocks_held * samples * static_cast<double>(zones.front().modes());
  for (const TurbulentZone& zone : zones)
    numbers += lines * static_cast<double>(zone.patches());
  return numbers * static_cast<double>(sizeof(double));
}

} // namespace fretwork::flow
