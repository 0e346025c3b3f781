// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/stored_results.hpp"
#include "results/summary_file.hpp"
#include "results/write.hpp"
#include <fmt/format.h>

namespace fretwork::app {

namespace fs = std::filesystem;

bool up_to_date(const Inputs& inputs, const std::function<void(const std::string&)>& tell) {
  const results::FoundSummary found = results::read_summary(inputs.directory / "summary.json");
  if (!found.refusal.empty())
    tell(found.refusal + ": the results are computed again");
  const nlohmann::json& summary = found.summary;
  if (!summary.is_object() || !summary.contains("transient") ||
      results::text_of(summary, "input_sha256") != inputs.whole_key ||
      results::text_of(summary, "version") != FRETWORK_VERSION)
    return false;
  if (const std::string table = results::changed_table(inputs.directory, summary); !table.empty()) {
    tell(fmt::format("{} is not as it was written: the results are computed again", table));
    return false;
  }
  const fs::path archive = inputs.directory / "results.h5";
  const std::string refusal = results::archive_refusal(archive, inputs.whole_key);
  if (!refusal.empty() && fs::exists(archive))
    tell(fmt::format("{} is not as it was written ({}): the results are computed again", archive.string(),
                     refusal));
  return refusal.empty();
}

bool has_run(const fs::path& folder) {
  const nlohmann::json summary = results::read_summary(folder / "summary.json").summary;
  return summary.is_object() && summary.contains("transient") && fs::exists(folder / "results.h5");
}

} // namespace fretwork::app
