// SPDX-License-Identifier: GPL-3.0-or-later
#include "flow/sampling.hpp"
#include "core/error.hpp"
#include "fem/gauss.hpp"
#include <algorithm>
#include <fmt/format.h>
#include <numbers>

namespace fretwork::flow {
namespace {

constexpr double no_interval = 1e-12; ///< of the tube's length: a shorter interval is none

Station station_at(const Tube& tube, const Profile& profile, const modal::Basis& basis, double s,
                   double weight) {
  Station out{weight, tube.at(s), {}, tube.shapes(basis, s).leftCols(basis.true_modes())};
  out.flow = profile.at(out.tube);
  const Vec3 t = out.tube.tangent;
  out.shapes -= (t * (t.transpose() * out.shapes)).eval();
  return out;
}

/// Ascending, those closer than `least` once.
void keep_apart(std::vector<double>& ends, double least) {
  std::sort(ends.begin(), ends.end());
  ends.erase(std::unique(ends.begin(), ends.end(), [least](double a, double b) { return b - a <= least; }),
             ends.end());
}

/// Abscissae between which everything is smooth, from 0 to the tube's length.
std::vector<double> intervals(const Tube& tube, const Profile& profile) {
  std::vector<double> ends{0.0};
  for (const Tube::Element& element : tube.elements())
    ends.push_back(element.to);
  for (const double s : profile.breaks())
    if (s > 0.0 && s < tube.length())
      ends.push_back(s);
  keep_apart(ends, no_interval * tube.length());
  return ends;
}

/// @param ends  of intervals, m
Sampling sampled(const TubeToSample& of, const Eigen::VectorXd& modal_mass, const std::vector<double>& ends) {
  const Eigen::Index modes = of.basis.true_modes();
  Sampling out{
      of.basis.omega.head(modes) / (2.0 * std::numbers::pi), modal_mass, {}, of.profile.zones().size()};
  out.stations.reserve((ends.size() - 1) * fem::gauss_points.size());
  for (std::size_t k = 1; k < ends.size(); ++k)
    for (const auto& [share, weight] : fem::gauss_points) {
      const double width = ends[k] - ends[k - 1];
      out.stations.push_back(
          station_at(of.tube, of.profile, of.basis, ends[k - 1] + share * width, weight * width));
    }
  return out;
}

void check_modal_mass(const Eigen::VectorXd& modal_mass, Eigen::Index modes) {
  if (modal_mass.size() != modes)
    throw core::Error(
        fmt::format("{} modal masses for {} modes; give one for each mode", modal_mass.size(), modes));
  for (Eigen::Index i = 0; i < modes; ++i)
    if (!(modal_mass(i) > 0.0))
      throw core::Error(fmt::format("mode {}: modal mass = {:g}; give a number > 0", i + 1, modal_mass(i)));
}

} // namespace

Sampling sample(const Tube& tube, const Profile& profile, const modal::Basis& basis) {
  return sample(tube, profile, basis, Eigen::VectorXd::Ones(basis.true_modes()));
}

Sampling sample(const Tube& tube, const Profile& profile, const modal::Basis& basis,
                const Eigen::VectorXd& modal_mass) {
  check_modal_mass(modal_mass, basis.true_modes());
  return sampled({tube, profile, basis}, modal_mass, intervals(tube, profile));
}

std::vector<Sampling> sample_beside(std::span<const TubeToSample> tubes) {
  const double length = tubes.front().tube.length();
  std::vector<double> ends;
  for (const TubeToSample& one : tubes)
    for (const double end : intervals(one.tube, one.profile))
      ends.push_back(end * (length / one.tube.length()));
  keep_apart(ends, no_interval * length);
  std::vector<Sampling> out;
  for (const TubeToSample& one : tubes) {
    std::vector<double> own = ends;
    for (double& end : own)
      end *= one.tube.length() / length;
    out.push_back(sampled(one, Eigen::VectorXd::Ones(one.basis.true_modes()), own));
  }
  return out;
}

Eigen::VectorXd transverse_share(const Sampling& sampling) {
  Eigen::VectorXd share = Eigen::VectorXd::Zero(sampling.modes());
  for (const Station& station : sampling.stations)
    share += station.weight * station.tube.mass * station.shapes.colwise().squaredNorm().transpose();
  return share.cwiseQuotient(sampling.modal_mass);
}

} // namespace fretwork::flow
