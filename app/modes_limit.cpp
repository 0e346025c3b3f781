// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/modes_limit.hpp"
#include "app/modal_truncation.hpp"
#include "core/error.hpp"
#include "fem/beam_constants.hpp"
#include "modal/impact_modes.hpp"
#include "modal/spans.hpp"
#include "signals/time_function.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
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

/// What a contact needs of the modes, Hz; 0: it is at no beam with mass.
struct Need {
  double up_to = 0.0, contact_frequency = 0.0;
};

Need need_of(const PlacedContact& contact, const Sites& sites, double accuracy, bool static_modes) {
  std::vector<Site> sites_of_contact;
  double receptance = 0.0;
  for (const Index node : {contact.node, contact.other})
    if (node >= 0 && sites.at(node).beams > 0) {
      sites_of_contact.push_back(sites.at(node));
      receptance += sites_of_contact.back().receptance();
    }
  Need need;
  for (const Site& site : sites_of_contact) {
    const double frequency = modal::contact_frequency(contact.normal_stiffness, receptance);
    const double span = modal::clamped_span_frequency(site.span, site.bending, site.mass);
    need.contact_frequency = frequency / two_pi;
    need.up_to =
        std::max(need.up_to, modal::modes_needed_up_to(frequency, span, accuracy, static_modes) / two_pi);
  }
  return need;
}

/// Of the contact that asks for most; `up_to` is 0 where none is at a beam with mass.
results::ModesLimit need_of_contacts(const Sites& sites, const std::vector<PlacedContact>& placed,
                                     double accuracy, bool static_modes) {
  results::ModesLimit limit;
  limit.accuracy = accuracy;
  for (const PlacedContact& contact : placed)
    if (const Need need = need_of(contact, sites, accuracy, static_modes); need.up_to > limit.up_to) {
      limit.up_to = need.up_to;
      limit.contact = contact.name;
      limit.contact_frequency = need.contact_frequency;
    }
  return limit;
}

/// How far the loads need modes.
struct LoadsReach {
  double up_to = 0.0; ///< Hz
  std::string why;
};

LoadsReach reach_of_loads(const study::Study& study, const std::vector<TurbulentLoad>& turbulence) {
  double highest = 0.0; // Hz, of everything whose frequencies are known
  for (const study::Load& load : study.loads)
    highest = std::max(highest, signals::highest_frequency(load.function));
  for (const study::BaseMotion& motion : study.base_motions)
    highest = std::max(highest, signals::highest_frequency(motion.acceleration));
  for (const study::SupportMotion& motion : study.support_motions)
    highest = std::max(highest, signals::highest_frequency(motion.function));
  LoadsReach reach{modes_above_loads * highest,
                   fmt::format("twice the highest frequency of loads and motions, {:.4g} Hz", highest)};
  for (const TurbulentLoad& load : turbulence)
    if (load.band.high > reach.up_to)
      reach = {load.band.high, fmt::format("as far as {} acts", load.name)};
  return reach;
}

/// Whether the study says how many modes it wants without the contacts.
bool says_how_many(const study::Modes& modes) { return modes.number_given && !modes.accuracy; }

/// Modes of a structure below a frequency, counted by the waves along its beams, of which a mode more fits in every half: bending in both
/// planes, stretch and twist.
double modes_below(const fem::Model& model, const fem::Structure& structure, double hertz) {
  const double w = two_pi * hertz;
  double phase = 0.0; // rad
  for (const Index i : structure.beams) {
    const fem::Beam& beam = model.beams[static_cast<std::size_t>(i)];
    const fem::BeamConstants c =
        fem::beam_constants(model.properties[static_cast<std::size_t>(beam.property)], beam.along[0]);
    const double length =
        (model.nodes[static_cast<std::size_t>(beam.b)] - model.nodes[static_cast<std::size_t>(beam.a)])
            .norm();
    phase += length * (std::sqrt(w) * (std::pow(c.mass_transverse / c.bending_y, 0.25) +
                                       std::pow(c.mass_transverse / c.bending_z, 0.25)) +
                       w * (std::sqrt(c.mass_axial / c.axial) + std::sqrt(c.inertia_x / c.torsion)));
  }
  return std::min(phase / std::numbers::pi, static_cast<double>(structure.equations));
}

/// The largest x between two ends of which something is true that is true of the lower end and of no x above some other; the upper end where it is
/// true of that.
template <class True> double last_true(double low, double high, True is_true) {
  constexpr int halvings = 50; // to 1e-15 of the interval
  if (is_true(high))
    return high;
  for (int i = 0; i < halvings; ++i)
    (is_true(0.5 * (low + high)) ? low : high) = 0.5 * (low + high);
  return low;
}

/// `by some 3.2 %`: the error of contact forces that modes up to a frequency leave.
std::string remaining_error(const Sites& sites, const std::vector<PlacedContact>& placed, double hertz,
                            bool static_modes) {
  constexpr double largest = 0.1; // that the rule is measured for
  const auto misses = [&](double accuracy) {
    return need_of_contacts(sites, placed, accuracy, static_modes).up_to > hertz;
  };
  if (misses(largest))
    return fmt::format("by more than {:g} %", 100.0 * largest);
  return fmt::format("by some {:.2g} %", 100.0 * last_true(default_modes_accuracy, largest, misses));
}

} // namespace

