// SPDX-License-Identifier: GPL-3.0-or-later
#include "results/summary_file.hpp"
#include "results/checksum.hpp"
#include <fmt/format.h>
#include <fstream>
#include <iterator>

namespace fretwork::results {

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

} // namespace fretwork::results
