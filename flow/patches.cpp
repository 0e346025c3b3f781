// SPDX-License-Identifier: GPL-3.0-or-later
#include "flow/patches.hpp"
#include "core/error.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <set>

namespace fretwork::flow {
namespace {

constexpr double patches_per_correlation_length = 5.0; ///< a modal force spectrum is at most 0.7 % too large
constexpr double same_width = 1e-9;                    ///< of widths
constexpr double negligible_share = 1e-6;              ///< of the largest velocity
constexpr std::uint32_t most_zones = std::uint32_t{1} << 24;
constexpr std::size_t most_axes = 256;

void check_array(const TurbulentZone& zone, const Eigen::VectorXd& values, std::string_view what,
                 double least, bool excluded) {
  if (values.size() != zone.patches())
    throw core::Error(fmt::format("zone '{}': {} has {} values for {} patches; give one for each patch",
                                  zone.name, what, values.size(), zone.patches()));
  for (Eigen::Index k = 0; k < values.size(); ++k)
    if (!std::isfinite(values[k]) || values[k] < least || (excluded && values[k] == least))
      throw core::Error(
          fmt::format("zone '{}': {} = {:g} at s = {:g} m makes no sense; give a number {} {:g}", zone.name,
                      what, values[k], zone.s[k], excluded ? ">" : ">=", least));
}

void check_widths(const TurbulentZone& zone) {
  for (Eigen::Index k = 1; k < zone.patches(); ++k) {
    const double distance = zone.s[k] - zone.s[k - 1], width = 0.5 * (zone.ds[k] + zone.ds[k - 1]);
    if (!(distance >= width * (1.0 - same_width)))
      throw core::Error(
          fmt::format("zone '{}': the patches at s = {:g} m and {:g} m overlap; give midpoints in "
                      "ascending order and widths that fit between them",
                      zone.name, zone.s[k - 1], zone.s[k]));
  }
  const double widest = zone.ds.maxCoeff(), most = zone.correlation_length / patches_per_correlation_length;
  if (widest > most * (1.0 + same_width))
    throw core::Error(
        fmt::format("zone '{}': a patch is {:g} m wide, more than a fifth of the correlation length "
                    "{:g} m; cut the zone into patches of {:g} m at most",
                    zone.name, widest, zone.correlation_length, most));
}

void check_axes(const TurbulentZone& zone) {
  if (zone.axes.empty() || zone.axes.size() > most_axes)
    throw core::Error(
        fmt::format("zone '{}' has {} axes of load; give 1 to {}", zone.name, zone.axes.size(), most_axes));
  for (const LoadAxis& axis : zone.axes) {
    if (axis.shapes.cols() != zone.patches() || axis.shapes.rows() != zone.modes() || zone.modes() == 0)
      throw core::Error(
          fmt::format("zone '{}': mode shapes of an axis have {} modes and {} patches, expected {} and {}; "
                      "give the same modes for each axis and a value for each patch",
                      zone.name, axis.shapes.rows(), axis.shapes.cols(),
                      std::max<Eigen::Index>(1, zone.modes()), zone.patches()));
    if (!axis.shapes.allFinite())
      throw core::Error(fmt::format("zone '{}': mode shapes contain values that are no numbers", zone.name));
    if (!(axis.weight >= 0.0) || !std::isfinite(axis.weight))
      throw core::Error(fmt::format("zone '{}': weight = {:g} of an axis makes no sense; give a number >= 0",
                                    zone.name, axis.weight));
  }
}

double mean(const Eigen::VectorXd& values, const Eigen::VectorXd& ds) { return values.dot(ds) / ds.sum(); }

/// Does the level of the spectrum follow from rho V^2?
bool by_dynamic_pressure(const Spectrum& spectrum) {
  const auto* table = std::get_if<TableSpectrum>(&spectrum);
  return !(table && table->absolute) && !std::holds_alternative<TwoPhaseSpectrum>(spectrum);
}

bool is_absolute(const Spectrum& spectrum) {
  const auto* table = std::get_if<TableSpectrum>(&spectrum);
  return table && table->absolute;
}

std::string where(const TurbulentZone& zone) { return fmt::format("zone '{}'", zone.name); }

} // namespace

void check(const TurbulentZone& zone) {
  if (zone.patches() == 0)
    throw core::Error(fmt::format("zone '{}' has no patches; cut it into some", zone.name));
  if (zone.id >= most_zones)
    throw core::Error(fmt::format("zone '{}': its number {} is too large; give one below {}", zone.name,
                                  zone.id, most_zones));
  check_array(zone, zone.s, "position of a patch", -std::numeric_limits<double>::max(), false);
  check_array(zone, zone.ds, "width of a patch, m,", 0.0, true);
  check_array(zone, zone.velocity, "velocity, m/s,", 0.0, false);
  check_array(zone, zone.density, "density, kg/m3,", 0.0, true);
  check_array(zone, zone.void_fraction, "void fraction", 0.0, false);
  check_array(zone, zone.viscosity, "kinematic viscosity, m2/s,", 0.0, false);
  check_array(zone, zone.diameter, "diameter, m,", 0.0, true);
  if (!(zone.correlation_length > 0.0) || !std::isfinite(zone.correlation_length))
    throw core::Error(fmt::format("zone '{}': correlation length = {:g} m makes no sense; give a number > 0, "
                                  "typically 2 to 4 diameters",
                                  zone.name, zone.correlation_length));
  if (zone.running_velocity && zone.scaling == Scaling::local)
    throw core::Error(
        fmt::format("zone '{}': a running velocity has no meaning with the scaling local; leave it out "
                    "or ask for zone_mean",
                    zone.name));
  check_widths(zone);
  check_axes(zone);
}

void check(const std::vector<TurbulentZone>& zones) {
  std::set<std::uint32_t> ids;
  for (const TurbulentZone& zone : zones) {
    check(zone);
    if (!ids.insert(zone.id).second)
      throw core::Error(
          fmt::format("zone '{}': another zone has the number {} too, their loads would be the same; "
                      "give each zone its own",
                      zone.name, zone.id));
    if (zone.modes() != zones.front().modes())
      throw core::Error(fmt::format("zone '{}' has {} modes, zone '{}' {}; give all the same modes",
                                    zone.name, zone.modes(), zones.front().name, zones.front().modes()));
  }
}

PatchGrid cut_into_patches(double from, double to, double width) {
  if (!(to > from) || !(width > 0.0) || !std::isfinite(to - from))
    throw core::Error(
        fmt::format("a zone from s = {:g} m to {:g} m cannot be cut into patches of {:g} m; give an end "
                    "beyond its start and a width > 0",
                    from, to, width));
  const auto n = static_cast<Eigen::Index>(std::ceil((to - from) / width * (1.0 - same_width)));
  const double ds = (to - from) / static_cast<double>(n);
  const Eigen::ArrayXd number = Eigen::ArrayXd::LinSpaced(n, 0.0, static_cast<double>(n - 1));
  return {from + ds * (number + 0.5), Eigen::VectorXd::Constant(n, ds)};
}

void ZoneSpectra::add(PointSpectrum spectrum) {
  lowest_ = std::max(lowest_, spectrum.lowest());
  highest_ = std::min(highest_, spectrum.highest());
  spectra_.push_back(std::move(spectrum));
}

ZoneSpectra::ZoneSpectra(const TurbulentZone& zone) {
  check(zone);
  const double fastest = zone.velocity.maxCoeff();
  factor_ = Eigen::VectorXd::Ones(zone.patches());
  if (!is_absolute(zone.spectrum))
    for (Eigen::Index k = 0; k < zone.patches(); ++k)
      if (!(zone.velocity[k] > negligible_share * fastest))
        factor_[k] = 0.0;
  const double mean_density = mean(zone.density, zone.ds);
  if (idle() == zone.patches())
    throw core::Error(fmt::format(
        "zone '{}': the velocity is 0 all along; give its profile or leave the zone out", zone.name));
  if (zone.scaling == Scaling::zone_mean)
    set_zone_mean(zone, mean_density);
  else
    set_local(zone, mean_density);
}

void ZoneSpectra::set_local(const TurbulentZone& zone, double mean_density) {
  const auto constant = [](const Eigen::VectorXd& values) { return (values.array() == values[0]).all(); };
  common_ = constant(zone.velocity) && constant(zone.density) && constant(zone.void_fraction) &&
            constant(zone.viscosity) && constant(zone.diameter);
  common_ = common_ || is_absolute(zone.spectrum);
  Eigen::Index flows = 0; // a patch with flow stands in for those without, whose factor is 0
  zone.velocity.maxCoeff(&flows);
  for (Eigen::Index k = 0; k < (common_ ? 1 : zone.patches()); ++k) {
    const Eigen::Index from = factor_[k] > 0.0 ? k : flows;
    add(PointSpectrum(zone.spectrum,
                      {zone.velocity[from], zone.density[from], zone.void_fraction[from],
                       zone.viscosity[from], zone.diameter[from], mean_density},
                      zone.correlation_length, zone.two_sided, where(zone)));
  }
}

void ZoneSpectra::set_zone_mean(const TurbulentZone& zone, double mean_density) {
  common_ = true;
  const double u = mean(zone.velocity, zone.ds);
  add(PointSpectrum(zone.spectrum,
                    {zone.running_velocity.value_or(u), mean_density, mean(zone.void_fraction, zone.ds),
                     mean(zone.viscosity, zone.ds), mean(zone.diameter, zone.ds), mean_density},
                    zone.correlation_length, zone.two_sided, where(zone)));
  if (by_dynamic_pressure(zone.spectrum))
    factor_.array() *= zone.density.array() / mean_density * (zone.velocity.array() / u).square();
}

std::vector<double> ZoneSpectra::breaks() const {
  std::vector<double> out = common_ ? spectra_.front().breaks() : std::vector<double>{};
  std::sort(out.begin(), out.end());
  return out;
}

} // namespace fretwork::flow
