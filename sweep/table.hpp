// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The table of a sweep, one row a case, in the order of the cases: the same bytes for any number of ranks, order of cases, shards and
/// interruptions.
#pragma once
#include "sweep/design.hpp"
#include "sweep/row.hpp"
#include <filesystem>

namespace fretwork::sweep {

/// An output. Its standard error, where there is one, is the column `name.error`.
struct Column {
  std::string name, unit;
  std::vector<std::string> contacts =
      {}; ///< of a life: those of its support, which is in a case where one of them is
  [[nodiscard]] bool operator==(const Column&) const = default;
};

/// Place of an output among columns.
/// @throws core::Error where there is none; `where` begins the message
[[nodiscard]] std::size_t place_of(const std::vector<Column>& columns, const std::string& output,
                                   const std::string& where);

struct Table {
  std::vector<Column> outputs;
  std::vector<Row> rows; ///< by number of the case

  /// Numbers of the rows that are done.
  [[nodiscard]] std::vector<std::size_t> done() const;
  /// Whether the study has any: else there are no outputs of all of them.
  [[nodiscard]] bool has_contacts() const;
};

/// table.csv: number, outcome, identity, inputs, outputs, message; a header with units.
/// @throws core::Error if it cannot be written
void write_csv(const std::filesystem::path& file, const study::Sweep& sweep, const Draws& draws,
               const Table& table);

/// table.h5: /case/number, /case/outcome (0 done, 1 refused, 2 failed, 3 defect, 4 crashed), /inputs/<variable> (numbers as of `value_number`; the
/// attribute `values of <variable>` lists the texts they stand for), /outputs/<output>. Cases that are not done have no numbers.
/// @param attributes  texts of the file
/// @throws core::Error if it cannot be written
void write_archive(const std::filesystem::path& file, const study::Sweep& sweep, const Draws& draws,
                   const Table& table, std::map<std::string, std::string> attributes);

} // namespace fretwork::sweep
