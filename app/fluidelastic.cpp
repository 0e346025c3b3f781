// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/fluidelastic.hpp"
#include "core/error.hpp"
#include "core/general_eigenvalues.hpp"
#include "flow/fluidelastic.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <numbers>
#include <optional>

namespace fretwork::app {
namespace {

using Eigen::Index;

constexpr double largest_factor = 3.0; // of the search for the first crossing
constexpr int steps = 30, halvings = 30;
constexpr double round_off = 1e-10;  // of the largest root: growth below is none
constexpr Index most_searched = 600; // unknowns: their eigenvalues take a second

/// Where V is largest.
struct Fastest {
  double velocity = 0.0, diameter = 1.0; ///< m/s, m
};

Fastest fastest(const flow::Sampling& sampling) {
  Fastest out;
  for (const flow::Station& station : sampling.stations)
    if (station.flow.velocity > out.velocity)
      out = {station.flow.velocity, station.tube.outer_diameter};
  return out;
}

struct TubeWithLaw {
  const study::Flow& flow;
  std::size_t structure;
  flow::Sampling sampling;
};

std::vector<TubeWithLaw> tubes_with_laws(const TubesInFlow& tubes, const std::vector<modal::Basis>& bases) {
  std::vector<TubeWithLaw> out;
  for (const PlacedFlow& placed : tubes.flows) {
    const study::Flow& flow = tubes.study.flows[placed.entry];
    if (!flow.law)
      continue;
    const std::size_t structure = structure_of(placed, flow.name, bases);
    TubeWithLaw tube{
        flow, structure,
        flow::sample(tube_of(tubes.study, placed, tubes.model), placed.profile, bases[structure])};
    out.push_back(std::move(tube));
  }
  return out;
}

core::MotionForces forces_of(const study::Flow& flow, const flow::Sampling& sampling, Index modes,
                             double factor) {
  try {
    return flow::motion_forces(sampling, *flow.law, modes, factor);
  } catch (const core::Error& error) {
    throw core::Error(fmt::format("{}: {}", name_of(flow), error.what()));
  }
}

/// The modes of lowest frequency.
flow::Sampling lowest(flow::Sampling sampling, Index modes) {
  const Index n = std::min(modes, sampling.modes());
  sampling.frequency.conservativeResize(n);
  sampling.modal_mass.conservativeResize(n);
  for (flow::Station& station : sampling.stations)
    station.shapes.conservativeResize(Eigen::NoChange, n);
  return sampling;
}

/// Between the first and the last, and 1 where it is between them.
std::vector<double> factors_of(const study::Stability& assessment) {
  const auto [first, last] = assessment.factors;
  std::vector<double> out;
  for (int i = 0; i < assessment.points; ++i)
    out.push_back(first + (last - first) * i / (assessment.points - 1));
  if (first < 1.0 && last > 1.0)
    if (const auto at = std::lower_bound(out.begin(), out.end(), 1.0); *at != 1.0)
      out.insert(at, 1.0);
  return out;
}

/// The vibration modes of a tube in its flow.
class Roots {
public:
  Roots(const TubeWithLaw& tube, const modal::Basis& basis)
      : forces_(forces_of(tube.flow, tube.sampling, tube.sampling.modes(), largest_factor)) {
    const Index n = tube.sampling.modes();
    k_ = basis.omega.head(n).cwiseAbs2();
    c_ = 2.0 * basis.damping.head(n).cwiseProduct(basis.omega.head(n));
    if (basis.damping_matrix.size() > 0)
      c_ = basis.damping_matrix.diagonal().head(n);
  }

  [[nodiscard]] Index size() const { return 2 * k_.size() + forces_.states(); }

  /// The root that grows fastest at `factor` times the velocity, 1/s; where none grows, the vibration of least damping ratio.
  [[nodiscard]] std::complex<double> worst(double factor) const {
    const Eigen::VectorXcd roots =
        core::general_eigenvalues(flow::state_matrix(k_, c_, flow::scaled(forces_, factor)));
    const double none = round_off * roots.cwiseAbs().maxCoeff();
    std::complex<double> growing = none, vibrating = 0.0;
    double ratio = std::numeric_limits<double>::infinity();
    for (const std::complex<double>& s : roots) {
      if (s.real() > growing.real())
        growing = {s.real(), std::abs(s.imag())};
      if (s.imag() > 0.0 && -s.real() / std::abs(s) < ratio) {
        ratio = -s.real() / std::abs(s);
        vibrating = s;
      }
    }
    return growing.real() > none ? growing : std::complex(std::min(vibrating.real(), 0.0), vibrating.imag());
  }

