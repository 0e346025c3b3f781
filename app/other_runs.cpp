// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/other_runs.hpp"
#include "core/error.hpp"
#include "core/names.hpp"
#include "results/summary_file.hpp"
#include <algorithm>
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

/// Work rates of the contacts of another run; nothing where it has not been made.
std::optional<std::map<std::string, StatedRate>> read_run(const std::string& where,
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
  std::map<std::string, StatedRate> out;
  for (const auto& contact : contacts) {
    const nlohmann::json error = entry(contact, "standard_error");
    out[results::text_of(contact, "name")] = {number(entry(contact, "work_rate")),
                                              number(entry(error, "work_rate")),
                                              number(entry(error, "work_rate_batches"))};
  }
  return out;
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
      for (const std::size_t c : place.contacts)
        if (!rates->contains(placed[c].name))
          throw core::Error(fmt::format("{}.states[{}].results: the run in {} has no contact \"{}\"{}; name "
                                        "its contacts alike",
                                        study.wear[place.entry].path, j,
                                        study.wear[place.entry].states[j].results->string(), placed[c].name,
                                        core::name_help(placed[c].name, names)));
    }
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
      for (const auto& [name, rate] : rates.value_or(std::map<std::string, StatedRate>()))
        out += fmt::format("{} {:.17g} {:.17g} {:.17g}\n", name, rate.value, rate.error, rate.batches);
  return out;
}

} // namespace fretwork::app
