// SPDX-License-Identifier: GPL-3.0-or-later
#include "flow/profile.hpp"
#include "core/error.hpp"
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <iterator>
#include <limits>

namespace fretwork::flow {
namespace {

constexpr double table_slack = 0.005; ///< of the tube's length: how early a table or how late a zone may end
constexpr double along_tube =
    1e-6; ///< of the largest velocity: below it the flow has no direction across the tube
constexpr double same_end = 1e-9; ///< of the tube's length: zones that share an end given in decimals
constexpr double unbounded = std::numeric_limits<double>::infinity();

std::string name_of(const Extent& zone) { return fmt::format("zone \"{}\"", zone.name); }

/// @throws core::Error for tubes that nearly touch
void check_pitch(const Zone& zone, double diameter) {
  try {
    (void)pitch_ratio(zone.bundle, diameter);
  } catch (const core::Error& error) {
    throw core::Error(fmt::format("{}: {}", name_of(zone), error.what()));
  }
}

void require_above_zero(double value, const std::string& what, const char* unit) {
  if (!(value > 0.0) || !std::isfinite(value))
    throw core::Error(fmt::format("{} = {:g} {}; give a number > 0", what, value, unit));
}

template <class Value>
void check_reach(const Table<Value>& table, const Zone& zone, double length, const std::string& what) {
  if (table.is_constant())
    return;
  const double early = table.s.front() - zone.from, late = std::min(zone.to, length) - table.s.back();
  if (std::max(early, late) > table_slack * length)
    throw core::Error(
        fmt::format("{}: its rows go from s = {:g} to {:g} m, the zone from {:g} to {:g} m; give rows up to "
                    "both ends of the zone (0.5 % of the tube's length may be missing)",
                    what, table.s.front(), table.s.back(), zone.from, zone.to));
}

void check_table(const Table<double>& table, double greatest, const Zone& zone, double length,
                 const char* name) {
  const std::string what = name_of(zone) + ": " + name;
  check_values(table, 0.0, greatest, what);
  check_reach(table, zone, length, what);
}

void check_extent(const Extent& zone, double length) {
  const double slack = table_slack * length;
  if (!(zone.to > zone.from))
    throw core::Error(fmt::format("{} goes from s = {:g} to {:g} m; give an end beyond its beginning",
                                  name_of(zone), zone.from, zone.to));
  if (!(zone.from >= -slack && zone.to <= length + slack))
    throw core::Error(
        fmt::format("{} goes from s = {:g} to {:g} m, off the tube, which goes from 0 to {:g} m; give "
                    "abscissae along the tube",
                    name_of(zone), zone.from, zone.to, length));
}

/// @return the largest |U| or V, m/s
double check_velocity(const Zone& zone, double length) {
  if (const auto* vector = std::get_if<VectorVelocity>(&zone.velocity)) {
    check_values(vector->velocity, name_of(zone) + ": velocity");
    check_reach(vector->velocity, zone, length, name_of(zone) + ": velocity");
    double fastest = 0.0;
    for (const Vec3& u : vector->velocity.values)
      fastest = std::max(fastest, u.norm());
    return fastest;
  }
  const auto& scalar = std::get<ScalarVelocity>(zone.velocity);
  check_table(scalar.speed, unbounded, zone, length, "velocity");
  if (scalar.direction && !(scalar.direction->allFinite() && scalar.direction->norm() > 0.0))
    throw core::Error(fmt::format("{}: direction {} is no direction; give a vector across the tube",
                                  name_of(zone), fem::place(*scalar.direction)));
  return *std::max_element(scalar.speed.values.begin(), scalar.speed.values.end());
}

struct CheckFluid {
  const Zone& zone;
  double length;

