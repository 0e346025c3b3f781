// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/turbulent_loads.hpp"
#include "core/error.hpp"
#include "core/hash.hpp"
#include "core/names.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <numbers>
#include <set>

namespace fretwork::app {
namespace {

/// The widest that spectra are right with (flow/patches.hpp), and the fewest of a zone: of one shorter than its correlation length L/(3 lambda n^2) is
/// what n patches add to a modal force spectrum. None is wider than the beams of the tube, which follow the modes, of a fine mesh than 1/500 of the zone.
constexpr double patches_per_correlation_length = 5.0, fewest_patches = 10.0, fine_mesh = 500.0;
constexpr double most_patches = 20000.0; ///< of a zone: a correlation length that is shorter is a slip
constexpr std::size_t digits_of_id = 6;  ///< hexadecimal: numbers of zones are below 2^24

bool names(const std::vector<std::string>& list, const std::string& name) {
  return std::find(list.begin(), list.end(), name) != list.end();
}

/// Of tube and zone: the random forces of one do not depend on what else a study has.
std::uint32_t id_of(const std::string& flow, const std::string& zone) {
  return static_cast<std::uint32_t>(
      std::stoul(core::sha256(flow + "\n" + zone).substr(0, digits_of_id), nullptr, 16));
}

void check_names(const study::Study& study, const study::Turbulence& entry) {
  std::vector<std::string> flows, zones;
  for (const study::Flow& flow : study.flows) {
    flows.push_back(flow.name);
    if (entry.flows.empty() || names(entry.flows, flow.name))
      for (const flow::Zone& zone : flow.zones)
        if (!names(zones, zone.name))
          zones.push_back(zone.name);
  }
  for (const std::string& name : entry.flows)
    if (!names(flows, name))
      throw core::Error(fmt::format("turbulence \"{}\": flow = \"{}\": no [[flow]] is called so{}",
                                    entry.name, name, core::name_help(name, flows)));
  for (const std::string& name : entry.zones)
    if (!names(zones, name))
      throw core::Error(fmt::format("turbulence \"{}\": zones: no zone of its flows is called \"{}\"{}",
                                    entry.name, name, core::name_help(name, zones)));
}

bool has_velocity(const flow::Zone& zone) {
  struct Any {
    bool operator()(const flow::ScalarVelocity& v) const {
      return std::any_of(v.speed.values.begin(), v.speed.values.end(),
                         [](double value) { return value > 0.0; });
    }
    bool operator()(const flow::VectorVelocity& v) const {
      return std::any_of(v.velocity.values.begin(), v.velocity.values.end(),
                         [](const core::Vec3& value) { return !value.isZero(0.0); });
    }
  };
  return std::visit(Any{}, zone.velocity);
}

/// The entry of every zone, by flows and zones; -1: none.
std::vector<std::vector<int>> owners_of_zones(const study::Study& study) {
  std::vector<std::vector<int>> owner;
  for (const study::Flow& flow : study.flows)
    owner.emplace_back(flow.zones.size(), -1);
  const auto each = [&](bool named, const auto& visit) {
    for (std::size_t e = 0; e < study.turbulence.size(); ++e)
      for (std::size_t f = 0; f < study.flows.size(); ++f)
        if (const study::Turbulence& entry = study.turbulence[e];
            named == !entry.zones.empty() && (entry.flows.empty() || names(entry.flows, study.flows[f].name)))
          for (std::size_t z = 0; z < study.flows[f].zones.size(); ++z)
            visit(static_cast<int>(e), study.flows[f].zones[z], owner[f][z]);
  };
  const auto take = [&](int e, const flow::Zone& zone, int& has) {
    if (has >= 0)
      throw core::Error(fmt::format("turbulence \"{}\" and \"{}\" both act on zone \"{}\", which would "
                                    "double it; name it in one of them",
                                    study.turbulence[static_cast<std::size_t>(has)].name,
                                    study.turbulence[static_cast<std::size_t>(e)].name, zone.name));
    has = e;
  };
  each(true, [&](int e, const flow::Zone& zone, int& has) {
    if (!names(study.turbulence[static_cast<std::size_t>(e)].zones, zone.name))
      return;
    if (!has_velocity(zone))
      throw core::Error(
          fmt::format("turbulence \"{}\": zone \"{}\" has no velocity, so that nothing acts; give it "
                      "one, or leave it out of zones",
                      study.turbulence[static_cast<std::size_t>(e)].name, zone.name));
    take(e, zone, has);
  });
  std::set<const int*> named;
  for (const auto& flow : owner)
    for (const int& has : flow)
      if (has >= 0)
        named.insert(&has);
  each(false, [&](int e, const flow::Zone& zone, int& has) {
    if (!named.contains(&has) && has_velocity(zone))
      take(e, zone, has);
  });
  return owner;
}

flow::PatchGrid patches_of(const study::Turbulence& entry, const flow::Zone& zone, const flow::Tube& tube,
                           double length) {
  const double to = std::min(zone.to, length),
               beam = tube.length() / static_cast<double>(tube.elements().size()),
               width = std::min({entry.correlation_length / patches_per_correlation_length,
                                 (to - zone.from) / fewest_patches,
                                 std::max(beam, (to - zone.from) / fine_mesh)});
  if ((to - zone.from) / width > most_patches)
    throw core::Error(fmt::format("turbulence \"{}\": correlation_length = {:g} m is too short for zone "
                                  "\"{}\" of {:g} m: more than {:g} "
                                  "patches; typically it is 2 to 4 diameters",
                                  entry.name, entry.correlation_length, zone.name, to - zone.from,
                                  most_patches));
  return flow::cut_into_patches(zone.from, to, width);
}

flow::Spectrum spectrum_of(const study::Turbulence& entry, const flow::Zone& zone) {
  if (!std::holds_alternative<flow::TwoPhaseSpectrum>(entry.spectrum))
    return entry.spectrum;
  const auto* mixture = std::get_if<flow::TwoPhase>(&zone.fluid);
  if (!mixture)
    throw core::Error(
        fmt::format("turbulence \"{}\": spectrum = \"two_phase\", and zone \"{}\" has one phase; "
                    "name the two-phase zones, or take another spectrum",
                    entry.name, zone.name));
  return flow::TwoPhaseSpectrum{mixture->phases.liquid_density};
}

/// Of a zone whose velocity is along the tube everywhere.
std::string axial_flow_text(const study::Turbulence& entry, const flow::Zone& zone, const std::string& tube) {
  double speed = 0.0;
  if (const auto* vector = std::get_if<flow::VectorVelocity>(&zone.velocity))
    for (const core::Vec3& value : vector->velocity.values)
      speed = std::max(speed, value.norm());
  return fmt::format(
      "turbulence \"{}\": the velocity in zone \"{}\" of flow \"{}\", up to {:g} m/s, is along the tube "
      "everywhere: spectra are those of cross flow and act by the velocity across the tube. Name "
      "the zones with cross flow in zones; for axial flow give the forces by [[loads]], with per_length "
      "= true and random = {{ rms, band }}, in two directions across the tube",
      entry.name, zone.name, tube, speed);
}

/// Whether the fluid of a zone goes across the tube somewhere.
bool crosses(const PlacedFlow& placed, std::size_t number, const flow::Tube& tube) {
  constexpr int points = 32;
  const flow::Zone& zone = placed.profile.zones()[number];
  const double length = std::min(zone.to, placed.length) - zone.from;
  for (int k = 0; k < points; ++k)
    if (placed.profile.at(tube.at(zone.from + length * (k + 0.5) / points)).velocity > 0.0)
      return true;
  return false;
}

PatchedZone patched(const study::Turbulence& entry, const PlacedFlow& placed, std::size_t number,
                    const flow::Tube& tube) {
  const flow::Zone& zone = placed.profile.zones()[number];
  PatchedZone out{{}, tube, placed.start, {}, tube.name()};
  flow::TurbulentZone& z = out.zone;
  const flow::PatchGrid grid = patches_of(entry, zone, tube, placed.length);
  z.name = zone.name;
  z.id = id_of(tube.name(), zone.name);
  z.s = grid.s;
  z.ds = grid.ds;
  z.spectrum = spectrum_of(entry, zone);
  z.correlation_length = entry.correlation_length;
  z.scaling = entry.scaling;
  z.running_velocity = entry.running_velocity;
  z.two_sided = entry.two_sided;
  const Eigen::Index n = z.s.size();
  for (Eigen::VectorXd* values : {&z.velocity, &z.density, &z.void_fraction, &z.viscosity, &z.diameter})
    values->resize(n);
  for (Eigen::Matrix3Xd& axis : out.axes)
    axis.resize(3, n);
  for (Eigen::Index k = 0; k < n; ++k) {
    const flow::TubePoint point = tube.at(z.s(k));
    const flow::FlowPoint fluid = placed.profile.at(point);
    if (fluid.velocity > 0.0 && fluid.drag.isZero(0.0))
      throw core::Error(
          fmt::format("turbulence \"{}\": zone \"{}\" of flow \"{}\" has a speed and no direction of "
                      "drag; give the zone direction, or velocity as a vector",
                      entry.name, zone.name, tube.name()));
    z.velocity(k) = fluid.velocity;
    z.density(k) = fluid.density;
    z.void_fraction(k) = fluid.void_fraction;
    z.viscosity(k) = fluid.viscosity;
    z.diameter(k) = point.outer_diameter;
    out.axes[0].col(k) = fluid.drag;
    out.axes[1].col(k) = fluid.lift;
  }
  if (z.velocity.isZero(0.0))
    throw core::Error(axial_flow_text(entry, zone, tube.name()));
  const Eigen::MatrixXd ones = Eigen::MatrixXd::Ones(1, n);
  z.axes = {{ones, entry.drag}, {ones, entry.lift}};
  return out;
}

std::string percent(double share) {
  return share < 0.1 ? fmt::format("{:.2g} %", 100.0 * share) : fmt::format("{:.0f} %", 100.0 * share);
}

std::string band_note(const TurbulentLoad& load) {
  Eigen::Index patches = 0;
  for (const PatchedZone& zone : load.zones)
    patches += zone.zone.patches();
  std::string text = fmt::format("{}: forces from {:.4g} to {:.4g} Hz in blocks of {:g} s on {} patches",
                                 load.name, std::max(load.band.low, 1.0 / load.band.block_period),
                                 load.band.high, load.band.block_period, patches);
  text += fmt::format("; {} of their mean square lies above the band", percent(load.band.above));
  return load.band.low > 0.0 ? text + fmt::format(", {} below", percent(load.band.below)) : text;
}

flow::LoadBand band_of(const study::Turbulence& entry, const std::vector<PatchedZone>& patched) {
  std::vector<flow::TurbulentZone> zones;
  for (const PatchedZone& zone : patched)
    zones.push_back(zone.zone);
  return entry.band ? flow::load_band(zones, entry.band->low, entry.band->high) : flow::load_band(zones);
}

TurbulentLoad load_of(const study::Turbulence& entry, std::vector<PatchedZone> zones) {
  TurbulentLoad out;
  out.name = fmt::format("turbulence \"{}\"", entry.name);
  out.zones = std::move(zones);
  try {
    out.band = band_of(entry, out.zones);
  } catch (const core::Error& error) {
    throw core::Error(fmt::format("{}: {}", out.name, error.what()));
  }
  out.draw.seed = entry.seed;
  out.draw.f_min = out.band.low;
  out.draw.f_max = out.band.high;
  out.draw.block_period = out.band.block_period;
  out.ramp = entry.ramp;
  return out;
}

} // namespace

std::vector<TurbulentLoad> turbulent_loads(const study::Study& study, const fem::Model& model,
                                           const std::vector<PlacedFlow>& flows,
                                           std::vector<std::string>& notes) {
  if (study.turbulence.empty())
    return {};
  for (const study::Turbulence& entry : study.turbulence)
    check_names(study, entry);
  const std::vector<std::vector<int>> owner = owners_of_zones(study);
  std::vector<std::vector<PatchedZone>> zones(study.turbulence.size());
  std::map<std::uint32_t, std::string> ids;
  for (const PlacedFlow& placed : flows) {
    const flow::Tube tube = tube_of(study, placed, model);
    for (std::size_t z = 0; z < owner[placed.entry].size(); ++z) {
      const int e = owner[placed.entry][z];
      if (e < 0) {
        if (const flow::Zone& left = study.flows[placed.entry].zones[z]; has_velocity(left))
          notes.push_back(fmt::format("{}, zone \"{}\": {}: no random forces act there",
                                      name_of(study.flows[placed.entry]), left.name,
                                      crosses(placed, z, tube)
                                          ? "it has a velocity and no [[turbulence]] names it"
                                          : "its velocity is along the tube"));
        continue;
      }
      const auto entry = static_cast<std::size_t>(e);
      zones[entry].push_back(patched(study.turbulence[entry], placed, z, tube));
      const flow::TurbulentZone& zone = zones[entry].back().zone;
      const std::string text = fmt::format("zone \"{}\" of flow \"{}\"", zone.name, tube.name());
      if (const auto [same, fresh] = ids.emplace(zone.id, text); !fresh)
        throw core::Error(
            fmt::format("{} and {} have the same random numbers; rename one of them", same->second, text));
    }
  }
  std::vector<TurbulentLoad> out;
  for (std::size_t e = 0; e < zones.size(); ++e) {
    if (zones[e].empty())
      throw core::Error(
          fmt::format("turbulence \"{}\" acts on no zone: those of its flows have no velocity, or other "
                      "entries name them; leave it out, or give zones",
                      study.turbulence[e].name));
    out.push_back(load_of(study.turbulence[e], std::move(zones[e])));
    notes.push_back(band_note(out.back()));
  }
  return out;
}

std::vector<std::string> spectra_of_one_phase(const study::Study& study,
                                              const std::vector<TurbulentLoad>& loads) {
  constexpr double bubbles = 0.1; // mean void fraction up to which a liquid with some gas counts as one phase
  std::vector<std::string> out;
  for (std::size_t e = 0; e < loads.size(); ++e)
    for (const PatchedZone& patched : loads[e].zones) {
      const flow::TurbulentZone& zone = patched.zone;
      const std::string_view spectrum = flow::name_of(zone.spectrum);
      if (const double mean = zone.void_fraction.mean();
          mean > bubbles && spectrum != "cor_4" && spectrum != "two_phase" && spectrum != "table")
        out.push_back(
            fmt::format("turbulence \"{}\": spectrum {} is a single-phase one, and zone \"{}\" has a void "
                        "fraction of {:.2g}: forces may be many times too small; take two_phase or cor_4",
                        study.turbulence[e].name, spectrum, zone.name, mean));
    }
  return out;
}

Eigen::Index modes_above(const flow::LoadBand& band, const modal::Basis& basis) {
  return (basis.omega.head(basis.true_modes()).array() > 2.0 * std::numbers::pi * band.high).count();
}

std::vector<flow::TurbulentZone> zones_on(const TurbulentLoad& load,
                                          const std::vector<const modal::Basis*>& bases) {
  Eigen::Index modes = 0;
  for (const modal::Basis* basis : bases)
    modes += basis->size();
  std::vector<flow::TurbulentZone> out;
  for (const PatchedZone& patched : load.zones) {
    Eigen::Index first = 0;
    for (const modal::Basis* basis : bases) {
      if (basis->row_of(patched.start) >= 0) {
        flow::TurbulentZone zone = patched.zone;
        for (flow::LoadAxis& axis : zone.axes)
          axis.shapes = Eigen::MatrixXd::Zero(modes, zone.patches());
        for (Eigen::Index k = 0; k < zone.patches(); ++k) {
          const double half = 0.5 * zone.ds(k);
          const Eigen::Matrix3Xd shapes =
              patched.tube.mean_shapes(*basis, zone.s(k) - half, zone.s(k) + half);
          for (std::size_t a = 0; a < zone.axes.size(); ++a)
            zone.axes[a].shapes.col(k).segment(first, basis->size()) =
                shapes.transpose() * patched.axes[a].col(k);
        }
        out.push_back(std::move(zone));
        break;
      }
      first += basis->size();
    }
  }
  return out;
}

} // namespace fretwork::app
