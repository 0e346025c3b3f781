// SPDX-License-Identifier: GPL-3.0-or-later
#include "results/csv_columns.hpp"
#include "results/text_file.hpp"
#include <fmt/format.h>
#include <iterator>

namespace fretwork::results {

void add_columns(std::vector<CsvColumn>& columns, const std::string& name, const Eigen::MatrixXd& values,
                 std::initializer_list<const char*> components, const std::string& unit) {
  Eigen::Index k = 0;
  for (const char* component : components)
    columns.push_back({fmt::format("{}_{} [{}]", name, component, unit), values.col(k++)});
}

void write_csv(const std::filesystem::path& file, const std::vector<CsvColumn>& columns) {
  fmt::memory_buffer text;
  const auto out = std::back_inserter(text);
  for (std::size_t c = 0; c < columns.size(); ++c)
    fmt::format_to(out, "{}{}", c == 0 ? "" : ",", columns[c].name);
  text.push_back('\n');
  for (Eigen::Index i = 0; i < columns[0].values.size(); ++i) {
    for (std::size_t c = 0; c < columns.size(); ++c)
      fmt::format_to(out, "{}{}", c == 0 ? "" : ",", columns[c].values(i));
    text.push_back('\n');
  }
  write_text(file, {text.data(), text.size()});
}

} // namespace fretwork::results
