// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/other_runs.hpp"
#include "core/error.hpp"
#include "core/names.hpp"
#include "results/summary_file.hpp"
#include "results/write.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace fretwork::app {
namespace {

namespace fs = std::filesystem;

constexpr const char* summary_name = "summary.json";

/// What is not there, or of another type, as nothing: a summary is only as good as who wrote it.
nlohmann::json entry(const nlohmann::json& table, const char* key) {
  const auto found = table.is_object() ? table.find(key) : table.end();
  return found == table.end() ? nlohmann::json() : *found;
}

double number(const nlohmann::json& value) {
  return value.is_number() ? value.get<double>() : std::numeric_limits<double>::quiet_NaN();
}

bool is_folder(const fs::path& one, const fs::path& other) {
  return fs::weakly_canonical(one) == fs::weakly_canonical(other);
}

/// `work_rate` of a contact or of one of its sides.
StatedRate stated(const nlohmann::json& table) {
  const nlohmann::json error = entry(table, "standard_error");
  return {number(entry(table, "work_rate")), number(entry(error, "work_rate")),
          number(entry(error, "work_rate_batches"))};
}

/// Work rates of the contacts of another run; nothing where it has not been made.
std::optional<std::map<std::string, ContactRates>> read_run(const std::string& where,
                                                            const fs::path& directory) {
  const results::FoundSummary found = results::read_summary(directory / summary_name);
  if (!found.refusal.empty())
    throw core::Error(fmt::format("{}: {}; run that study again", where, found.refusal));
  const nlohmann::json& summary = found.summary;
  if (summary.is_null())
    return {};
  const nlohmann::json contacts = entry(summary, "contacts");
  if (!summary.contains("transient") || !contacts.is_array())
    throw core::Error(fmt::format("{}: {} holds no results of a transient; run that study again", where,
                                  directory.string()));
  if (results::text_of(summary["transient"], "outcome") != "done")
    throw core::Error(
        fmt::format("{}: the run in {} diverged; take a smaller step there", where, directory.string()));
  std::map<std::string, ContactRates> out;
  for (const auto& contact : contacts) {
    ContactRates rates{stated(contact), {}};
    const nlohmann::json sides = entry(contact, "sides");
    for (const auto& [name, own] : sides.items())
      if (const auto side = contact::side_number(name))
        rates.sides[*side] = stated(own);
    out[results::text_of(contact, "name")] = rates;
  }
  return out;
}

/// A contact of this study.
struct Here {
  const study::Contact& entry;
  const PlacedContact& placed;
  const fem::Model& model;
};

/// The beam at a node; null where none is.
const fem::Beam* beam_at(const std::vector<fem::Beam>& beams, core::Index node) {
  const auto found = std::find_if(beams.begin(), beams.end(),
                                  [&](const fem::Beam& beam) { return beam.a == node || beam.b == node; });
  return found == beams.end() ? nullptr : &*found;
}

/// What makes work rates those of something else: place, obstacle, section and material of the tube; empty where these are the same.
std::string other_structure(const results::RunResults& other, const results::ContactFacts& there,
                            const Here& here) {
  constexpr double same_place = 1e-6; // m, of meshes of one geometry
  if (!(there.point.place - here.placed.place).isZero(same_place))
    return fmt::format("is at {} there, at {} here", fem::place(there.point.place),
                       fem::place(here.placed.place));
  if (const std::string obstacle = study::name_of(here.entry.obstacle); there.obstacle != obstacle)
    return fmt::format("has the obstacle \"{}\" there, \"{}\" here", there.obstacle, obstacle);
  const fem::Beam *beam_there = beam_at(other.beams, there.node),
                  *beam_here = beam_at(here.model.beams, here.placed.node);
  if (!beam_there || !beam_here)
    return {};
  const fem::BeamProperty& property_there = other.properties[static_cast<std::size_t>(beam_there->property)];
  const fem::BeamProperty& property_here =
      here.model.properties[static_cast<std::size_t>(beam_here->property)];
  if (!(property_there.material == property_here.material))
    return fmt::format("is on a beam of {:g} Pa, {:g} kg/m3 there, of {:g} Pa, {:g} kg/m3 here",
                       property_there.material.young_modulus, property_there.material.density,
                       property_here.material.young_modulus, property_here.material.density);
  if (!(property_there.section == property_here.section))
    return fmt::format("is on a beam of another section there, of {:g} m2, here of {:g} m2",
                       property_there.section.area, property_here.section.area);
  return {};
}

/// What may be another one in another operating state; empty where nothing is.
std::string other_contact(const results::ContactFacts& there, const Here& here) {
  constexpr double round_off = 1e-9; // relative, of places of a mesh
  const auto differs = [](double a, double b) {
    return std::abs(a - b) > round_off * std::max(std::abs(a), std::abs(b));
  };
  if (const double gap = gap_of(here.placed, here.placed.obstacle); differs(there.gap, gap))
    return fmt::format("a gap of {:.4g} m there, {:.4g} m here", there.gap, gap);
  if (const double stiffness = here.placed.normal_stiffness * here.placed.share;
      differs(there.normal_stiffness, stiffness))
    return fmt::format("a normal stiffness of {:.4g} N/m there, {:.4g} N/m here", there.normal_stiffness,
                       stiffness);
  if (differs(there.friction_dynamic, here.entry.friction_dynamic))
    return fmt::format("friction {:g} there, {:g} here", there.friction_dynamic, here.entry.friction_dynamic);
  return {};
}

struct Differences {
  std::string structure; ///< what is of something else there; empty: nothing
  std::string laws;      ///< what may be another one in another operating state; empty: nothing
};

Differences differences(const results::RunResults& there, const Here& here) {
  const auto found = std::find_if(there.contacts.begin(), there.contacts.end(),
                                  [&](const auto& contact) { return contact.name == here.placed.name; });
  if (found == there.contacts.end())
    return {"is not in its results.h5", {}};
  return {other_structure(there, *found, here), other_contact(*found, here)};
}

std::string text_of(const StatedRate& rate) {
  return fmt::format(" {:.17g} {:.17g} {:.17g}", rate.value, rate.error, rate.batches);
}

std::string missing_text(const std::vector<std::string>& missing) {
  return fmt::format(
      "wear is not computed, its states have runs that have not been made: {}; make them first, each of "
      "this study with the flow of its state and -o with its folder",
      fmt::join(missing, ", "));
}

} // namespace