  void operator()(const SinglePhase& fluid) const {
    if (fluid.phase != Phase::liquid && fluid.phase != Phase::gas)
      throw core::Error(name_of(zone) +
                        ": a single phase is liquid or gas; name one, or give a two-phase fluid");
    check_table(fluid.density, unbounded, zone, length, "density");
    require_above_zero(fluid.viscosity, name_of(zone) + ": viscosity", "m2/s");
  }
  void operator()(const TwoPhase& fluid) const {
    const Phases& p = fluid.phases;
    require_above_zero(p.gas_density, name_of(zone) + ": gas density", "kg/m3");
    require_above_zero(p.liquid_viscosity, name_of(zone) + ": liquid viscosity", "m2/s");
    require_above_zero(p.gas_viscosity, name_of(zone) + ": gas viscosity", "m2/s");
    if (!(p.liquid_density > p.gas_density) || !std::isfinite(p.liquid_density))
      throw core::Error(
          fmt::format("{}: liquid density = {:g} kg/m3 is not above gas density = {:g} kg/m3; give the "
                      "densities of both phases",
                      name_of(zone), p.liquid_density, p.gas_density));
    if (const auto* given = std::get_if<GivenVoidFraction>(&fluid.content))
      return check_table(given->alpha, 1.0, zone, length, "void fraction");
    const auto& quality = std::get<Quality>(fluid.content);
    check_table(quality.x, 1.0, zone, length, "steam quality");
    if (quality.mass_flux)
      check_mass_flux(*quality.mass_flux, p);
  }
  void check_mass_flux(const Table<double>& mass_flux, const Phases& phases) const {
    check_table(mass_flux, unbounded, zone, length, "mass flux");
    for (const double g : mass_flux.values)
      require_above_zero(g, name_of(zone) + ": mass flux", "kg/m2/s");
    require_above_zero(phases.surface_tension,
                       name_of(zone) + ": surface tension (of Feenstra's void fraction)", "N/m");
    require_above_zero(phases.gravity, name_of(zone) + ": gravity", "m/s2");
    if (is_single(zone.bundle))
      throw core::Error(name_of(zone) +
                        ": Feenstra's void fraction needs a bundle; give arrangement and pitch, or leave "
                        "out the mass flux for the homogeneous void fraction");
  }
};

/// @param extents  of all zones, with and without fluid
void check_overlaps(std::vector<Extent> extents, double length) {
  std::sort(extents.begin(), extents.end(), [](const Extent& a, const Extent& b) { return a.from < b.from; });
  for (std::size_t k = 1; k < extents.size(); ++k)
    if (extents[k - 1].to > extents[k].from + same_end * length)
      throw core::Error(
          fmt::format("{} ends at s = {:g} m, after {} has begun at {:g} m; end it there or before",
                      name_of(extents[k - 1]), extents[k - 1].to, name_of(extents[k]), extents[k].from));
}

void set_fluid(FlowPoint& out, const SinglePhase& fluid, const TubePoint& point) {
  out.phase = fluid.phase;
  out.density = fluid.density.at(point.s);
  out.viscosity = fluid.viscosity;
  out.liquid_density = fluid.phase == Phase::liquid ? out.density : 0.0;
}

void set_fluid(FlowPoint& out, const TwoPhase& fluid, const TubePoint& point, const Bundle& bundle) {
  out.phase = Phase::two_phase;
  if (const auto* given = std::get_if<GivenVoidFraction>(&fluid.content)) {
    out.void_fraction = out.homogeneous_void_fraction = given->alpha.at(point.s);
  } else {
    const auto& quality = std::get<Quality>(fluid.content);
    const double x = quality.x.at(point.s);
    out.void_fraction = out.homogeneous_void_fraction =
        homogeneous_void_fraction(x, fluid.phases.liquid_density, fluid.phases.gas_density);
    if (quality.mass_flux)
      out.void_fraction =
          feenstra_void_fraction(x, fluid.phases,
                                 {quality.mass_flux->at(point.s), point.outer_diameter, bundle.pitch})
              .alpha;
  }
  out.density = mixture_density(out.void_fraction, fluid.phases);
  out.viscosity = mixture_viscosity(out.void_fraction, fluid.phases);
  out.liquid_density = fluid.phases.liquid_density;
}

Vec3 across(const Vec3& vector, const Vec3& tangent) { return vector - vector.dot(tangent) * tangent; }

void set_axes(FlowPoint& out, const Vec3& drag, const Vec3& tangent) {
  out.drag = drag.normalized();
  out.lift = tangent.cross(out.drag);
}

/// Of all tables of a zone.
std::vector<const std::vector<double>*> rows_of(const Zone& zone) {
  std::vector<const std::vector<double>*> rows{&zone.inner_density.s};
  if (const auto* vector = std::get_if<VectorVelocity>(&zone.velocity))
    rows.push_back(&vector->velocity.s);
  else
    rows.push_back(&std::get<ScalarVelocity>(zone.velocity).speed.s);
  if (const auto* single = std::get_if<SinglePhase>(&zone.fluid)) {
    rows.push_back(&single->density.s);
    return rows;
  }
  const auto& content = std::get<TwoPhase>(zone.fluid).content;
  if (const auto* given = std::get_if<GivenVoidFraction>(&content)) {
    rows.push_back(&given->alpha.s);
    return rows;
  }
  const auto& quality = std::get<Quality>(content);
  rows.push_back(&quality.x.s);
  if (quality.mass_flux)
    rows.push_back(&quality.mass_flux->s);
  return rows;
}

/// @param least  m/s: below it the flow has no direction across the tube
void set_velocity(FlowPoint& out, const Zone& zone, const TubePoint& point, double least) {
  if (const auto* vector = std::get_if<VectorVelocity>(&zone.velocity)) {
    const Vec3 normal = across(vector->velocity.at(point.s), point.tangent);
    const double speed = normal.norm();
    if (speed <= least)
      return;
    out.velocity = speed;
    return set_axes(out, normal, point.tangent);
  }
  const auto& scalar = std::get<ScalarVelocity>(zone.velocity);
  const double speed = scalar.speed.at(point.s);
  if (speed <= least)
    return;
  out.velocity = speed;
  if (!scalar.direction)
    return;
  const Vec3 drag = across(*scalar.direction, point.tangent);
  if (drag.norm() < along_tube * scalar.direction->norm())
    throw core::Error(
        fmt::format("{}: direction {} is along the tube at s = {:g} m; give a direction across it, or the "
                    "velocity as vectors",
                    name_of(zone), fem::place(*scalar.direction), point.s));
  set_axes(out, drag, point.tangent);
}

} // namespace

Profile::Profile(std::vector<Zone> zones, double length, std::vector<Extent> dry)
    : zones_(std::move(zones)), dry_(std::move(dry)) {
  std::vector<Extent> extents = dry_;
  extents.insert(extents.end(), zones_.begin(), zones_.end());
  for (const Extent& extent : extents)
    check_extent(extent, length);
  for (const Zone& zone : zones_) {
    fastest_ = std::max(fastest_, check_velocity(zone, length));
    std::visit(CheckFluid{zone, length}, zone.fluid);
    check_table(zone.inner_density, unbounded, zone, length, "inner density");
    for (const double k : zone.connors_constants)
      require_above_zero(k, name_of(zone) + ": Connors constant", "");
  }
  check_overlaps(std::move(extents), length);
}

int Profile::zone_at(double s) const {
  int found = -1;
  for (std::size_t k = 0; k < zones_.size(); ++k)
    if (s >= zones_[k].from && s <= zones_[k].to &&
        (found < 0 || zones_[k].from > zones_[static_cast<std::size_t>(found)].from))
      found = static_cast<int>(k);
  return found;
}

FlowPoint Profile::at(const TubePoint& point) const {
  FlowPoint out;
  out.zone = zone_at(point.s);
  if (out.zone < 0)
    return out;
  const Zone& zone = zones_[static_cast<std::size_t>(out.zone)];
  if (!is_single(zone.bundle))
    check_pitch(zone, point.outer_diameter);
  out.inner_density = zone.inner_density.at(point.s);
  if (const auto* fluid = std::get_if<SinglePhase>(&zone.fluid))
    set_fluid(out, *fluid, point);
  else
    set_fluid(out, std::get<TwoPhase>(zone.fluid), point, zone.bundle);
  set_velocity(out, zone, point, along_tube * fastest_);
  return out;
}

std::vector<double> Profile::breaks() const {
  std::vector<double> out;
  for (const Zone& zone : zones_) {
    out.insert(out.end(), {zone.from, zone.to});
    for (const std::vector<double>* rows : rows_of(zone))
      std::copy_if(rows->begin(), rows->end(), std::back_inserter(out),
                   [&zone](double s) { return s > zone.from && s < zone.to; });
  }
  std::sort(out.begin(), out.end());
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

} // namespace fretwork::flow
