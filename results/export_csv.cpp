// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/error.hpp"
#include "results/text_file.hpp"
#include "results/write.hpp"
#include <fmt/format.h>
#include <iterator>

namespace fretwork::results {
namespace {

struct Column {
  std::string name;
  Eigen::VectorXd values;
};

void add(std::vector<Column>& columns, const std::string& name, const Eigen::MatrixXd& values,
         std::initializer_list<const char*> components, const std::string& unit) {
  Eigen::Index k = 0;
  for (const char* component : components)
    columns.push_back({fmt::format("{}_{} [{}]", name, component, unit), values.col(k++)});
}

void write_columns(const std::filesystem::path& file, const std::vector<Column>& columns) {
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

} // namespace

void export_csv(const std::filesystem::path& directory, const RunResults& results) {
  const post::TimeSeries& series = results.series;
  if (series.time.size() == 0)
    throw core::Error(
        "these results hold no time series to write as CSV; `fretwork run` the study with a [transient]");
  if (series.contacts.empty() && series.nodes.empty())
    throw core::Error(
        "these results hold no contacts and no observed nodes to write as CSV; name nodes in [output] nodes");
  for (const post::ContactSeries& c : series.contacts) {
    std::vector<Column> columns{{"time [s]", series.time}};
    add(columns, "displacement", c.displacement, {"x_loc", "y_loc", "z_loc"}, "m");
    add(columns, "velocity", c.velocity, {"x_loc", "y_loc", "z_loc"}, "m/s");
    columns.push_back({"gap [m]", c.gap});
    columns.push_back({"normal_force [N]", c.normal_force});
    add(columns, "tangential_force", c.tangential_force, {"x_loc", "t"}, "N");
    write_columns(directory / ("contact_" + path_name(c.name) + ".csv"), columns);
  }
  for (const post::NodeSeries& n : series.nodes) {
    std::vector<Column> columns{{"time [s]", series.time}};
    add(columns, "displacement", n.displacement, {"x", "y", "z"}, "m");
    add(columns, "velocity", n.velocity, {"x", "y", "z"}, "m/s");
    add(columns, "acceleration", n.acceleration, {"x", "y", "z"}, "m/s2");
    write_columns(directory / ("node_" + path_name(n.name) + ".csv"), columns);
  }
}

} // namespace fretwork::results