  /// The least factor of all velocities at which a root crosses the imaginary axis, up to largest_factor.
  [[nodiscard]] std::optional<double> critical_factor() const {
    double low = 0.0;
    for (int i = 1; i <= steps; ++i) {
      double high = largest_factor * i / steps;
      if (worst(high).real() > 0.0) {
        for (int k = 0; k < halvings; ++k) {
          const double middle = 0.5 * (low + high);
          (worst(middle).real() > 0.0 ? high : low) = middle;
        }
        return high;
      }
      low = high;
    }
    return {};
  }

private:
  core::MotionForces forces_;
  Eigen::VectorXd k_, c_;
};

} // namespace

std::vector<core::MotionForces> fluidelastic_forces(const TubesInFlow& tubes,
                                                    const std::vector<modal::Basis>& bases) {
  std::vector<core::MotionForces> out;
  for (const TubeWithLaw& tube : tubes_with_laws(tubes, bases)) {
    out.resize(bases.size());
    core::MotionForces& to = out[tube.structure];
    if (!to.empty())
      throw core::Error(fmt::format("{}: a second tube of its structure has a flow with a law; a law acts on "
                                    "one tube of a structure, leave law out of the other [[flow]]",
                                    name_of(tube.flow)));
    to = forces_of(tube.flow, tube.sampling, bases[tube.structure].size(), 1.0);
  }
  return out;
}

std::optional<results::LawStability> law_stability(const study::Flow& flow, const flow::Sampling& sampling,
                                                   const Eigen::VectorXd& damping,
                                                   const study::Stability& assessment) {
  const auto [velocity, diameter] = fastest(sampling);
  if (!flow.law || velocity == 0.0 || sampling.modes() == 0)
    return {};
  const flow::Sampling low = lowest(sampling, assessment.modes);
  const Eigen::VectorXd w = 2.0 * std::numbers::pi * low.frequency;
  const core::MotionForces forces = forces_of(flow, low, low.modes(), assessment.factors[1]);
  if (const Index size = 2 * low.modes() + forces.states(); size > most_searched)
    throw core::Error(fmt::format(
        "stability \"{}\", {}: the diagram has {} unknowns of modes and lags, more than {}; give a "
        "smaller modes (now {})",
        assessment.name, name_of(flow), size, most_searched, low.modes()));
  results::LawStability out{velocity, diameter, flow.law->range, {}};
  out.diagram = flow::stability_diagram(w.cwiseAbs2(), 2.0 * damping.head(low.modes()).cwiseProduct(w),
                                        forces, factors_of(assessment));
  return out;
}

void judge_fluidelastic(const TubesInFlow& tubes, const std::vector<modal::Basis>& bases,
                        results::RunResults& out) {
  for (const TubeWithLaw& tube : tubes_with_laws(tubes, bases)) {
    const auto [velocity, diameter] = fastest(tube.sampling);
    if (velocity == 0.0)
      continue;
    const Roots roots(tube, bases[tube.structure]);
    const std::complex<double> root = roots.worst(1.0);
    const double frequency = std::abs(root) / (2.0 * std::numbers::pi),
                 reduced = velocity / (frequency * diameter);
    const bool unstable = root.real() > 0.0;
    std::string crossing;
    if (roots.size() > most_searched)
      crossing = fmt::format("no critical velocity is searched with {} modes and states, more than {}",
                             roots.size(), most_searched);
    else if (const std::optional<double> critical = roots.critical_factor())
      crossing = fmt::format("critical velocity {:.5g} m/s, factor {:.5g}", *critical * velocity, *critical);
    else
      crossing = fmt::format("stable up to {:g} times the velocity", largest_factor);
    const bool diverges = unstable && root.imag() == 0.0;
    const std::string motion = diverges ? fmt::format("divergence, which grows by {:.4g} 1/s", root.real())
                                        : fmt::format("{:.5g} Hz with damping {:.4g} at V/(f D) = {:.4g}",
                                                      frequency, -root.real() / std::abs(root), reduced);
    std::string text =
        fmt::format("{}: fluidelastic law, without contacts: {}; {}", name_of(tube.flow), motion, crossing);
    if (unstable)
      text += ": unstable, supports must limit the motion";
    (unstable ? out.warnings : out.notes).push_back(std::move(text));
    if (const auto& range = tube.flow.law->range;
        range && unstable && !diverges && (reduced < (*range)[0] || reduced > (*range)[1]))
      out.warnings.push_back(
          fmt::format("{}: reduced velocity {:.4g} of the unstable mode is outside the law's range "
                      "{:g} to {:g}; the law is extrapolated",
                      name_of(tube.flow), reduced, (*range)[0], (*range)[1]));
  }
}

void judge_amplitudes(const TubesInFlow& tubes, const std::vector<PlacedContact>& placed,
                      const std::vector<NamedNode>& nodes, results::RunResults& out) {
  constexpr double linear = 0.1; // of the diameter
  const auto amplitude = [](const post::Moments& m) { return std::max(m.max - m.mean, m.mean - m.min); };
  for (const TubeWithLaw& tube : tubes_with_laws(tubes, out.bases)) {
    const modal::Basis& basis = out.bases[tube.structure];
    double largest = 0.0;
    std::string where;
    const auto look = [&](const std::string& name, core::Index node, const post::Moments& moments) {
      if (basis.row_of(node) >= 0 && amplitude(moments) > largest) {
        largest = amplitude(moments);
        where = name;
      }
    };
    for (std::size_t c = 0; c < out.contact_summaries.size(); ++c)
      for (const post::Moments* moments : {&out.contact_summaries[c].y, &out.contact_summaries[c].z})
        look(fmt::format("contact \"{}\"", placed[c].name), placed[c].node, *moments);
    for (std::size_t k = 0; k < out.node_summaries.size(); ++k)
      for (const post::Moments& moments : out.node_summaries[k].displacement)
        look(fmt::format("node \"{}\"", nodes[k].name), nodes[k].node, moments);
    const double diameter = fastest(tube.sampling).diameter;
    if (diameter > 0.0 && !(largest <= linear * diameter))
      out.warnings.push_back(
          fmt::format("{}: {} moves by {:.3g} m about its mean, {:.2g} of the diameter: the fluidelastic law "
                      "is linear, good to "
                      "some {:g} of it; amplitudes, forces and work rates are not to be trusted",
                      name_of(tube.flow), where, largest, largest / diameter, linear));
  }
}

void add_motion_forces(const std::vector<core::MotionForces>& by_structure,
                       const std::vector<std::size_t>& structures, const std::vector<modal::Basis>& bases,
                       transient::System& system) {
  Index states = 0;
  for (const std::size_t s : structures)
    if (s < by_structure.size())
      states += by_structure[s].states();
  const bool any = std::any_of(structures.begin(), structures.end(), [&](std::size_t s) {
    return s < by_structure.size() && !by_structure[s].empty();
  });
  if (!any)
    return;
  const Index n = system.size();
  core::MotionForces& to = system.motion;
  to.stiffness = to.damping = Eigen::MatrixXd::Zero(n, n);
  to.input = Eigen::MatrixXd::Zero(n, states);
  to.rates = Eigen::MatrixXd::Zero(states, states);
  to.output = Eigen::MatrixXd::Zero(states, n);
  Index mode = 0, state = 0;
  for (const std::size_t s : structures) {
    const core::MotionForces& f = by_structure[s];
    const Index m = bases[s].size(), r = f.states();
    if (!f.empty()) {
      to.stiffness.block(mode, mode, m, m) = f.stiffness;
      to.damping.block(mode, mode, m, m) = f.damping;
      to.input.block(mode, state, m, r) = f.input;
      to.rates.block(state, state, r, r) = f.rates;
      to.output.block(state, mode, r, m) = f.output;
      state += r;
    }
    mode += m;
  }
}

void refuse_fluidelastic_sweep(const study::Study& study) {
  for (const study::Flow& flow : study.flows)
    if (flow.law)
      throw core::Error(
          fmt::format("{}: law is not taken by sweeps; run the cases one by one with --set, or leave "
                      "law out",
                      name_of(flow)));
}

} // namespace fretwork::app
