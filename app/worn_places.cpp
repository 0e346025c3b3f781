// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/worn_places.hpp"
#include "app/worn_geometry.hpp"
#include "contact/sides.hpp"
#include "core/error.hpp"
#include "core/names.hpp"
#include "wear/coefficients.hpp"
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <numbers>
#include <set>
#include <tuple>

namespace fretwork::app {
namespace {

/// Local axes of the contacts of one support agree up to this, a small part of a sector (rad).
constexpr double same_axes = 0.01;

/// Contacts by support, in the order of the contacts.
using Supports = std::vector<std::pair<std::string, std::vector<std::size_t>>>;

Supports all_supports(const std::vector<PlacedContact>& placed) {
  Supports out;
  for (std::size_t c = 0; c < placed.size(); ++c) {
    const std::string& name = placed[c].support;
    if (out.empty() || out.back().first != name)
      out.emplace_back(name, std::vector<std::size_t>{});
    out.back().second.push_back(c);
  }
  return out;
}

/// Whether a pattern names a contact that does nothing, or points of it.
bool fits_inactive(const study::Study& study, const std::string& pattern) {
  return std::any_of(study.contacts.begin(), study.contacts.end(), [&](const study::Contact& contact) {
    return (!contact.active &&
            (core::fits(contact.name, pattern) || pattern.starts_with(contact.name + "["))) ||
           std::any_of(contact.inactive.begin(), contact.inactive.end(),
                       [&](const std::string& support) { return core::fits(support, pattern); });
  });
}

/// The entry of every support, -1 for those that do not wear.
std::vector<int> entries_of(const study::Study& study, const std::vector<PlacedContact>& placed,
                            const Supports& supports) {
  std::vector<int> entry_of(supports.size(), -1);
  std::set<std::string> names;
  for (const auto& [name, contacts] : supports) {
    names.insert(name);
    names.insert(study.contacts[placed[contacts.front()].entry].name);
  }
  for (std::size_t e = 0; e < study.wear.size(); ++e)
    for (const std::string& pattern : study.wear[e].contacts) {
      bool found = fits_inactive(study, pattern);
      for (std::size_t s = 0; s < supports.size(); ++s) {
        const std::string& contact = study.contacts[placed[supports[s].second.front()].entry].name;
        if (!core::fits(supports[s].first, pattern) && !core::fits(contact, pattern))
          continue;
        found = true;
        if (entry_of[s] >= 0 && entry_of[s] != static_cast<int>(e))
          throw core::Error(fmt::format("{} and {}: both name the contact \"{}\"; name it in one of them",
                                        study.wear[static_cast<std::size_t>(entry_of[s])].path,
                                        study.wear[e].path, supports[s].first));
        entry_of[s] = static_cast<int>(e);
      }
      if (!found)
        throw core::Error(fmt::format("{}: no contact fits \"{}\"{}", study.wear[e].path, pattern,
                                      core::name_help(pattern, {names.begin(), names.end()})));
    }
  for (std::size_t e = 0; e < study.wear.size(); ++e)
    if (study.wear[e].contacts.empty())
      std::replace(entry_of.begin(), entry_of.end(), -1, static_cast<int>(e));
  return entry_of;
}

/// The law of the tube with its coefficient, and where that is from.
std::pair<wear::Law, std::string> law_of(const study::Wear& entry, const wear::Pairing& pairing) {
  wear::Law law = entry.law;
  if (std::holds_alternative<wear::EdfMz>(law))
    return {law, "constants of the law"};
  if (!entry.materials)
    return {law, results::given_source};
  const auto* shared = std::get_if<wear::SharedScar>(&pairing);
  const std::string geometry_class = entry.coefficient_class.value_or(
      std::string(shared ? wear::coefficient_class(shared->geometry) : "drilled_hole"));
  const wear::Coefficient& found = wear::coefficient(geometry_class, *entry.materials);
  if (auto* archard = std::get_if<wear::Archard>(&law))
    archard->coefficient = found.value;
  else
    std::get<wear::KwuEpri>(law).coefficient = found.value;
  return {law, fmt::format("{} on {}: {}", found.materials, found.geometry, found.source)};
}

wear::Law support_law(const study::Wear& entry) {
  if (std::holds_alternative<wear::KwuEpri>(entry.law))
    return wear::KwuEpri{entry.support_coefficient};
  return wear::Archard{entry.support_coefficient};
}

void set_facts(const study::Wear& entry, WornPlace& place) {
  results::WearOfSupport& facts = place.facts;
  facts.name = place.name;
  for (const std::size_t c : place.contacts)
    facts.contacts.push_back(static_cast<std::int64_t>(c));
  facts.law = wear::name_of(place.worn.tube);
  facts.source = place.source;
  facts.coefficient = results::no_value;
  if (const auto* archard = std::get_if<wear::Archard>(&place.worn.tube))
    facts.coefficient = archard->coefficient;
  if (const auto* kwu = std::get_if<wear::KwuEpri>(&place.worn.tube))
    facts.coefficient = kwu->coefficient;
  facts.support_coefficient = entry.support_coefficient;
  set_geometry(place.worn.pairing, facts);
  facts.wall = place.worn.wall;
  facts.limit = place.worn.limit * place.worn.wall;
  facts.support_limit = place.worn.support_limit.value_or(results::no_value);
}

/// Quarter turns about x_loc, 0 to 3, by which the local axes of a contact are turned from those of another; nothing: by something else.
std::optional<std::size_t> quarter_turns(const PlacedContact& from, const PlacedContact& to) {
  const auto turned = (from.frame.rotation() * to.frame.rotation().transpose()).eval();
  const double angle = std::atan2(turned(2, 1), turned(1, 1)), quarter = 0.5 * std::numbers::pi;
  const auto turns = static_cast<int>(std::nearbyint(angle / quarter));
  const Eigen::Matrix3d exact =
      Eigen::AngleAxisd(turns * quarter, Eigen::Vector3d::UnitX()).toRotationMatrix();
  if (!turned.isApprox(exact, same_axes))
    return {};
  return static_cast<std::size_t>((turns + 4) % 4);
}

/// Angles are counted in the local axes of the first contact of a support, which the others share or, at flat faces, have turned by quarters
/// about x_loc: bars on several sides, one a contact. @return the quarter turns of each contact
std::vector<std::size_t> turns_of(const wear::Pairing& pairing, const std::vector<PlacedContact>& placed,
                                  const std::vector<std::size_t>& contacts) {
  const auto* shared = std::get_if<wear::SharedScar>(&pairing);
  const bool flat = shared && std::holds_alternative<wear::FlatBar>(shared->geometry);
  const PlacedContact& first = placed[contacts.front()];
  const auto has_sides = [&](std::size_t c) { // of the names that quarter turns permute
    const contact::Obstacle& obstacle = placed[c].obstacle;
    return !contact::sides_of(obstacle).empty() && contact::facet_normals(obstacle).empty();
  };
  const bool all_sides = std::all_of(contacts.begin(), contacts.end(), has_sides);
  std::vector<std::size_t> out;
  for (const std::size_t c : contacts) {
    const std::optional<std::size_t> turns = quarter_turns(first, placed[c]);
    if (!turns || (*turns != 0 && !(flat && all_sides)))
      throw core::Error(fmt::format(
          "\"{}\" and \"{}\" have different local axes, in which the angles of one support are counted; give "
          "them the same axis and y_axis (flat bars and planes: or turned by 90, 180 or 270 degrees), or "
          "leave "
          "one_support out",
          first.name, placed[c].name));
    out.push_back(*turns);
  }
  return out;
}

/// Whether two holes have their lands at the same angles.
bool same_lands(const contact::BroachedHole& a, const contact::BroachedHole& b) {
  return a.lands == b.lands && a.orientation == b.orientation;
}

/// Whether two polygons have the same facets, or neither has any.
bool same_facets(const contact::Obstacle& a, const contact::Obstacle& b) {
  constexpr double same_direction = 1e-6; // rad
  const auto ours = contact::facet_normals(a), theirs = contact::facet_normals(b);
  return std::equal(
      ours.begin(), ours.end(), theirs.begin(), theirs.end(),
      [&](const auto& n, const auto& m) { return std::hypot(n.y - m.y, n.z - m.z) < same_direction; });
}

/// Whether a contact has surfaces of the kind that the geometry wears one by one: flat faces, or facets or lands at the angles of the first. The
/// reference form of lands is that of all lands together.
bool wears_by_side(const wear::Pairing& pairing, const contact::Obstacle& obstacle,
                   const contact::Obstacle& first) {
  const auto* shared = std::get_if<wear::SharedScar>(&pairing);
  if (!shared)
    return false;
  const auto *hole = std::get_if<contact::BroachedSpace>(&obstacle),
             *first_hole = std::get_if<contact::BroachedSpace>(&first);
  if (std::holds_alternative<wear::FlatBar>(shared->geometry))
    return !hole && same_facets(obstacle, first);
  return std::holds_alternative<wear::Lands>(shared->geometry) && shared->form == wear::Form::exact && hole &&
         first_hole && same_lands(hole->hole(), first_hole->hole());
}

/// The sides of a support that wear each by itself, where there are several.
/// @param turns  quarter turns of each contact from the axes of the first
std::vector<WornSide> sides_of(const wear::Pairing& pairing, const std::vector<PlacedContact>& placed,
                               const std::vector<std::size_t>& contacts,
                               const std::vector<std::size_t>& turns) {
  std::map<std::size_t, WornSide> sides; // by number
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    const std::size_t c = contacts[k];
    const contact::Obstacle& obstacle = placed[c].obstacle;
    const std::vector<contact::Side> own = contact::sides_of(obstacle);
    if (own.empty() || !wears_by_side(pairing, obstacle, placed[contacts.front()].obstacle))
      return {};
    for (const contact::Side& side : own) {
      const std::size_t number = turns[k] == 0 ? side.number : (side.number + turns[k]) % 4;
      WornSide& worn = sides[number];
      worn.name = turns[k] == 0 ? side.name : contact::flat_side_names[number];
      worn.parts.push_back({c, own.size() > 1 ? std::optional(side.number) : std::nullopt});
    }
  }
  std::vector<WornSide> out;
  for (auto& side : sides)
    out.push_back(std::move(side.second));
  return out.size() > 1 ? out : std::vector<WornSide>{};
}

/// What scars have lost before, by the shares of the entry.
void set_initial_depths(const study::Wear& entry, WornPlace& place) {
  const double wall = place.worn.wall;
  place.worn.initial_depth = entry.initial_wear * wall;
  std::vector<std::string> names;
  for (WornSide& side : place.sides) {
    const auto own = entry.initial_wear_of.find(side.name);
    side.initial_depth = wall * (own == entry.initial_wear_of.end() ? entry.initial_wear : own->second);
    names.push_back(side.name);
  }
  for (const auto& [side, share] : entry.initial_wear_of)
    if (std::find(names.begin(), names.end(), side) == names.end())
      throw core::Error(
          names.empty() ? fmt::format("initial_wear.{}: there is one scar and no side \"{}\"; give a number",
                                      side, side)
                        : fmt::format("initial_wear.{}: there is no side \"{}\"{}", side, side,
                                      core::name_help(side, names)));
}

/// Results are filed under the names of supports.
void check_names(const study::Study& study, const std::vector<WornPlace>& places) {
  std::set<std::string> names;
  for (const WornPlace& place : places)
    if (!names.insert(place.name).second)
      throw core::Error(fmt::format("{}: a second support called \"{}\"; give the entry another name",
                                    study.wear[place.entry].path, place.name));
}

WornPlace place_of(const study::Study& study, const fem::Model& model,
                   const std::vector<PlacedContact>& placed, std::size_t e, const std::string& name,
                   const std::vector<std::size_t>& contacts) {
  const study::Wear& entry = study.wear[e];
  try {
    const PlacedContact& first = placed[contacts.front()];
    const study::Contact& contact = study.contacts[first.entry];
    const WornGeometry geometry = worn_geometry(entry, contact, first, model);
    WornPlace place{name, e, contacts, {}, {}, {}, {}, turns_of(geometry.pairing, placed, contacts)};
    place.worn.pairing = geometry.pairing;
    place.worn.wall = geometry.wall;
    place.sides = sides_of(place.worn.pairing, placed, contacts, place.turns);
    set_initial_depths(entry, place);
    place.worn.limit = entry.limit;
    place.worn.support_limit = entry.support_limit;
    std::tie(place.worn.tube, place.source) = law_of(entry, place.worn.pairing);
    place.worn.support = support_law(entry);
    wear::check(place.worn);
    set_facts(entry, place);
    place.facts.node = first.node;
    return place;
  } catch (const core::Error& error) {
    throw core::Error(fmt::format("{}, contact \"{}\": {}", entry.path, name, error.what()));
  }
}

} // namespace

