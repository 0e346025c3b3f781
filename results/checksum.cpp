// SPDX-License-Identifier: GPL-3.0-or-later
#include "results/checksum.hpp"
#include "core/hash.hpp"
#include <cassert>
#include <fmt/format.h>
#include <fstream>

namespace fretwork::results {
namespace {

constexpr std::string_view announcement = "Fretwork. SHA-256 of all bytes after the first 512: ";
constexpr std::string_view summary_key = "\"sha256\": \"";

std::string first_line(const std::string& digest) { return fmt::format("{}{}\n", announcement, digest); }

} // namespace

std::string user_block(std::string_view hdf5) {
  std::string block = first_line(core::sha256(hdf5));
  block.resize(user_block_bytes, '\0');
  return block;
}

std::string checksum_refusal(const std::filesystem::path& hdf5_file) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(hdf5_file, ignored))
    return "it is no regular file";
  std::string block(user_block_bytes, '\0');
  std::ifstream in(hdf5_file, std::ios::binary);
  if (!in.read(block.data(), static_cast<std::streamsize>(block.size())) || !block.starts_with(announcement))
    return "it has no checksum of this program";
  std::string expected = first_line(core::sha256_of_file(hdf5_file.string(), user_block_bytes));
  expected.resize(user_block_bytes, '\0');
  return block == expected ? std::string() : "its checksum does not fit";
}

const std::string& no_checksum() {
  static const std::string zeros(core::sha256_digits, '0');
  return zeros;
}

std::string with_checksum(std::string summary) {
  const std::size_t at = summary.rfind(no_checksum());
  assert(at != std::string::npos);
  return summary.replace(at, core::sha256_digits, core::sha256(summary));
}

bool checksum_fits(std::string summary) {
  const std::size_t key = summary.rfind(summary_key);
  if (key == std::string::npos)
    return false;
  const std::size_t at = key + summary_key.size();
  const std::string found = summary.substr(at, core::sha256_digits);
  if (found.size() != core::sha256_digits)
    return false;
  return core::sha256(summary.replace(at, core::sha256_digits, no_checksum())) == found;
}

} // namespace fretwork::results
