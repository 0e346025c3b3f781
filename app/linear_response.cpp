// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/linear_response.hpp"
#include "core/error.hpp"
#include "core/mpi.hpp"
#include "flow/mode_direction.hpp"
#include "flow/response.hpp"
#include "flow/stability.hpp"
#include "modal/damping.hpp"
#include "results/flow_text.hpp"
#include <algorithm>
#include <fmt/format.h>
#include <numbers>

namespace fretwork::app {
namespace {

/// What a band loses is looked for so far above it; beyond, forces and modes are negligible.
constexpr double looked_above = 4.0;

/// A displacement whose statistics are asked for.
struct Watched {
  results::ResponsePoint point;
  Eigen::VectorXd shape; ///< displacement of the modes
};

Eigen::MatrixXd node_rows(const modal::Basis& basis, core::Index node) {
  return basis.shapes.middleRows<3>(basis.row_of(node));
}

void watch_nodes(const modal::Basis& basis, const std::vector<NamedNode>& nodes, std::vector<Watched>& out) {
  for (const NamedNode& node : nodes)
    if (basis.row_of(node.node) >= 0) {
      const Eigen::MatrixXd rows = node_rows(basis, node.node);
      for (int axis = 0; axis < 3; ++axis)
        out.push_back({{node.name, std::string(1, "xyz"[axis])}, rows.row(axis).transpose()});
    }
}

/// Of contacts between two nodes the relative motion, where both belong to the structure.
void watch_contacts(const modal::Basis& basis, const std::vector<PlacedContact>& contacts,
                    std::vector<Watched>& out) {
  for (const PlacedContact& contact : contacts) {
    if (basis.row_of(contact.node) < 0 || (contact.other >= 0 && basis.row_of(contact.other) < 0))
      continue;
    Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(3, basis.size());
    for (const fem::NodeShare& share : contact.motion)
      rows += share.weights * basis.shapes.middleRows<6>(basis.row_of(share.node));
    if (contact.other >= 0)
      rows -= node_rows(basis, contact.other);
    rows = contact.frame.rotation() * rows;
    out.push_back({{contact.name, "y_loc"}, rows.row(1).transpose()});
    out.push_back({{contact.name, "z_loc"}, rows.row(2).transpose()});
  }
}

flow::LinearModes linear_modes(const std::string& what, const modal::Basis& basis) {
  const Eigen::Index n = basis.true_modes();
  for (Eigen::Index i = 0; i < n; ++i)
    if (basis.omega(i) > 0.0 && !(basis.damping(i) > 0.0 && basis.damping(i) < 1.0))
      throw core::Error(
          fmt::format("{}: mode {} has the damping ratio {:g}, and a linear response by spectra needs one "
                      "above 0 and below 1; give modes.damping, or damping of [[response]]",
                      what, i + 1, basis.damping(i)));
  return {Eigen::VectorXd::Ones(n), basis.omega.head(n), basis.damping.head(n)};
}

/// Moments of all displacements, added over independent loads.
struct Sums {
  std::vector<flow::SpectralMoments> in_band;
  Eigen::VectorXd outside, above; ///< variances from outside the range of the spectra, and above the band

  explicit Sums(std::size_t points)
      : in_band(points), outside(Eigen::VectorXd::Zero(static_cast<Eigen::Index>(points))), above(outside) {}