std::vector<WornPlace> worn_places(const study::Study& study, const fem::Model& model,
                                   const std::vector<PlacedContact>& placed) {
  const Supports supports = all_supports(placed);
  const std::vector<int> entry_of = entries_of(study, placed, supports);
  std::vector<WornPlace> out;
  for (std::size_t e = 0; e < study.wear.size(); ++e) {
    std::vector<std::size_t> together;
    for (std::size_t s = 0; s < supports.size(); ++s) {
      if (entry_of[s] != static_cast<int>(e))
        continue;
      if (study.wear[e].one_support)
        together.insert(together.end(), supports[s].second.begin(), supports[s].second.end());
      else
        out.push_back(place_of(study, model, placed, e, supports[s].first, supports[s].second));
    }
    if (!together.empty())
      out.push_back(place_of(study, model, placed, e, study.wear[e].name, together));
  }
  std::stable_sort(out.begin(), out.end(), [](const WornPlace& a, const WornPlace& b) {
    return a.contacts.front() < b.contacts.front();
  });
  check_names(study, out);
  return out;
}

WatchedWear watched_wear(const study::Study& study, const std::vector<WornPlace>& places,
                         std::size_t contacts) {
  WatchedWear out;
  for (const WornPlace& place : places) {
    out.sectors.resize(contacts, 0);
    out.maxima.resize(contacts);
    const study::Wear& entry = study.wear[place.entry];
    for (const std::size_t c : place.contacts) {
      out.sectors[c] = entry.sectors;
      if (entry.kwu_maxima.force > 0.0)
        out.maxima[c] = entry.kwu_maxima;
    }
  }
  return out;
}

} // namespace fretwork::app
