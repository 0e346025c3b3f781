// SPDX-License-Identifier: GPL-3.0-or-later
#include "flow/stability.hpp"
#include "core/error.hpp"
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <numbers>

namespace fretwork::flow {
namespace {

/// Integrals over the tube, by modes (rows).
struct Integrals {
  Eigen::MatrixXd energy;           ///< E_iz, columns by zones
  Eigen::VectorXd density;          ///< int rho |phi_n|^2 ds
  std::vector<double> fastest;      ///< m/s, largest V of each zone
  std::vector<double> bundle_width; ///< m, D at the first station of each zone
};

/// Square of the component of each shape that counts.
Eigen::RowVectorXd squares(const Station& station, const Component& component) {
  switch (component.kind) {
  case Component::Kind::normal:
    return station.shapes.colwise().squaredNorm();
  case Component::Kind::drag:
    return (station.flow.drag.transpose() * station.shapes).cwiseAbs2();
  case Component::Kind::lift:
    return (station.flow.lift.transpose() * station.shapes).cwiseAbs2();
  case Component::Kind::axis:
    break;
  }
  return (component.axis.normalized().transpose() * station.shapes).cwiseAbs2();
}

Integrals integrate(const Sampling& sampling, const Component& component) {
  const auto zones = static_cast<Eigen::Index>(sampling.zones);
  Integrals out{Eigen::MatrixXd::Zero(sampling.modes(), zones), Eigen::VectorXd::Zero(sampling.modes()),
                std::vector<double>(sampling.zones, 0.0), std::vector<double>(sampling.zones, 0.0)};
  for (const Station& station : sampling.stations) {
    if (station.flow.zone < 0)
      continue;
    const auto zone = static_cast<std::size_t>(station.flow.zone);
    const double v = station.flow.velocity;
    const Eigen::VectorXd moved =
        station.weight * station.flow.density * squares(station, component).transpose();
    out.energy.col(station.flow.zone) += v * v * moved;
    out.density += moved;
    out.fastest[zone] = std::max(out.fastest[zone], v);
    if (out.bundle_width[zone] == 0.0)
      out.bundle_width[zone] = station.tube.outer_diameter;
  }
  return out;
}

void check_component(const Profile& profile, const Component& component) {
  if (component.kind == Component::Kind::axis && !(component.axis.allFinite() && component.axis.norm() > 0.0))
    throw core::Error(fmt::format("component of stability: axis {} is no direction; give a vector",
                                  fem::place(component.axis)));
  if (component.kind != Component::Kind::drag && component.kind != Component::Kind::lift)
    return;
  for (const Zone& zone : profile.zones()) {
    const auto* scalar = std::get_if<ScalarVelocity>(&zone.velocity);
    if (scalar && !scalar->direction)
      throw core::Error(
          fmt::format("zone \"{}\": drag and lift need the direction of its velocity; give direction, or "
                      "take the normal component",
                      zone.name));
  }
}

/// K of each zone to combine; one 0 for a zone without velocity.
std::vector<std::vector<double>> constants_of(const Profile& profile, const Integrals& integrals) {
  std::vector<std::vector<double>> out;
  for (std::size_t z = 0; z < profile.zones().size(); ++z) {
    const Zone& zone = profile.zones()[z];
    if (integrals.fastest[z] == 0.0) {
      out.push_back({0.0});
      continue;
    }
    if (!zone.connors_constants.empty()) {
      out.push_back(zone.connors_constants);
      continue;
    }
    const auto* single = std::get_if<SinglePhase>(&zone.fluid);
    const bool gas = single && single->phase == Phase::gas;
    if (gas || is_single(zone.bundle))
      throw core::Error(
          fmt::format("zone \"{}\": no Connors constant, and the default is not for {}; give its "
                      "connors_constant (K)",
                      zone.name, gas ? "gas" : "a single tube"));
    out.push_back({default_connors_constant(zone.bundle, integrals.bundle_width[z])});
  }
  return out;
}

/// All combinations, the last list fastest.
std::vector<std::vector<double>> combinations(const std::vector<std::vector<double>>& lists) {
  std::vector<std::vector<double>> out{{}};
  for (const std::vector<double>& list : lists) {
    if (out.size() * list.size() > most_stability_cases)
      throw core::Error(fmt::format(
          "more than {} combinations of Connors constants; give fewer K to the zones", most_stability_cases));
    std::vector<std::vector<double>> longer;
    for (const std::vector<double>& begun : out)
      for (const double k : list) {
        longer.push_back(begun);
        longer.back().push_back(k);
      }
    out = std::move(longer);
  }
  return out;
}

ModeInFlow mode_in_flow(const Sampling& sampling, const Integrals& integrals, Eigen::Index i, double xi,
                        bool assessed) {
  ModeInFlow out;
  out.frequency = sampling.frequency(i);
  out.damping = xi;
  const Eigen::VectorXd energy =
      assessed ? Eigen::VectorXd(integrals.energy.row(i)) : Eigen::VectorXd::Zero(integrals.energy.cols());
  out.energies.assign(energy.data(), energy.data() + energy.size());
  const double total = energy.sum();
  if (total == 0.0)
    return out;
  out.effective_velocity = std::sqrt(total / integrals.density(i));
  if (out.frequency == 0.0)
    return out;
  if (!(xi > 0.0 && xi < 1.0))
    throw core::Error(
        fmt::format("mode {} at {:g} Hz: damping ratio = {:g}; stability needs a ratio above 0 and below 1",
                    i + 1, out.frequency, xi));
  out.decrement = 2.0 * std::numbers::pi * xi / std::sqrt(1.0 - xi * xi);
  return out;
}

StabilityCase stability_case(const Sampling& sampling, const std::vector<ModeInFlow>& modes,
                             std::vector<double> constants) {
  const auto n = static_cast<Eigen::Index>(modes.size());
  StabilityCase out{std::move(constants), Eigen::VectorXd::Zero(n), Eigen::VectorXd::Zero(n)};
  for (Eigen::Index i = 0; i < n; ++i) {
    const ModeInFlow& mode = modes[static_cast<std::size_t>(i)];
    double sum = 0.0;
    for (std::size_t z = 0; z < mode.energies.size(); ++z)
      if (mode.energies[z] > 0.0)
        sum += mode.energies[z] / (out.constants[z] * out.constants[z]);
    if (sum > 0.0) {
      out.ratio(i) =
          std::sqrt(sum / (mode.frequency * mode.frequency * mode.decrement * sampling.modal_mass(i)));
      out.critical_velocity(i) = mode.effective_velocity / out.ratio(i);
      if (out.critical_mode < 0 || out.ratio(i) > out.ratio(out.critical_mode))
        out.critical_mode = i;
    }
  }
  return out;
}

} // namespace

double StabilityCase::critical_scale() const {
  const double largest = critical_mode < 0 ? 0.0 : ratio(critical_mode);
  return largest > 0.0 ? 1.0 / largest : std::numeric_limits<double>::infinity();
}

std::optional<double> StabilityCase::margin() const {
  if (critical_mode < 0)
    return std::nullopt;
  return 1.0 - ratio(critical_mode);
}

Stability stability(const Profile& profile, const Sampling& sampling, const Eigen::VectorXd& damping,
                    const Component& component) {
  if (damping.size() != sampling.modes())
    throw core::Error(fmt::format("{} damping ratios for {} modes; give one for each mode", damping.size(),
                                  sampling.modes()));
  check_component(profile, component);
  const Integrals integrals = integrate(sampling, component);
  const Eigen::VectorXd share = transverse_share(sampling);
  Stability out;
  for (Eigen::Index i = 0; i < sampling.modes(); ++i)
    out.modes.push_back(mode_in_flow(sampling, integrals, i, damping(i), share(i) >= least_transverse_share));
  for (std::vector<double>& constants : combinations(constants_of(profile, integrals)))
    out.cases.push_back(stability_case(sampling, out.modes, std::move(constants)));
  return out;
}

Eigen::MatrixXd velocity_sweep(const StabilityCase& of, std::span<const double> factors) {
  Eigen::MatrixXd out(static_cast<Eigen::Index>(factors.size()), of.ratio.size());
  for (std::size_t k = 0; k < factors.size(); ++k) {
    if (!(factors[k] >= 0.0) || !std::isfinite(factors[k]))
      throw core::Error(
          fmt::format("velocity sweep: factor {} = {:g}; give a number >= 0", k + 1, factors[k]));
    if (factors[k] == 0.0)
      out.row(static_cast<Eigen::Index>(k)).setZero(); // without flow, rigid-body modes too
    else
      out.row(static_cast<Eigen::Index>(k)) = factors[k] * of.ratio.transpose();
  }
  return out;
}

} // namespace fretwork::flow
