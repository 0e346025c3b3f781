// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/error.hpp"
#include "results/impact_columns.hpp"
#include "results/text_file.hpp"
#include "results/wear_json.hpp"
#include "results/write.hpp"
#include <algorithm>
#include <fmt/format.h>
#include <iterator>

namespace fretwork::results {
namespace {

using StateVector = Eigen::Matrix<std::uint8_t, Eigen::Dynamic, 1>;

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

void write_impacts(const std::filesystem::path& file, const std::vector<post::Impact>& impacts) {
  std::vector<Column> columns;
  const auto add_column = [&](const std::string& header, const auto& value) {
    columns.push_back({header, Eigen::VectorXd(static_cast<Eigen::Index>(impacts.size()))});
    std::transform(impacts.begin(), impacts.end(), columns.back().values.begin(), value);
  };
  for (const ImpactColumn& column : impact_columns)
    add_column(fmt::format("{} [{}]", column.name, column.units),
               [&](const post::Impact& row) { return row.*column.value; });
  add_column("rebounds", [](const post::Impact& row) { return static_cast<double>(row.rebounds); });
  write_columns(file, columns);
}

/// Removes what an earlier export left, of contacts and nodes that the results no longer have.
void remove_earlier(const std::filesystem::path& directory) {
  std::vector<std::filesystem::path> earlier;
  for (const auto& file : std::filesystem::directory_iterator(directory))
    if (const std::string name = file.path().filename().string();
        file.path().extension() == ".csv" && (name.starts_with("contact_") || name.starts_with("node_") ||
                                              name.ends_with("_impacts.csv") || is_wear_csv(name)))
      earlier.push_back(file.path());
  for (const auto& file : earlier)
    std::filesystem::remove(file);
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
  remove_earlier(directory);
  for (const post::ContactSeries& c : series.contacts) {
    std::vector<Column> columns{{"time [s]", series.time}};
    add(columns, "displacement", c.displacement, {"x_loc", "y_loc", "z_loc"}, "m");
    add(columns, "velocity", c.velocity, {"x_loc", "y_loc", "z_loc"}, "m/s");
    columns.push_back({"gap [m]", c.gap});
    columns.push_back({"normal_force [N]", c.normal_force});
    add(columns, "tangential_force", c.tangential_force, {"x_loc", "t"}, "N");
    columns.push_back({"state", Eigen::Map<const StateVector>(c.state.data(), c.gap.size()).cast<double>()});
    write_columns(directory / ("contact_" + path_name(c.name) + ".csv"), columns);
  }
  for (std::size_t c = 0; c < results.impacts.size(); ++c)
    write_impacts(directory / (path_name(results.contacts[c].name) + "_impacts.csv"),
                  results.impacts[c].rows);
  if (results.wear)
    export_wear_csv(directory, *results.wear);
  for (const post::NodeSeries& n : series.nodes) {
    std::vector<Column> columns{{"time [s]", series.time}};
    add(columns, "displacement", n.displacement, {"x", "y", "z"}, "m");
    add(columns, "velocity", n.velocity, {"x", "y", "z"}, "m/s");
    add(columns, "acceleration", n.acceleration, {"x", "y", "z"}, "m/s2");
    write_columns(directory / ("node_" + path_name(n.name) + ".csv"), columns);
  }
}

} // namespace fretwork::results
