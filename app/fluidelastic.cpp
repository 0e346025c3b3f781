// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/fluidelastic.hpp"
#include "core/error.hpp"
#include "core/general_eigenvalues.hpp"
#include "flow/fluidelastic.hpp"
#include "results/flow_text.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

namespace fretwork::app {
namespace {

using Eigen::Index;

constexpr double largest_factor = 3.0; // of the search for the first crossing
constexpr int steps = 30, halvings = 30;
constexpr double round_off = 1e-10;  // of the largest root: growth below is none
constexpr Index most_searched = 600; // unknowns: their eigenvalues take a second

/// The tubes of a law, one or several that it couples, on the modes of their structures one after the other.
struct TubesOfLaw {
  std::string name; ///< for messages
  const flow::FluidelasticLaw& law;
  std::vector<std::size_t> flows;      ///< numbers in TubesInFlow::flows
  std::vector<std::size_t> structures; ///< numbers, ascending
  std::vector<Index> first;            ///< mode of each structure among those of all
  Index modes;                         ///< of all, static ones too
  std::vector<flow::TubeOfLaw> tubes;
};

/// Flows by laws; those of a law of one tube each by itself.
std::vector<std::vector<std::size_t>> flows_by_laws(const TubesInFlow& tubes) {
  std::vector<std::vector<std::size_t>> out;
  const auto flow_of = [&](std::size_t f) -> const study::Flow& {
    return tubes.study.flows[tubes.flows[f].entry];
  };
  for (std::size_t f = 0; f < tubes.flows.size(); ++f) {
    const study::Flow& flow = flow_of(f);
    if (!flow.law)
      continue;
    const auto same = std::find_if(out.begin(), out.end(), [&](const std::vector<std::size_t>& one) {
      return flow.law->tubes() > 1 && flow_of(one.front()).law_name == flow.law_name;
    });
    if (same == out.end())
      out.push_back({f});
    else
      same->push_back(f);
  }
  return out;
}

std::vector<TubesOfLaw> tubes_of_laws(const TubesInFlow& tubes, const std::vector<modal::Basis>& bases) {
  std::vector<TubesOfLaw> out;
  for (const std::vector<std::size_t>& flows : flows_by_laws(tubes)) {
    const auto flow_of = [&](std::size_t f) -> const study::Flow& {
      return tubes.study.flows[tubes.flows[f].entry];
    };
    const study::Flow& flow = flow_of(flows.front());
    std::string name = name_of(flow);
    if (flows.size() > 1)
      name = fmt::format("law \"{}\" of {} tubes", flow.law_name, flows.size());
    TubesOfLaw of{std::move(name), *flow.law, flows, {}, {}, 0, {}};
    std::vector<flow::Tube> chains;
    std::vector<std::size_t> structures;
    for (const std::size_t f : flows) {
      structures.push_back(structure_of(tubes.flows[f], flow_of(f).name, bases));
      chains.push_back(tube_of(tubes.study, tubes.flows[f], tubes.model));
    }
    of.structures = structures;
    std::sort(of.structures.begin(), of.structures.end());
    of.structures.erase(std::unique(of.structures.begin(), of.structures.end()), of.structures.end());
    for (const std::size_t s : of.structures) {
      of.first.push_back(of.modes);
      of.modes += bases[s].size();
    }
    std::vector<flow::TubeToSample> beside;
    for (std::size_t i = 0; i < flows.size(); ++i)
      beside.push_back({chains[i], tubes.flows[flows[i]].profile, bases[structures[i]]});
    std::vector<flow::Sampling> samplings = flow::sample_beside(beside);
    for (std::size_t i = 0; i < flows.size(); ++i) {
      const auto at = std::lower_bound(of.structures.begin(), of.structures.end(), structures[i]);
      of.tubes.push_back(
          {std::move(samplings[i]), of.first[static_cast<std::size_t>(at - of.structures.begin())]});
    }
    out.push_back(std::move(of));
  }
  return out;
}

/// The vibration modes of lowest frequency alone, so many of each structure at most.
TubesOfLaw lowest(TubesOfLaw of, const std::vector<modal::Basis>& bases, Index most) {
  const std::vector<Index> before = std::exchange(of.first, {});
  of.modes = 0;
  for (const std::size_t s : of.structures) {
    of.first.push_back(of.modes);
    of.modes += std::min(most, bases[s].true_modes());
  }
  for (flow::TubeOfLaw& tube : of.tubes) {
    const auto at = std::lower_bound(before.begin(), before.end(), tube.first) - before.begin();
    tube.first = of.first[static_cast<std::size_t>(at)];
    flow::Sampling& sampling = tube.sampling;
    const Index n = std::min(most, sampling.modes());
    sampling.frequency.conservativeResize(n);
    sampling.modal_mass.conservativeResize(n);
    for (flow::Station& station : sampling.stations)
      station.shapes.conservativeResize(Eigen::NoChange, n);
  }
  return of;
}

/// Where V is largest.
struct Fastest {
  double velocity = 0.0, diameter = 1.0; ///< m/s, m
};

Fastest fastest(const TubesOfLaw& of) {
  Fastest out;
  for (const flow::TubeOfLaw& tube : of.tubes)
    for (const flow::Station& station : tube.sampling.stations)
      if (station.flow.velocity > out.velocity)
        out = {station.flow.velocity, station.tube.outer_diameter};
  return out;
}

/// @param factor  the largest
flow::ForcesOverFactor forces_of(const TubesOfLaw& of, double factor) {
  try {
    flow::ForcesOverFactor out = flow::forces_over_factor(of.tubes, of.law, of.modes, factor);
    (void)out(factor); // what it refuses
    return out;
  } catch (const core::Error& error) {
    throw core::Error(fmt::format("{}: {}", of.name, error.what()));
  }
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

/// The vibration modes of tubes in their flow.
class Roots {
public:
  /// @param most  modes of each structure
  Roots(const TubesOfLaw& all, const std::vector<modal::Basis>& bases, Index most) {
    const TubesOfLaw of = lowest(all, bases, most);
    forces_ = forces_of(of, largest_factor);
    k_.resize(of.modes);
    c_ = Eigen::MatrixXd::Zero(of.modes, of.modes);
    for (std::size_t i = 0; i < of.structures.size(); ++i) {
      const modal::Basis& basis = bases[of.structures[i]];
      const Index n = std::min(most, basis.true_modes());
      k_.segment(of.first[i], n) = basis.omega.head(n).cwiseAbs2();
      auto c = c_.block(of.first[i], of.first[i], n, n);
      if (basis.damping_matrix.size() > 0)
        c = basis.damping_matrix.topLeftCorner(n, n);
      else
        c.diagonal() = 2.0 * basis.damping.head(n).cwiseProduct(basis.omega.head(n));
    }
  }

  [[nodiscard]] Index size() const { return 2 * k_.size() + forces_(1.0).states(); }

  /// The root that grows fastest at `factor` times the velocity, 1/s; where none grows, the vibration of least damping ratio.
  [[nodiscard]] std::complex<double> worst(double factor) const {
    const Index n = k_.size();
    Eigen::MatrixXd a = flow::state_matrix(k_, Eigen::VectorXd::Zero(n), forces_(factor));
    a.block(n, n, n, n) -= c_;
    const Eigen::VectorXcd roots = core::general_eigenvalues(a);
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
  flow::ForcesOverFactor forces_;
  Eigen::VectorXd k_;
  Eigen::MatrixXd c_;
};

} // namespace

std::vector<FluidForces> fluidelastic_forces(const TubesInFlow& tubes,
                                             const std::vector<modal::Basis>& bases) {
  std::vector<FluidForces> out;
  std::vector<bool> taken(bases.size(), false);
  for (const TubesOfLaw& of : tubes_of_laws(tubes, bases)) {
    for (const std::size_t s : of.structures) {
      if (taken[s])
        throw core::Error(
            fmt::format("{}: another law acts on a tube of the same structure; give these tubes one law, or "
                        "leave law out of the other [[flow]]",
                        of.name));
      taken[s] = true;
    }
    out.push_back({of.structures, forces_of(of, 1.0)(1.0)});
  }
  return out;
}

void assess_laws(const TubesInFlow& tubes, const std::vector<modal::Basis>& bases,
                 const study::Stability& assessment, const std::vector<Eigen::VectorXd>& ratios,
                 std::vector<results::StabilityAssessment>& found) {
  for (const TubesOfLaw& all : tubes_of_laws(tubes, bases)) {
    const TubesOfLaw of = lowest(all, bases, assessment.modes);
    const auto [velocity, diameter] = fastest(of);
    if (velocity == 0.0 || of.modes == 0)
      continue;
    const flow::ForcesOverFactor forces = forces_of(of, assessment.factors[1]);
    if (const Index size = 2 * of.modes + forces(1.0).states(); size > most_searched)
      throw core::Error(fmt::format(
          "stability \"{}\", {}: the diagram has {} unknowns of modes and lags, more than {}; give a "
          "smaller modes (now {})",
          assessment.name, of.name, size, most_searched, assessment.modes));
    results::LawStability out{velocity, diameter, of.law.range, {}, {}, {}};
    out.modes.resize(static_cast<std::size_t>(of.modes));
    Eigen::VectorXd k(of.modes), c(of.modes);
    for (std::size_t i = 0; i < of.flows.size(); ++i) {
      const results::StabilityAssessment& its = found[of.flows[i]];
      out.tubes.push_back(its.damping.tube);
      const Index first = of.tubes[i].first, n = of.tubes[i].sampling.modes();
      if (n == 0 || !out.modes[static_cast<std::size_t>(first)].tube.empty())
        continue; // a second tube of a structure
      const Eigen::VectorXd w = 2.0 * std::numbers::pi * of.tubes[i].sampling.frequency;
      k.segment(first, n) = w.cwiseAbs2();
      c.segment(first, n) = 2.0 * ratios[of.flows[i]].head(n).cwiseProduct(w);
      const auto& connors = its.stability.cases[results::worst_case(its.stability)];
      for (Index mode = 0; mode < n; ++mode)
        out.modes[static_cast<std::size_t>(first + mode)] = {its.damping.tube, mode,
                                                             1.0 / connors.ratio(mode)};
    }
    out.diagram = flow::stability_diagram(k, c, forces, factors_of(assessment));
    found[of.flows.front()].law = std::move(out);
  }
}

void judge_fluidelastic(const TubesInFlow& tubes, const std::vector<modal::Basis>& bases,
                        const std::vector<PlacedContact>& placed, results::RunResults& out) {
  for (const TubesOfLaw& of : tubes_of_laws(tubes, bases)) {
    const auto [velocity, diameter] = fastest(of);
    if (velocity == 0.0)
      continue;
    Index most = 0;
    for (const std::size_t s : of.structures)
      most = std::max(most, bases[s].true_modes());
    std::optional<Roots> found(std::in_place, of, bases, most);
    bool some = false; // modes alone
    for (; found->size() > most_searched && most > 1; some = true)
      found.emplace(of, bases, most /= 2);
    const Roots& roots = *found;
    results::LawAtWork now{{}, roots.size(), roots.worst(1.0), velocity, diameter, roots.critical_factor()};
    for (const std::size_t f : of.flows)
      now.tubes.push_back(tubes.study.flows[tubes.flows[f].entry].name);
    if (of.law.frozen && !placed.empty())
      out.warnings.push_back(fmt::format(
          "{}: the law is frozen at the frequency of each mode, which contacts change: it holds up to the "
          "threshold, and past it no stop limits the motion; give a law with lags",
          of.name));
    const std::complex<double> root = now.root;
    const double frequency = flow::frequency_of(root), reduced = now.reduced_velocity();
    const std::optional<double> critical = now.critical_factor;
    out.laws.push_back(std::move(now));
    const bool unstable = root.real() > 0.0;
    std::string crossing =
        critical ? fmt::format("critical velocity {:.5g} m/s, factor {:.5g}", *critical * velocity, *critical)
                 : fmt::format("stable up to {:g} times the velocity", largest_factor);
    if (some)
      crossing +=
          fmt::format(" (of the {} lowest modes{})", most, of.structures.size() > 1 ? " of each tube" : "");
    const bool diverges = unstable && root.imag() == 0.0;
    const std::string motion = diverges ? fmt::format("divergence, which grows by {:.4g} 1/s", root.real())
                                        : fmt::format("{:.5g} Hz with damping {:.4g} at V/(f D) = {:.4g}",
                                                      frequency, flow::damping_of(root), reduced);
    std::string text =
        fmt::format("{}: fluidelastic law, without contacts: {}; {}", of.name, motion, crossing);
    if (unstable)
      text += ": unstable, supports must limit the motion";
    (unstable ? out.warnings : out.notes).push_back(std::move(text));
    if (const auto& range = of.law.range;
        range && unstable && !diverges && (reduced < (*range)[0] || reduced > (*range)[1]))
      out.warnings.push_back(
          fmt::format("{}: reduced velocity {:.4g} of the unstable mode is outside the law's range "
                      "{:g} to {:g}; the law is extrapolated",
                      of.name, reduced, (*range)[0], (*range)[1]));
  }
}

void judge_amplitudes(const TubesInFlow& tubes, const std::vector<PlacedContact>& placed,
                      const std::vector<NamedNode>& nodes, results::RunResults& out) {
  constexpr double linear = 0.1; // of the diameter
  const auto amplitude = [](const post::Moments& m) { return std::max(m.max - m.mean, m.mean - m.min); };
  for (const TubesOfLaw& of : tubes_of_laws(tubes, out.bases)) {
    const auto has = [&](core::Index node) {
      return std::any_of(of.structures.begin(), of.structures.end(),
                         [&](std::size_t s) { return out.bases[s].row_of(node) >= 0; });
    };
    double largest = 0.0;
    std::string where;
    const auto look = [&](const std::string& name, core::Index node, const post::Moments& moments) {
      if (amplitude(moments) > largest && has(node)) {
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
    const double diameter = fastest(of).diameter;
    if (diameter > 0.0 && !(largest <= linear * diameter))
      out.warnings.push_back(
          fmt::format("{}: {} moves by {:.3g} m about its mean, {:.2g} of the diameter: the fluidelastic law "
                      "is linear, good to "
                      "some {:g} of it; amplitudes, forces and work rates are not to be trusted",
                      of.name, where, largest, largest / diameter, linear));
  }
}

void add_motion_forces(const std::vector<FluidForces>& by_laws, const std::vector<std::size_t>& structures,
                       const std::vector<modal::Basis>& bases, transient::System& system) {
  std::vector<Index> first(bases.size(), -1); // of the modes in the system
  Index mode = 0;
  for (const std::size_t s : structures) {
    first[s] = mode;
    mode += bases[s].size();
  }
  core::MotionForces& to = system.motion;
  for (const FluidForces& law : by_laws) {
    if (first[law.structures.front()] < 0)
      continue; // of another scene
    std::vector<Index> modes;
    for (const std::size_t s : law.structures)
      for (Index j = 0; j < bases[s].size(); ++j)
        modes.push_back(first[s] + j);
    if (to.empty())
      to.stiffness = to.damping = Eigen::MatrixXd::Zero(mode, mode);
    const core::MotionForces& f = law.forces;
    const Index before = to.states(), r = f.states(), all = before + r;
    const auto states = Eigen::seqN(before, r);
    to.input.conservativeResizeLike(Eigen::MatrixXd::Zero(mode, all));
    to.rates.conservativeResizeLike(Eigen::MatrixXd::Zero(all, all));
    to.output.conservativeResizeLike(Eigen::MatrixXd::Zero(all, mode));
    to.stiffness(modes, modes) = f.stiffness;
    to.damping(modes, modes) = f.damping;
    to.input(modes, states) = f.input;
    to.rates(states, states) = f.rates;
    to.output(states, modes) = f.output;
  }
}

} // namespace fretwork::app
