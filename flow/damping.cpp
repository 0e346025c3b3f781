// SPDX-License-Identifier: GPL-3.0-or-later
#include "flow/damping.hpp"
#include "core/error.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace fretwork::flow {
namespace {

/// What the terms need at one point of the tube.
struct LocalFluid {
  FlowPoint flow;
  double diameter = 0.0;
  double mass_ratio = 0.0;        ///< rho D^2/m
  double liquid_mass_ratio = 0.0; ///< rho_l D^2/m
  double confinement = 1.0;       ///< B

  [[nodiscard]] bool has_liquid() const {
    return flow.phase == Phase::liquid || flow.phase == Phase::two_phase;
  }
};

LocalFluid local_fluid(const Profile& profile, const TubePoint& point, const FlowPoint& flow) {
  LocalFluid out{flow, point.outer_diameter};
  if (flow.zone < 0)
    return out;
  const double area = point.outer_diameter * point.outer_diameter;
  out.mass_ratio = flow.density * area / point.mass;
  out.liquid_mass_ratio = flow.liquid_density * area / point.mass;
  out.confinement = viscous_confinement(
      confinement_ratio(profile.zones()[static_cast<std::size_t>(flow.zone)].bundle, point.outer_diameter));
  return out;
}

/// A support with its fluid.
struct LocalSupport {
  LocalFluid fluid;
  double factor; ///< c
  bool contact;

  [[nodiscard]] DampingTerms terms(double frequency) const {
    DampingTerms out;
    if (fluid.flow.phase == Phase::gas)
      out.gas = gas_support_damping * factor;
    if (!fluid.has_liquid())
      return out;
    out.squeeze_film = squeeze_film_damping(factor, frequency, fluid.mass_ratio);
    out.friction = liquid_friction_damping * factor;
    return out;
  }
};

DampingTerms share_of(const DampingTerms& terms, double share) {
  return {share * terms.viscous, share * terms.two_phase, share * terms.squeeze_film, share * terms.friction,
          share * terms.gas};
}

void check(std::span<const TubeSupport> supports, const DampingOptions& options) {
  for (const TubeSupport& support : supports)
    if (!(support.length >= 0.0) || !std::isfinite(support.length))
      throw core::Error(
          fmt::format("support at s = {:g} m: length = {:g} m; give its length along the tube, >= 0",
                      support.s, support.length));
  if (!(options.structure >= 0.0 && options.structure < 1.0))
    throw core::Error(fmt::format("structural damping = {:g}; give a ratio to critical from 0 to below 1",
                                  options.structure));
  if (options.layout && !(options.layout->spans >= 1 && options.layout->mean_span > 0.0))
    throw core::Error(
        fmt::format("{} spans of mean length {:g} m; give a number of spans >= 1 and a length > 0",
                    options.layout->spans, options.layout->mean_span));
}

SpanLayout layout_of(std::span<const TubeSupport> supports, double length, const DampingOptions& options) {
  std::vector<double> where;
  for (const TubeSupport& support : supports)
    where.push_back(support.s);
  const SpanLayout found = span_layout(std::move(where), length);
  return options.layout.value_or(found);
}

std::vector<LocalSupport> local_supports(const Tube& tube, const Profile& profile, const SpanLayout& layout,
                                         std::span<const TubeSupport> supports, Limits& limits) {
  std::vector<LocalSupport> out;
  for (std::size_t k = 0; k < supports.size(); ++k) {
    const TubePoint point = tube.at(supports[k].s);
    const FlowPoint flow = profile.at(point);
    if (flow.zone < 0)
      limits.push_back({.kind = LimitKind::support_in_no_fluid, .value = static_cast<double>(k)});
    out.push_back(
        {local_fluid(profile, point, flow), support_factor(layout, supports[k].length), supports[k].contact});
  }
  return out;
}

/// Ranges that the bundles leave, once for each zone.
void note_bundles(const Sampling& sampling, const Profile& profile, Limits& limits) {
  std::vector<bool> seen(sampling.zones, false);
  for (const Station& station : sampling.stations) {
    const int zone = station.flow.zone;
    if (zone < 0 || seen[static_cast<std::size_t>(zone)] || station.flow.phase == Phase::gas)
      continue;
    seen[static_cast<std::size_t>(zone)] = true;
    const Bundle& bundle = profile.zones()[static_cast<std::size_t>(zone)].bundle;
    const double q = confinement_ratio(bundle, station.tube.outer_diameter);
    if (q <= correlated_confinement)
      limits.push_back({LimitKind::confinement, -1, zone, q, correlated_confinement});
  }
}

/// Everything that the terms of one mode are computed from.
struct Scene {
  const Sampling& sampling;
  const std::vector<LocalFluid>& fluids; ///< of the stations
  const std::vector<LocalSupport>& supports;
  const DampingOptions& options;
  bool has_floor;
};

/// Viscous and two-phase damping of mode i by zones; the smallest Stokes number of each zone.
void add_distributed(const Scene& scene, Eigen::Index i, ModeDamping& out, std::vector<double>& stokes) {
  double moving = 0.0;
  const double frequency = scene.sampling.frequency(i);
  for (std::size_t k = 0; k < scene.fluids.size(); ++k) {
    const Station& station = scene.sampling.stations[k];
    const LocalFluid& fluid = scene.fluids[k];
    const double mass = station.weight * station.tube.mass * station.shapes.col(i).squaredNorm();
    moving += mass;
    if (!fluid.has_liquid())
      continue;
    const auto zone = static_cast<std::size_t>(fluid.flow.zone);
    const double number = stokes_number(frequency, fluid.diameter, fluid.flow.viscosity);
    stokes[zone] = std::min(stokes[zone], number);
    out.zones[zone].viscous += mass * viscous_damping(fluid.mass_ratio, number, fluid.confinement);
    if (fluid.flow.phase != Phase::two_phase)
      continue;
    const double alpha = scene.options.void_fraction == DampingVoidFraction::homogeneous
                             ? fluid.flow.homogeneous_void_fraction
                             : fluid.flow.void_fraction;
    out.zones[zone].two_phase += mass * two_phase_damping(fluid.liquid_mass_ratio, alpha, fluid.confinement);
  }
  for (DampingTerms& zone : out.zones)
    zone = share_of(zone, 1.0 / moving);
}

void add_supports(const Scene& scene, double frequency, ModeDamping& out) {
  for (const LocalSupport& support : scene.supports) {
    if (support.fluid.flow.zone < 0)
      continue;
    const DampingTerms terms =
        share_of(support.terms(frequency), 1.0 / static_cast<double>(scene.supports.size()));
    out.zones[static_cast<std::size_t>(support.fluid.flow.zone)] += terms;
    if (support.contact)
      out.contacts += terms;
  }
}

ModeDamping mode_damping(const Scene& scene, Eigen::Index i, Limits& limits) {
  const int mode = static_cast<int>(i);
  ModeDamping out;
  out.zones.resize(scene.sampling.zones);
  std::vector<double> stokes(scene.sampling.zones, std::numeric_limits<double>::infinity());
  add_distributed(scene, i, out, stokes);
  add_supports(scene, scene.sampling.frequency(i), out);
  for (std::size_t zone = 0; zone < out.zones.size(); ++zone) {
    out.sum += out.zones[zone];
    if (stokes[zone] <= least_stokes_number)
      limits.push_back(
          {LimitKind::stokes_number, mode, static_cast<int>(zone), stokes[zone], least_stokes_number});
  }
  const double total = out.sum.total();
  out.stability =
      std::min(std::max(total, scene.has_floor ? least_total_damping : 0.0), greatest_total_damping);
  if (out.stability > total)
    limits.push_back({LimitKind::damping_floor, mode, -1, total, least_total_damping});
  if (out.stability < total)
    limits.push_back({LimitKind::damping_ceiling, mode, -1, total, greatest_total_damping});
  out.transient = scene.options.structure + total - out.contacts.total();
  return out;
}

Eigen::VectorXd collect(const std::vector<ModeDamping>& modes, double ModeDamping::*ratio) {
  Eigen::VectorXd out(static_cast<Eigen::Index>(modes.size()));
  for (std::size_t i = 0; i < modes.size(); ++i)
    out(static_cast<Eigen::Index>(i)) = modes[i].*ratio;
  return out;
}

} // namespace

