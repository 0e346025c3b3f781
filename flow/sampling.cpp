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

/// Abscissae between which everything is smooth, from 0 to the tube's length.
std::vector<double> intervals(const Tube& tube, const Profile& profile) {
  std::vector<double> ends{0.0};
  for (const Tube::Element& element : tube.elements())
    ends.push_back(element.to);
  for (const double s : profile.breaks())
    if (s > 0.0 && s < tube.length())
      ends.push_back(s);
  std::sort(ends.begin(), ends.end());
  const double least = no_interval * tube.length();
  ends.erase(std::unique(ends.begin(), ends.end(), [least](double a, double b) { return b - a <= least; }),
             ends.end());
  return ends;
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
  Sampling out{basis.omega.head(basis.true_modes()) / (2.0 * std::numbers::pi),
               modal_mass,
               {},
               profile.zones().size()};
  const std::vector<double> ends = intervals(tube, profile);
  out.stations.reserve((ends.size() - 1) * fem::gauss_points.size());
  for (std::size_t k = 1; k < ends.size(); ++k)
    for (const auto& [share, weight] : fem::gauss_points) {
      const double width = ends[k] - ends[k - 1];
      out.stations.push_back(station_at(tube, profile, basis, ends[k - 1] + share * width, weight * width));
    }
  return out;
}

std::vector<Station> stations_at(const Tube& tube, const Profile& profile, const modal::Basis& basis,
                                 std::span<const double> abscissae) {
  std::vector<Station> out;
  out.reserve(abscissae.size());
  for (const double s : abscissae)
    out.push_back(station_at(tube, profile, basis, s, 0.0));
  return out;
}

Eigen::VectorXd transverse_share(const Sampling& sampling) {
  Eigen::VectorXd share = Eigen::VectorXd::Zero(sampling.modes());
  for (const Station& station : sampling.stations)
    share += station.weight * station.tube.mass * station.shapes.colwise().squaredNorm().transpose();
  return share.cwiseQuotient(sampling.modal_mass);
}

} // namespace fretwork::flow