  /// Points that move by no more than the round-off of the others are at rest: along a straight tube that the flow crosses.
  void leave_out_round_off() {
    constexpr double round_off = 1e-9; // of a displacement
    double largest = 0.0;
    for (const flow::SpectralMoments& m : in_band)
      largest = std::max(largest, m.L0);
    for (flow::SpectralMoments& m : in_band)
      if (m.L0 < round_off * round_off * largest)
        m = {};
  }
};

void add_load(const TurbulentLoad& load, const modal::Basis& basis, const flow::LinearModes& modes,
              const Eigen::MatrixXd& shapes, Sums& sums) {
  std::vector<flow::TurbulentZone> zones = zones_on(load, {&basis});
  if (zones.empty())
    return;
  for (flow::TurbulentZone& zone : zones)
    for (flow::LoadAxis& axis : zone.axes)
      axis.shapes = axis.shapes.topRows(modes.mass.size()).eval();
  const double low = std::max(load.band.low, 1.0 / load.band.block_period), high = load.band.high;
  const auto found =
      flow::LinearResponse(modes, flow::load_spectrum(zones, low, high), low, high).at_points(shapes);
  const Eigen::VectorXd outside = flow::share_outside(modes, zones, low, high, shapes);
  const double far = looked_above * high;
  const auto beyond =
      flow::LinearResponse(modes, flow::load_spectrum(zones, high, far), high, far).at_points(shapes);
  for (std::size_t k = 0; k < found.size(); ++k) {
    flow::SpectralMoments& sum = sums.in_band[k];
    sum.L0 += found[k].L0;
    sum.L1 += found[k].L1;
    sum.L2 += found[k].L2;
    sum.L4 += found[k].L4;
    const auto row = static_cast<Eigen::Index>(k);
    sums.outside(row) += outside(row) * found[k].L0;
    sums.above(row) += beyond[k].L0;
  }
}

/// Modes above the band respond quasi-statically; what that loses of a displacement is `share_above`.
void note_pinned_modes_above(const TurbulentLoad& load, const modal::Basis& basis,
                             const std::string& response, std::vector<std::string>& notes) {
  if (const Eigen::Index above = modes_above(load.band, basis);
      above > 0 && !zones_on(load, {&basis}).empty())
    notes.push_back(fmt::format(
        "response \"{}\": {} of {} modes, up to {:.4g} Hz, lie above the band of {}, which ends at {:.4g} "
        "Hz, and respond quasi-statically; share_above is what forces above it would add, a wider band of "
        "[[turbulence]] has them",
        response, above, basis.true_modes(), basis.omega(basis.true_modes() - 1) / (2.0 * std::numbers::pi),
        load.name, load.band.high));
}

/// Adds the points of one structure.
void respond(const study::Response& asked, const std::vector<TurbulentLoad>& loads, const modal::Basis& basis,
             std::vector<Watched> watched, results::LinearResponse& out, std::vector<std::string>& notes) {
  const flow::LinearModes modes = linear_modes("response \"" + out.name + "\"", basis);
  const auto points = static_cast<Eigen::Index>(watched.size());
  Eigen::MatrixXd shapes(points, modes.mass.size());
  for (Eigen::Index k = 0; k < points; ++k)
    shapes.row(k) = watched[static_cast<std::size_t>(k)].shape.head(modes.mass.size());
  Sums sums(watched.size());
  for (const TurbulentLoad& load : loads) {
    add_load(load, basis, modes, shapes, sums);
    note_pinned_modes_above(load, basis, out.name, notes);
  }
  sums.leave_out_round_off();
  for (std::size_t k = 0; k < watched.size(); ++k) {
    const flow::SpectralMoments& m = sums.in_band[k];
    results::ResponsePoint& point = watched[k].point;
    point.rms = m.rms();
    point.rms_velocity = m.rms_velocity();
    point.up_crossings = m.up_crossings();
    point.irregularity = m.irregularity();
    point.maximum = m.maximum(asked.duration, asked.probability);
    if (m.L0 > 0.0) {
      point.share_outside = sums.outside(static_cast<Eigen::Index>(k)) / m.L0;
      point.share_above = sums.above(static_cast<Eigen::Index>(k)) / m.L0;
    }
    out.points.push_back(std::move(point));
  }
}

/// Returns whether by the flow.
bool damp(const TubesInFlow& tubes, const study::Response& asked, PinnedModes& modes) {
  if (!asked.damping && tubes.study.modes.flow_damping) {
    static_cast<void>(
        damp_by_flow(tubes, DampingSet::stability, modes.pins.held, modes.pins.left_out, modes.bases));
    return true;
  }
  for (modal::Basis& basis : modes.bases)
    if (asked.damping)
      modal::apply_damping(basis, *asked.damping);
    else
      modal::apply_damping(basis, tubes.study.modes.damping);
  return false;
}

/// Keeps the lowest mode of all structures.
void find_lowest(const modal::Basis& basis, results::LinearResponse& out) {
  for (Eigen::Index mode = 0; mode < basis.true_modes(); ++mode)
    if (const double hz = basis.omega(mode) / (2.0 * std::numbers::pi);
        hz > 0.0 && (out.frequency == 0.0 || hz < out.frequency)) {
      out.frequency = hz;
      out.damping = basis.damping(mode);
    }
}

/// A warning of each tube that is unstable by Connors on the modes of the response, with their damping: the flow has it move by more than
/// its turbulence does. Zones without a constant K are not judged.
void warn_of_instability(const TubesInFlow& tubes, const std::string& name,
                         const std::vector<modal::Basis>& bases, std::vector<std::string>& warnings) {
  for (const PlacedFlow& placed : tubes.flows) {
    const auto structure = modal::structure_of(bases, placed.start);
    if (!structure)
      continue;
    const modal::Basis& basis = bases[*structure];
    const flow::Sampling sampling =
        flow::sample(tube_of(tubes.study, placed, tubes.model), placed.profile, basis);
    flow::Stability found;
    try {
      found = flow::stability(placed.profile, sampling, basis.damping.head(basis.true_modes()));
    } catch (const core::Error&) {
      continue;
    }
    if (found.cases.empty())
      continue;
    const flow::StabilityCase& worst = found.cases[results::worst_case(found)];
    if (!worst.margin() || *worst.margin() > 0.0)
      continue;
    const auto mode = static_cast<std::size_t>(worst.critical_mode);
    warnings.push_back(
        fmt::format("response \"{}\": {} is fluid-elastically unstable on its modes, V/Vc = {:.4g} in mode "
                    "{} at {:.4g} Hz ({}) by "
                    "Connors, with the damping of the response, {:.3g} %: the tube moves by more than its "
                    "turbulence makes it, and this "
                    "response is no bound; take a transient with its supports, or more supports in pinned",
                    name, name_of(tubes.study.flows[placed.entry]), 1.0 - *worst.margin(), mode + 1,
                    found.modes[mode].frequency, flow::short_text(flow::mode_directions(sampling)[mode]),
                    100.0 * found.modes[mode].damping));
  }
}

results::LinearResponse response_of(const TubesInFlow& tubes, const study::Response& asked,
                                    const std::vector<TurbulentLoad>& loads,
                                    const std::vector<NamedNode>& nodes, PinnedModes& modes,
                                    std::vector<std::string>& notes) {
  results::LinearResponse out;
  out.by_flow = damp(tubes, asked, modes);
  out.name = asked.name;
  out.pinned = names_of(tubes.study, modes.pins);
  out.duration = asked.duration;
  out.probability = asked.probability;
  for (const modal::Basis& basis : modes.bases) {
    out.modes += basis.true_modes();
    find_lowest(basis, out);
    std::vector<Watched> watched;
    watch_nodes(basis, nodes, watched);
    watch_contacts(basis, modes.pins.left_out, watched);
    if (!watched.empty() && basis.true_modes() > 0)
      respond(asked, loads, basis, std::move(watched), out, notes);
  }
  return out;
}

/// What the response loses, where it matters.
void note_losses(const results::LinearResponse& response, std::vector<std::string>& notes) {
  constexpr double reported = 1e-3; // of a variance
  constexpr double still = 1e-3;    // of the largest rms: what pins leave is not looked at
  double outside = 0.0, above = 0.0, largest = 0.0;
  for (const results::ResponsePoint& point : response.points)
    largest = std::max(largest, point.rms);
  for (const results::ResponsePoint& point : response.points) {
    if (point.rms < still * largest)
      continue;
    outside = std::max(outside, point.share_outside);
    above = std::max(above, point.share_above);
  }
  if (outside > reported)
    notes.push_back(
        fmt::format("response \"{}\": up to {:.2g} % of a variance comes from frequencies outside the range "
                    "of the spectra, where they are continued",
                    response.name, 100.0 * outside));
  if (above > reported)
    notes.push_back(
        fmt::format("response \"{}\": forces above the band of the turbulence would add up to {:.2g} % to a "
                    "variance; give [[turbulence]] a wider band",
                    response.name, 100.0 * above));
}

} // namespace

PinsAsked pins_asked(const study::Response& response) {
  return {fmt::format("response \"{}\"", response.name), response.pinned, response.contacts};
}

void linear_responses(MPI_Comm comm, const TubesInFlow& tubes, const std::vector<TurbulentLoad>& loads,
                      const std::vector<PlacedContact>& contacts, const std::vector<NamedNode>& nodes,
                      results::RunResults& out) {
  std::vector<study::Response> asked = tubes.study.responses;
  if (asked.empty()) {
    asked.emplace_back();
    asked.back().name = "all contacts pinned";
  }
  for (const study::Response& one : asked) {
    PinnedModes modes = pinned_modes(comm, pins_asked(one), tubes, contacts, out.notes);
    core::agree(comm, [&] {
      out.responses.push_back(response_of(tubes, one, loads, nodes, modes, out.notes));
      if (out.responses.back().points.empty())
        throw core::Error(
            fmt::format("response \"{}\": nothing is observed: name groups in [output] nodes, or leave "
                        "contacts unpinned",
                        one.name));
      warn_of_instability(tubes, one.name, modes.bases, out.warnings);
      note_losses(out.responses.back(), out.notes);
    });
  }
}

} // namespace fretwork::app