DampingTerms& DampingTerms::operator+=(const DampingTerms& other) {
  viscous += other.viscous;
  two_phase += other.two_phase;
  squeeze_film += other.squeeze_film;
  friction += other.friction;
  gas += other.gas;
  return *this;
}

Eigen::VectorXd Damping::stability() const { return collect(modes, &ModeDamping::stability); }
Eigen::VectorXd Damping::transient() const { return collect(modes, &ModeDamping::transient); }

Damping damping(const Tube& tube, const Profile& profile, const Sampling& sampling,
                std::span<const TubeSupport> supports, const DampingOptions& options) {
  check(supports, options);
  Damping out;
  out.layout = layout_of(supports, tube.length(), options);
  note_bundles(sampling, profile, out.limits);
  const std::vector<LocalSupport> local = local_supports(tube, profile, out.layout, supports, out.limits);
  std::vector<LocalFluid> fluids;
  bool any_gas = false, any_liquid = false;
  for (const Station& station : sampling.stations) {
    fluids.push_back(local_fluid(profile, station.tube, station.flow));
    any_gas = any_gas || station.flow.phase == Phase::gas;
    any_liquid = any_liquid || fluids.back().has_liquid();
  }
  const Scene scene{sampling, fluids, local, options, any_liquid && !any_gas};
  const Eigen::VectorXd share = transverse_share(sampling);
  for (Eigen::Index i = 0; i < sampling.modes(); ++i) {
    if (sampling.frequency(i) > 0.0 && share(i) >= least_transverse_share) {
      out.modes.push_back(mode_damping(scene, i, out.limits));
      continue;
    }
    ModeDamping none;
    none.assessed = false;
    none.zones.resize(sampling.zones);
    none.transient = options.structure;
    out.modes.push_back(none);
  }
  return out;
}

} // namespace fretwork::flow