wear::WorkRate StatedRate::with(std::optional<double> confidence) const {
  return confidence ? wear::work_rate_with_confidence(value, error, batches, *confidence)
                    : wear::work_rate_with_error(value, error);
}

OtherRuns read_other_runs(const study::Study& study, const fs::path& folder) {
  OtherRuns out;
  std::vector<std::string> missing;
  for (const study::Wear& entry : study.wear) {
    auto& rates = out.rates.emplace_back();
    bool is_named = false, is_plain = false;
    for (std::size_t j = 0; j < entry.states.size(); ++j) {
      const study::WearState& state = entry.states[j];
      rates.emplace_back();
      if (!state.results) {
        is_plain = is_plain || !state.given;
        continue;
      }
      if (is_folder(*state.results, folder)) {
        is_named = true;
        continue;
      }
      const std::string where = fmt::format("{}.states[{}].results", entry.path, j);
      rates.back() = read_run(where, *state.results);
      if (!rates.back())
        missing.push_back(fmt::format("{} = \"{}\"", where, state.results->string()));
    }
    if (is_named && is_plain)
      out.is_state_of = entry.path;
  }
  if (!out.is_state_of.empty()) // its results do not depend on the other states
    for (auto& rates : out.rates)
      rates.assign(rates.size(), std::nullopt);
  else if (!missing.empty())
    out.missing = missing_text(missing);
  return out;
}

