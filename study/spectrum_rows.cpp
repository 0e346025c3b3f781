// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/spectrum_rows.hpp"
#include "core/error.hpp"
#include "study/number_rows.hpp"

namespace fretwork::study {
namespace {

using Rows = std::vector<std::vector<double>>;

Rows spectrum_of_file(const Value& value, const std::string& path, const std::filesystem::path& folder) {
  try {
    NumberRows file = read_number_rows(folder / to_text(value, path));
    if (file.rows.front().size() != 2)
      throw core::Error("it has " + std::to_string(file.rows.front().size()) +
                        " columns; give two, the frequency and the density");
    return std::move(file.rows);
  } catch (const core::Error& error) {
    fail(value, path, error.what());
  }
}

Rows spectrum_rows(const Value& value, const std::string& path, const std::filesystem::path& folder) {
  if (value.string())
    return spectrum_of_file(value, path, folder);
  const Array& items =
      to_array(value, path, "an array of rows [frequency, density] or the name of a file of rows");
  Rows out;
  for (std::size_t i = 0; i < items.size(); ++i)
    out.push_back(to_numbers(items[i], path + "[" + std::to_string(i) + "]", 2, {}));
  return out;
}

} // namespace

SpectrumRows read_spectrum_rows(const TableReader& table, const std::string& key,
                                const std::filesystem::path& folder) {
  const Value& value = table.required(key, "rows [frequency, density], or the name of a file of rows");
  const std::string path = table.path(key);
  const Rows rows = spectrum_rows(value, path, folder);
  if (rows.size() < 2)
    fail(value, path, "a spectrum of one row has no slope; give two rows at least");
  SpectrumRows out;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (!(rows[i][0] > 0.0) || !(rows[i][1] > 0.0))
      fail(value, path,
           "row " + std::to_string(i + 1) +
               " is not above zero; between rows the logarithms are linear, leave it out");
    if (i > 0 && rows[i][0] <= rows[i - 1][0])
      fail(value, path,
           "row " + std::to_string(i + 1) +
               " is not above the one before; let frequencies rise from row to row");
    out.frequency.push_back(rows[i][0]);
    out.density.push_back(rows[i][1]);
  }
  return out;
}

void inline_spectrum_rows(Value& entry, const std::string& path, const std::filesystem::path& folder) {
  auto* keys = std::get_if<Table>(&entry.data);
  const auto at = keys ? keys->find("table") : Table::iterator{};
  if (!keys || at == keys->end() || !at->second.string())
    return;
  Array rows;
  for (const auto& row : spectrum_of_file(at->second, path + ".table", folder))
    rows.push_back({Array{{row[0], {}}, {row[1], {}}}, {}});
  at->second.data = std::move(rows);
}

} // namespace fretwork::study
