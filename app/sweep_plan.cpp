// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/sweep_plan.hpp"
#include "core/error.hpp"
#include "core/hash.hpp"
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

} // namespace fretwork::app