void check_contacts_of(const OtherRuns& others, const study::Study& study,
                       const std::vector<WornPlace>& places, const std::vector<PlacedContact>& placed) {
  for (const WornPlace& place : places)
    for (std::size_t j = 0; j < others.rates[place.entry].size(); ++j) {
      const auto& rates = others.rates[place.entry][j];
      if (!rates)
        continue;
      std::vector<std::string> names;
      for (const auto& contact : *rates)
        names.push_back(contact.first);
      const auto refuse = [&](const std::string& why) {
        throw core::Error(fmt::format("{}.states[{}].results: the run in {} {}", study.wear[place.entry].path,
                                      j, study.wear[place.entry].states[j].results->string(), why));
      };
      for (const std::size_t c : place.contacts) {
        const auto found = rates->find(placed[c].name);
        if (found == rates->end())
          refuse(fmt::format("has no contact \"{}\"{}; name its contacts alike", placed[c].name,
                             core::name_help(placed[c].name, names)));
      }
      for (const WornSide& side : place.sides)
        for (const WornSide::Part& part : side.parts)
          if (const PlacedContact& contact = placed[part.contact];
              part.side && !rates->at(contact.name).sides[*part.side])
            refuse(fmt::format("has no work of contact \"{}\" on its {}; make it from this study, with this "
                               "version",
                               contact.name, results::text_of_side(side.name)));
    }
}

std::vector<std::string> compare_with_other_runs(const OtherRuns& others, const study::Study& study,
                                                 const std::vector<WornPlace>& places,
                                                 const std::vector<PlacedContact>& placed,
                                                 const fem::Model& model) {
  std::map<fs::path, std::optional<results::RunResults>> set_ups;
  std::map<fs::path, std::string> warnings;
  for (const WornPlace& place : places)
    for (std::size_t j = 0; j < others.rates[place.entry].size(); ++j) {
      if (!others.rates[place.entry][j])
        continue;
      const study::Wear& entry = study.wear[place.entry];
      const fs::path& folder = *entry.states[j].results;
      const std::string where =
          fmt::format("{}.states[{}].results: the run in {}", entry.path, j, folder.string());
      if (!set_ups.contains(folder))
        set_ups[folder] = results::read_set_up(folder);
      if (!set_ups[folder]) {
        warnings.emplace(
            folder,
            where + " has no results.h5, which would say whether it is of this tube and these supports");
        continue;
      }
      for (const std::size_t c : place.contacts) {
        const Here here{study.contacts[placed[c].entry], placed[c], model};
        const Differences found = differences(*set_ups[folder], here);
        if (!found.structure.empty())
          throw core::Error(
              fmt::format("{} is of another structure: contact \"{}\" {}; make it from this study", where,
                          placed[c].name, found.structure));
        if (!found.laws.empty())
          warnings.emplace(folder,
                           fmt::format("{} differs from this study: contact \"{}\" has {}; its work rates "
                                       "are taken as they stand: run it again unless the state is meant so",
                                       where, placed[c].name, found.laws));
      }
    }
  std::vector<std::string> out;
  for (const auto& [folder, warning] : warnings)
    out.push_back(warning);
  return out;
}

void note_other_runs(const OtherRuns& others, results::RunResults& out) {
  if (!others.is_state_of.empty())
    out.notes.insert(out.notes.begin(),
                     fmt::format("this run is an operating state of {}: wear is computed by the run of its "
                                 "state without results",
                                 others.is_state_of));
  else if (!others.missing.empty())
    out.warnings.push_back(others.missing);
}

std::string text_of(const OtherRuns& others) {
  std::string out;
  for (const auto& states : others.rates)
    for (const auto& rates : states)
      for (const auto& [name, of_contact] : rates.value_or(std::map<std::string, ContactRates>())) {
        out += name + text_of(of_contact.total);
        for (const auto& side : of_contact.sides)
          out += side ? text_of(*side) : "";
        out += '\n';
      }
  return out;
}

} // namespace fretwork::app
