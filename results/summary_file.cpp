// SPDX-License-Identifier: GPL-3.0-or-later
#include "results/summary_file.hpp"
#include "core/hash.hpp"
#include "results/checksum.hpp"
#include "results/whole_file.hpp"
#include <fmt/format.h>
#include <fstream>
#include <iterator>

namespace fretwork::results {

void save_summary(const std::filesystem::path& file, nlohmann::ordered_json summary) {
  summary["sha256"] = no_checksum();
  write_whole(
      file,
      {with_checksum(summary.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + '\n')});
}

FoundSummary read_summary(const std::filesystem::path& file) {
  std::error_code ignored;
  if (!std::filesystem::exists(file, ignored))
    return {};
  const auto refuse = [&](const char* why) {
    return FoundSummary{{}, fmt::format("{} {}", file.string(), why)};
  };
  if (!std::filesystem::is_regular_file(file, ignored))
    return refuse("is no regular file");
  std::ifstream in(file, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  if (!checksum_fits(text))
    return refuse("is not as it was written (its checksum does not fit)");
  nlohmann::json summary = nlohmann::json::parse(text, nullptr, false);
  if (!summary.is_object())
    return refuse("holds no JSON object");
  return {std::move(summary), {}};
}

std::string text_of(const nlohmann::json& table, const char* key) {
  const auto found = table.is_object() ? table.find(key) : table.end();
  return found != table.end() && found->is_string() ? found->get<std::string>() : std::string();
}

nlohmann::ordered_json digests_of_tables(const std::filesystem::path& folder) {
  nlohmann::ordered_json out = nlohmann::ordered_json::object();
  for (const char* name : {"flow.csv", "spectra.csv"}) {
    const std::filesystem::path file = folder / name;
    std::error_code ignored;
    if (std::filesystem::is_regular_file(file, ignored))
      out[name] = core::sha256_of_file(file.string(), 0);
  }
  return out;
}

std::string changed_table(const std::filesystem::path& folder, const nlohmann::json& summary) {
  const auto files = summary.find("files_sha256");
  if (files == summary.end() || !files->is_object())
    return {};
  for (const auto& [name, digest] : files->items()) {
    const std::filesystem::path file = folder / name;
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(file, ignored) || digest != core::sha256_of_file(file.string(), 0))
      return file.string();
  }
  return {};
}

} // namespace fretwork::results
