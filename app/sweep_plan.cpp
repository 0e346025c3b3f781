// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/sweep_plan.hpp"
#include "core/error.hpp"
#include "core/hash.hpp"
#include "core/names.hpp"
#include <filesystem>
#include <fmt/format.h>

namespace fretwork::app {
namespace {

namespace fs = std::filesystem;

fs::path directory_of(const Request& request) {
  return request.directory.value_or(
      fs::absolute(request.study).lexically_normal().replace_extension(".sweep"));
}

/// Listed texts may name files: what these hold is part of a case.
std::map<std::string, std::string> files_of(const study::Sweep& sweep, const fs::path& folder) {
  std::map<std::string, std::string> out;
  for (const study::SweepVariable& variable : sweep.variables)
    if (const auto* levels = std::get_if<study::SweepLevels>(&variable.source))
      for (const std::string& value : levels->values) {
        std::error_code absent;
        const fs::path file =
            folder / (value.size() > 2 && value.front() == '"' ? value.substr(1, value.size() - 2) : value);
        if (fs::is_regular_file(file, absent))
          out[value] = core::sha256_of_file(file.string(), 0);
      }
  return out;
}

} // namespace

SweepPlan read_sweep_plan(const SweepRequest& request) {
  SweepPlan plan;
  plan.inputs = read_inputs(request.request);
  plan.document = study::parse(request.request.study);
  plan.sweep = study::read_sweep(study::load(request.request.study, request.request.overrides));
  plan.directory = directory_of(request.request);
  plan.shard = request.shard.value_or(sweep::Shard{});
  plan.inputs.directory =
      plan.directory / "shards" / fmt::format("{}_of_{}", plan.shard.index, plan.shard.count);
  plan.files = files_of(plan.sweep, plan.document.file.parent_path());
  if (request.shard && request.gather)
    throw core::Error(
        "--shard computes a part of the cases, --gather makes the table of all parts; give one of them");
  if ((request.shard || request.gather) && plan.sweep.until)
    throw core::Error(
        "sweep.until decides by all cases, of which a shard has a part; leave until out and give "
        "draws, or run the sweep without --shard and --gather");
  if (!plan.inputs.study.transient)
    throw core::Error("the study has no [transient]; a sweep needs it (doc/study-file.md)");
  return plan;
}

std::string identity_of(const SweepPlan& plan, const sweep::Draws& draws, std::int64_t number) {
  std::string text = plan.inputs.whole_key;
  for (const std::string& override_text : sweep::overrides_of(plan.sweep, draws, number)) {
    text += "\n" + override_text;
    const auto file = plan.files.find(override_text.substr(override_text.find('=') + 1));
    if (file != plan.files.end())
      text += " " + file->second;
  }
  return sweep::short_digest(text);
}

std::string states_that_do_not_vary(const SweepPlan& plan) {
  std::vector<std::string> varied, states;
  for (const study::SweepVariable& variable : plan.sweep.variables)
    for (const std::string& key : variable.keys)
      if (key.starts_with("contacts.") || key.starts_with("contact_defaults."))
        varied.push_back(key);
  for (const study::Wear& entry : plan.inputs.study.wear)
    for (const study::WearState& state : entry.states)
      if (state.results || state.given)
        states.push_back(state.name);
  if (varied.empty() || states.empty())
    return {};
  return fmt::format(
      "{} varies in the cases, but not in the operating states {} of [[wear]]: their work rates are "
      "those of other runs or of the study, with supports of their own",
      core::list_names(varied, 3), core::list_names(states, 3));
}

} // namespace fretwork::app
