// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/modes_limit.hpp"
#include "core/error.hpp"
#include "fem/beam_constants.hpp"
#include "modal/impact_modes.hpp"
#include "modal/spans.hpp"
#include "transient/signals/time_function.hpp"
#include <algorithm>
#include <fmt/format.h>
#include <map>
#include <numbers>

namespace fretwork::app {
namespace {

using core::Index;

constexpr double two_pi = 2.0 * std::numbers::pi;

/// What a node of a contact is on. Of several beams the one of the largest receptance.
struct Site {
  int beams = 0;        ///< with mass
  double bending = 0.0; ///< N m2, of the softer plane
  double mass = 0.0;    ///< kg/m
  double span = 0.0;    ///< m

  [[nodiscard]] double receptance() const {
    return beams > 0 ? modal::point_receptance(bending, mass,
                                               beams > 1 ? modal::BeamPoint::interior : modal::BeamPoint::end)
                     : 0.0;
  }
};

using Sites = std::map<Index, Site>; ///< by node

void add_beams(const fem::Model& model, Sites& sites) {
  for (const fem::Beam& beam : model.beams)
    for (const auto& [node, along] : {std::pair{beam.a, beam.along[0]}, std::pair{beam.b, beam.along[1]}}) {
      const auto found = sites.find(node);
      if (found == sites.end())
        continue;
      const fem::BeamConstants c =
          fem::beam_constants(model.properties[static_cast<std::size_t>(beam.property)], along);
      const double bending = std::min(c.bending_y, c.bending_z), mass = c.mass_transverse;
      if (!(mass > 0.0))
        continue;
      Site& site = found->second;
      if (++site.beams == 1 ||
          modal::point_receptance(bending, mass, modal::BeamPoint::interior) >
              modal::point_receptance(site.bending, site.mass, modal::BeamPoint::interior)) {
        site.bending = bending;
        site.mass = mass;
      }
    }
}

void add_spans(const fem::Model& model, Sites& sites) {
  for (const fem::Structure& structure : fem::structures(model)) {
    std::vector<Index> nodes;
    for (const Index node : structure.nodes)
      if (sites.contains(node))
        nodes.push_back(node);
    if (nodes.empty())
      continue;
    const std::vector<double> lengths = modal::span_lengths(model, structure, nodes);
    for (std::size_t i = 0; i < nodes.size(); ++i)
      sites[nodes[i]].span = lengths[i];
  }
}

Sites sites_of(const fem::Model& model, const std::vector<PlacedContact>& placed) {
  Sites sites;
  for (const PlacedContact& contact : placed)
    for (const Index node : {contact.node, contact.other})
      if (node >= 0)
        sites.try_emplace(node);
  add_beams(model, sites);
  add_spans(model, sites);
  return sites;
}

bool has_static_modes(const study::Modes& modes) { return modes.static_modes == study::StaticModes::added; }

} // namespace

results::ModesLimit modes_limit(const study::Study& study, const fem::Model& model,
                                const std::vector<PlacedContact>& placed) {
  const double accuracy = *study.modes.accuracy;
  const Sites sites = sites_of(model, placed);
  results::ModesLimit limit;
  limit.accuracy = accuracy;
  for (const PlacedContact& contact : placed) {
    std::vector<Site> sites_of_contact;
    double receptance = 0.0;
    for (const Index node : {contact.node, contact.other})
      if (node >= 0 && sites.at(node).beams > 0) {
        sites_of_contact.push_back(sites.at(node));
        receptance += sites_of_contact.back().receptance();
      }
    for (const Site& site : sites_of_contact) {
      const double frequency = modal::contact_frequency(contact.normal_stiffness, receptance);
      const double span = modal::clamped_span_frequency(site.span, site.bending, site.mass);
      const double up_to =
          modal::modes_needed_up_to(frequency, span, accuracy, has_static_modes(study.modes)) / two_pi;
      if (up_to > limit.up_to) {
        limit.up_to = up_to;
        limit.contact = contact.name;
        limit.contact_frequency = frequency / two_pi;
      }
    }
  }
  if (!(limit.up_to > 0.0))
    throw core::Error(fmt::format("modes.accuracy = {:g}: no contact is at a beam with mass, whose waves "
                                  "would say which modes matter; give modes.count or modes.up_to_hz",
                                  accuracy));
  return limit;
}

void report_modes_limit(const study::Study& study, const results::ModesLimit& limit,
                        results::RunResults& out) {
  const bool residual = has_static_modes(study.modes);
  out.notes.push_back(fmt::format(
      "modes up to {:.4g} Hz for contact forces within modes.accuracy = {:g}: contact \"{}\" on its beams "
      "vibrates at {:.4g} Hz, {:.3g} times that is needed{}, and a mode of its span beyond",
      limit.up_to, limit.accuracy, limit.contact, limit.contact_frequency,
      modal::contact_frequencies_needed(limit.accuracy, residual), residual ? " with static modes" : ""));
  double fastest = 0.0;
  for (const study::Load& load : study.loads)
    fastest = std::max(fastest, transient::highest_frequency(load.function));
  for (const study::BaseMotion& motion : study.base_motions)
    fastest = std::max(fastest, transient::highest_frequency(motion.acceleration));
  for (const study::SupportMotion& motion : study.support_motions)
    fastest = std::max(fastest, transient::highest_frequency(motion.function));
  if (fastest > limit.up_to)
    out.warnings.push_back(fmt::format("loads or supports shake with up to {:.4g} Hz, faster than the modes "
                                       "that modes.accuracy = {:g} takes "
                                       "for the contacts, {:.4g} Hz; give modes.up_to_hz instead",
                                       fastest, limit.accuracy, limit.up_to));
}

} // namespace fretwork::app
