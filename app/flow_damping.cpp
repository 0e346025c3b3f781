// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/flow_damping.hpp"
#include "core/error.hpp"
#include "core/names.hpp"
#include "modal/damping.hpp"
#include <algorithm>
#include <fmt/format.h>
#include <map>

namespace fretwork::app {

using core::Index;

std::optional<double> abscissa_of(const flow::Tube& tube, Index node) {
  for (const flow::Tube::Element& element : tube.elements()) {
    if (element.first == node)
      return element.from;
    if (element.second == node)
      return element.to;
  }
  return std::nullopt;
}

namespace {

constexpr std::size_t most_named_supports = 6;

bool has_contact(const std::vector<PlacedContact>& contacts, Index node) {
  return std::any_of(contacts.begin(), contacts.end(), [node](const PlacedContact& contact) {
    return contact.node == node || contact.other == node;
  });
}

std::vector<flow::TubeSupport> listed_supports(const TubesInFlow& tubes, const study::Flow& flow,
                                               const flow::Tube& tube,
                                               const std::vector<PlacedContact>& contacts,
                                               const std::vector<PlacedContact>& left_out) {
  std::vector<flow::TubeSupport> out;
  for (const study::FlowSupport& support : *flow.supports)
    for (const Index node : mesh::group_nodes(tubes.mesh, support.group, name_of(flow) + ", supports")) {
      const auto s = abscissa_of(tube, node);
      if (!s)
        throw core::Error(fmt::format(
            "{}: support \"{}\" has a node at {} that is not on the tube; name points "
            "of the tube",
            name_of(flow), support.group, fem::place(tubes.model.nodes[static_cast<std::size_t>(node)])));
      const bool contact = has_contact(contacts, node);
      if (contact || !has_contact(left_out, node))
        out.push_back({*s, support.length, contact});
    }
  return out;
}

/// One for each node: of several contacts at a node the longest.
std::vector<flow::TubeSupport> supports_by_contacts(const study::Study& study, const flow::Tube& tube,
                                                    const std::vector<PlacedContact>& contacts) {
  std::map<double, double> lengths; // by abscissa
  for (const PlacedContact& contact : contacts)
    for (const Index node : {contact.node, contact.other})
      if (const auto s = node >= 0 ? abscissa_of(tube, node) : std::nullopt) {
        double& length = lengths[*s];
        length = std::max(length, study.contacts[contact.entry].thickness);
      }
  std::vector<flow::TubeSupport> out;
  for (const auto& [s, length] : lengths)
    out.push_back({s, length, true});
  return out;
}

/// Names of the entries of [[contacts]] at supports without a length.
std::vector<std::string> entries_at(const study::Study& study, const flow::Tube& tube,
                                    const std::vector<flow::TubeSupport>& supports,
                                    const std::vector<PlacedContact>& contacts) {
  const auto is_without = [&](double s) {
    return std::any_of(supports.begin(), supports.end(),
                       [&](const flow::TubeSupport& one) { return one.s == s && one.length == 0.0; });
  };
  std::vector<std::string> out;
  for (const PlacedContact& contact : contacts)
    for (const Index node : {contact.node, contact.other})
      if (const auto s = node >= 0 ? abscissa_of(tube, node) : std::nullopt;
          s && is_without(*s) &&
          std::find(out.begin(), out.end(), study.contacts[contact.entry].name) == out.end())
        out.push_back(study.contacts[contact.entry].name);
  return out;
}

/// Ratios of one structure, from the tubes in it.
struct Mixture {
  Eigen::VectorXd weighted, shares;
  double structural = 0.0; ///< of the modes that move no tube across

