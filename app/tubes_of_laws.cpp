// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/tubes_of_laws.hpp"
#include "core/error.hpp"
#include <algorithm>
#include <fmt/format.h>
#include <utility>

namespace fretwork::app {
namespace {

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

} // namespace

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

TubesOfLaw lowest(TubesOfLaw of, const std::vector<modal::Basis>& bases, Eigen::Index most) {
  const std::vector<Eigen::Index> before = std::exchange(of.first, {});
  of.modes = 0;
  for (const std::size_t s : of.structures) {
    of.first.push_back(of.modes);
    of.modes += std::min(most, bases[s].true_modes());
  }
  for (flow::TubeOfLaw& tube : of.tubes) {
    const auto at = std::lower_bound(before.begin(), before.end(), tube.first) - before.begin();
    tube.first = of.first[static_cast<std::size_t>(at)];
    flow::Sampling& sampling = tube.sampling;
    const Eigen::Index n = std::min(most, sampling.modes());
    sampling.frequency.conservativeResize(n);
    sampling.modal_mass.conservativeResize(n);
    for (flow::Station& station : sampling.stations)
      station.shapes.conservativeResize(Eigen::NoChange, n);
  }
  return of;
}

Fastest fastest(const TubesOfLaw& of) {
  Fastest out;
  for (const flow::TubeOfLaw& tube : of.tubes)
    for (const flow::Station& station : tube.sampling.stations)
      if (station.flow.velocity > out.velocity)
        out = {station.flow.velocity, station.tube.outer_diameter};
  return out;
}

flow::ForcesOverFactor forces_of(const TubesOfLaw& of, double factor) {
  try {
    flow::ForcesOverFactor out = flow::forces_over_factor(of.tubes, of.law, of.modes, factor);
    (void)out(factor); // what it refuses
    return out;
  } catch (const core::Error& error) {
    throw core::Error(fmt::format("{}: {}", of.name, error.what()));
  }
}

} // namespace fretwork::app