std::optional<results::ModesLimit> take_modes_limit(study::Study& study, const fem::Model& model,
                                                    const std::vector<PlacedContact>& placed,
                                                    const std::vector<TurbulentLoad>& turbulence) {
  study::Modes& modes = study.modes;
  if (says_how_many(modes))
    return std::nullopt;
  results::ModesLimit limit =
      need_of_contacts(sites_of(model, placed), placed, modes.accuracy.value_or(default_modes_accuracy),
                       has_static_modes(modes));
  if (!(limit.up_to > 0.0) && modes.accuracy)
    throw core::Error(fmt::format("modes.accuracy = {:g}: no contact is at a beam with mass, whose waves "
                                  "would say which modes matter; give modes.count or modes.up_to_hz",
                                  *modes.accuracy));
  if (!(limit.up_to > 0.0) && turbulence.empty())
    return std::nullopt;
  if (LoadsReach loads = reach_of_loads(study, turbulence); loads.up_to > limit.up_to) {
    limit.up_to = loads.up_to;
    limit.loads = std::move(loads.why);
  }
  modes.accuracy = limit.accuracy;
  modes.up_to_hz = limit.up_to;
  modes.count.reset();
  return limit;
}

std::string cap_default_modes(study::Study& study, const fem::Model& model,
                              const std::vector<PlacedContact>& placed, results::ModesLimit& limit) {
  if (study.modes.number_given)
    return {};
  const std::vector<fem::Structure> structures = fem::structures(model);
  const auto most = [&](double hertz) {
    double modes = 0.0;
    for (const fem::Structure& structure : structures)
      modes = std::max(modes, modes_below(model, structure, hertz));
    return modes;
  };
  const double asked = limit.up_to, needed = most(asked);
  if (needed <= most_default_modes)
    return {};
  limit.up_to = last_true(0.0, asked, [&](double hertz) { return most(hertz) <= most_default_modes; });
  limit.accuracy = std::numeric_limits<double>::quiet_NaN();
  study.modes.up_to_hz = limit.up_to;
  return fmt::format("modes: {} asks for modes up to {:.4g} Hz, some {:.0f} of one structure; the default "
                     "takes {} at most, up to "
                     "{:.4g} Hz{}; check stiffnesses and units, or ask for them by modes.accuracy, "
                     "modes.up_to_hz or modes.count",
                     limit.loads.empty() ? fmt::format("contact \"{}\"", limit.contact) : limit.loads, asked,
                     needed, most_default_modes, limit.up_to,
                     limit.contact.empty()
                         ? std::string()
                         : fmt::format(": forces of impacts may be wrong {}",
                                       remaining_error(sites_of(model, placed), placed, limit.up_to,
                                                       has_static_modes(study.modes))));
}

void report_modes_limit(const study::Study& study, const results::ModesLimit& limit,
                        results::RunResults& out) {
  const bool static_modes = has_static_modes(study.modes);
  const std::string chosen = study.modes.number_given ? "" : " (the default; modes.count takes a number)";
  if (limit.loads.empty())
    out.notes.push_back(
        fmt::format("modes up to {:.4g} Hz for contact forces within modes.accuracy = {:g}{}: contact \"{}\" "
                    "on its beams "
                    "vibrates at {:.4g} Hz, {:.3g} times that is needed{}, and a mode of its span beyond",
                    limit.up_to, limit.accuracy, chosen, limit.contact, limit.contact_frequency,
                    modal::contact_frequencies_needed(limit.accuracy, static_modes),
                    static_modes ? " with static modes" : ""));
  else if (limit.contact.empty())
    out.notes.push_back(fmt::format("modes up to {:.4g} Hz, {}{}", limit.up_to, limit.loads, chosen));
  else
    out.notes.push_back(
        fmt::format("modes up to {:.4g} Hz, {}: contact forces within modes.accuracy = {:g}{} need fewer",
                    limit.up_to, limit.loads, limit.accuracy, chosen));
}

std::string few_modes_warning(const study::Study& study, const fem::Model& model,
                              const std::vector<PlacedContact>& placed,
                              const std::vector<modal::Basis>& bases) {
  constexpr double accuracy = 0.1;  // the largest error for which the rule is measured
  constexpr double far_below = 0.5; // of a contact frequency: work rates are then wrong by tens of per cent
  if (study.modes.accuracy || !has_static_modes(study.modes))
    return {};
  const Sites sites = sites_of(model, placed);
  std::string worst;
  double most = 1.0, reach = 0.0;
  Need of_worst;
  for (const PlacedContact& contact : placed) {
    const Need need = need_of(contact, sites, accuracy, true);
    for (const modal::Basis& basis : bases) {
      const bool touches =
          basis.row_of(contact.node) >= 0 || (contact.other >= 0 && basis.row_of(contact.other) >= 0);
      const double end = touches ? end_of_modes(study.modes, basis) : need.up_to;
      if (end < far_below * need.contact_frequency && need.up_to > most * end) {
        most = need.up_to / end;
        worst = contact.name;
        reach = end;
        of_worst = need;
      }
    }
  }
  if (worst.empty())
    return {};
  return fmt::format(
      "modal truncation: the modes end at {:.4g} Hz; contact \"{}\" vibrates on its beams at {:.4g} Hz, and "
      "impacts within 10 % need modes up to {:.4g} Hz with static modes; work rates and forces may be wrong "
      "by tens of "
      "per "
      "cent, with very few modes by factors; {}",
      reach, worst, of_worst.contact_frequency, of_worst.up_to, more_modes(study));
}

} // namespace fretwork::app