  [[nodiscard]] std::vector<double> ratios() const {
    std::vector<double> out;
    for (Eigen::Index i = 0; i < shares.size(); ++i)
      out.push_back(shares(i) >= flow::least_transverse_share ? weighted(i) / shares(i) : structural);
    return out;
  }
};

} // namespace

std::vector<flow::TubeSupport> supports_of(const TubesInFlow& tubes, const PlacedFlow& placed,
                                           const flow::Tube& tube, const std::vector<PlacedContact>& contacts,
                                           const std::vector<PlacedContact>& left_out) {
  const study::Flow& flow = tubes.study.flows[placed.entry];
  return flow.supports ? listed_supports(tubes, flow, tube, contacts, left_out)
                       : supports_by_contacts(tubes.study, tube, contacts);
}

bool are_damped_by_supports(const study::Study& study) {
  return study.modes.flow_damping ||
         std::any_of(study.stabilities.begin(), study.stabilities.end(), [](const study::Stability& one) {
           return !one.damping && one.pinned != study::Pinned::none;
         });
}

std::vector<std::string> supports_without_length(const TubesInFlow& tubes,
                                                 const std::vector<PlacedContact>& contacts) {
  std::vector<std::string> out;
  for (const PlacedFlow& placed : tubes.flows) {
    const study::Flow& flow = tubes.study.flows[placed.entry];
    if (flow.supports)
      continue;
    const flow::Tube tube = tube_of(tubes.study, placed, tubes.model);
    const auto supports = supports_by_contacts(tubes.study, tube, contacts);
    const auto without = std::count_if(supports.begin(), supports.end(),
                                       [](const flow::TubeSupport& one) { return one.length == 0.0; });
    if (without > 0)
      out.push_back(fmt::format(
          "{}: {} of {} supports have no length ({}), and so no damping by squeeze film and "
          "friction; give the flow supports = [{{ group, length }}, ...], or these contacts a thickness",
          name_of(flow), without, supports.size(),
          core::list_names(entries_at(tubes.study, tube, supports, contacts), most_named_supports)));
  }
  return out;
}

std::size_t structure_of(const PlacedFlow& placed, const std::string& name,
                         const std::vector<modal::Basis>& bases) {
  const auto found = modal::structure_of(bases, placed.start);
  if (!found)
    throw core::Error(fmt::format("flow \"{}\": the tube cannot move; release it in [[restraints]]", name));
  return *found;
}

results::TubeDamping damping_of_tube(const TubesInFlow& tubes, const PlacedFlow& placed,
                                     const flow::Tube& tube, const flow::Sampling& sampling,
                                     std::span<const flow::TubeSupport> supports, const std::string& what) {
  const study::Flow& flow = tubes.study.flows[placed.entry];
  results::TubeDamping out;
  out.tube = flow.name;
  for (const flow::Zone& zone : placed.profile.zones())
    out.zones.push_back(zone.name);
  out.length = placed.length;
  out.frequency = sampling.frequency;
  out.damping = flow::damping(tube, placed.profile, sampling, supports,
                              {flow.structural_damping, flow.void_fraction, std::nullopt});
  out.limits = limit_notes(what, out.damping.limits, placed.profile);
  return out;
}

std::vector<results::TubeDamping> damp_by_flow(const TubesInFlow& tubes, DampingSet set,
                                               const std::vector<PlacedContact>& contacts,
                                               const std::vector<PlacedContact>& left_out,
                                               std::vector<modal::Basis>& bases) {
  std::vector<results::TubeDamping> out;
  std::map<std::size_t, Mixture> mixtures;
  for (const PlacedFlow& placed : tubes.flows) {
    const study::Flow& flow = tubes.study.flows[placed.entry];
    const std::size_t structure = structure_of(placed, flow.name, bases);
    const flow::Tube tube = tube_of(tubes.study, placed, tubes.model);
    const flow::Sampling sampling = flow::sample(tube, placed.profile, bases[structure]);
    results::TubeDamping found = damping_of_tube(
        tubes, placed, tube, sampling, supports_of(tubes, placed, tube, contacts, left_out), name_of(flow));
    found.structure = structure;
    const Eigen::VectorXd share = flow::transverse_share(sampling);
    auto [mixture, fresh] = mixtures.try_emplace(structure);
    if (fresh)
      mixture->second = {Eigen::VectorXd::Zero(share.size()), Eigen::VectorXd::Zero(share.size()),
                         flow.structural_damping};
    mixture->second.weighted += share.cwiseProduct(set == DampingSet::stability ? found.damping.stability()
                                                                                : found.damping.transient());
    mixture->second.shares += share;
    out.push_back(std::move(found));
  }
  for (std::size_t s = 0; s < bases.size(); ++s) {
    const auto mixture = mixtures.find(s);
    if (mixture == mixtures.end())
      throw core::Error(
          fmt::format("modes.damping = \"flow\": the structure that starts at node {} has no [[flow]]; give "
                      "it one, or give "
                      "modes.damping ratios",
                      fem::place(tubes.model.nodes[static_cast<std::size_t>(bases[s].nodes.front())])));
    modal::apply_damping(bases[s], mixture->second.ratios());
  }
  return out;
}

} // namespace fretwork::app
