// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The files that rows are kept in while a sweep runs. Each process appends to one of its own; a row is one write. A process that is killed
/// leaves at most half a line behind, which no checksum fits.
#pragma once
#include "sweep/row.hpp"
#include <filesystem>
#include <functional>

namespace fretwork::sweep {

/// Of a sweep that is computed in parts: part `index` of `count` has the cases k with k mod count = index - 1.
struct Shard {
  int index = 1, count = 1;
  [[nodiscard]] bool has(std::int64_t number) const { return number % count == index - 1; }
};
/// `2/8`
/// @throws core::Error
[[nodiscard]] Shard shard_of(const std::string& text);

class ShardFile {
public:
  /// Makes the file and its folder where they are not there.
  /// @throws core::Error
  explicit ShardFile(const std::filesystem::path& file);
  ~ShardFile();
  ShardFile(const ShardFile&) = delete;
  ShardFile& operator=(const ShardFile&) = delete;
  /// @throws core::Error where it cannot be written
  void append(const Row& row);

private:
  void write(const std::string& text);
  std::filesystem::path path_;
  int file_ = -1;
};

/// What is in the files of a folder and its folders.
struct FoundRows {
  std::vector<Row> rows;               ///< one for each case that is there, by number
  std::int64_t corrupt = 0;            ///< lines that are not as they were written
  std::int64_t of_others = 0;          ///< rows of other inputs: an earlier state of the study
  std::vector<std::string> where = {}; ///< file and line of the corrupt ones, the first few
};

/// Reads all files `*.rows` below a folder.
/// @param cases        rows of larger numbers are left out
/// @param identity_of  digest that the row of a case has to carry
[[nodiscard]] FoundRows read_rows(const std::filesystem::path& folder, std::int64_t cases,
                                  const std::function<std::string(std::int64_t)>& identity_of);

} // namespace fretwork::sweep
