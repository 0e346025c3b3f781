// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/fluidelastic.hpp"
#include "app/tubes_of_laws.hpp"
#include "core/error.hpp"
#include "results/flow_text.hpp"
#include <algorithm>
#include <fmt/format.h>
#include <numbers>

namespace fretwork::app {
namespace {

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
    if (const Eigen::Index size = 2 * of.modes + forces(1.0).states(); size > most_searched)
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
      const Eigen::Index first = of.tubes[i].first, n = of.tubes[i].sampling.modes();
      if (n == 0 || !out.modes[static_cast<std::size_t>(first)].tube.empty())
        continue; // a second tube of a structure
      const Eigen::VectorXd w = 2.0 * std::numbers::pi * of.tubes[i].sampling.frequency;
      k.segment(first, n) = w.cwiseAbs2();
      c.segment(first, n) = 2.0 * ratios[of.flows[i]].head(n).cwiseProduct(w);
      const auto& connors = its.stability.cases[results::worst_case(its.stability)];
      for (Eigen::Index mode = 0; mode < n; ++mode)
        out.modes[static_cast<std::size_t>(first + mode)] = {its.damping.tube, mode,
                                                             1.0 / connors.ratio(mode)};
    }
    out.diagram = flow::stability_diagram(k, c, forces, factors_of(assessment));
    found[of.flows.front()].law = std::move(out);
  }
}

void add_motion_forces(const std::vector<FluidForces>& by_laws, const std::vector<std::size_t>& structures,
                       const std::vector<modal::Basis>& bases, vibration::System& system) {
  std::vector<Eigen::Index> first(bases.size(), -1); // of the modes in the system
  Eigen::Index mode = 0;
  for (const std::size_t s : structures) {
    first[s] = mode;
    mode += bases[s].size();
  }
  core::MotionForces& to = system.motion;
  for (const FluidForces& law : by_laws) {
    if (first[law.structures.front()] < 0)
      continue; // of another scene
    std::vector<Eigen::Index> modes;
    for (const std::size_t s : law.structures)
      for (Eigen::Index j = 0; j < bases[s].size(); ++j)
        modes.push_back(first[s] + j);
    if (to.empty())
      to.stiffness = to.damping = Eigen::MatrixXd::Zero(mode, mode);
    const core::MotionForces& f = law.forces;
    const Eigen::Index before = to.states(), r = f.states(), all = before + r;
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
