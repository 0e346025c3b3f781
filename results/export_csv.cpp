// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/error.hpp"
#include "results/csv_columns.hpp"
#include "results/force_results.hpp"
#include "results/impact_columns.hpp"
#include "results/text_file.hpp"
#include "results/wear_json.hpp"
#include "results/write.hpp"
#include <algorithm>
#include <fmt/format.h>

namespace fretwork::results {
namespace {

using StateVector = Eigen::Matrix<std::uint8_t, Eigen::Dynamic, 1>;

void write_impacts(const std::filesystem::path& file, const std::vector<post::Impact>& impacts) {
  std::vector<CsvColumn> columns;
  const auto add_column = [&](const std::string& header, const auto& value) {
    columns.push_back({header, Eigen::VectorXd(static_cast<Eigen::Index>(impacts.size()))});
    std::transform(impacts.begin(), impacts.end(), columns.back().values.begin(), value);
  };
  for (const ImpactColumn& column : impact_columns)
    add_column(fmt::format("{} [{}]", column.name, column.units),
               [&](const post::Impact& row) { return row.*column.value; });
  add_column("rebounds", [](const post::Impact& row) { return static_cast<double>(row.rebounds); });
  write_csv(file, columns);
}

/// Removes what an earlier export left, of contacts and nodes that the results no longer have.
void remove_earlier(const std::filesystem::path& directory) {
  std::vector<std::filesystem::path> earlier;
  for (const auto& file : std::filesystem::directory_iterator(directory))
    if (const std::string name = file.path().filename().string();
        file.path().extension() == ".csv" &&
        (name.starts_with("contact_") || name.starts_with("node_") || name.starts_with("sections_") ||
         name.starts_with("reaction_") || name.ends_with("_impacts.csv") || is_wear_csv(name)))
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
  if (series.contacts.empty() && series.nodes.empty() && results.force_sites.empty())
    throw core::Error("these results hold no contacts, observed nodes or forces to write as CSV; name groups "
                      "in [output] nodes, section_forces or reactions");
  remove_earlier(directory);
  for (const post::ContactSeries& c : series.contacts) {
    std::vector<CsvColumn> columns{{"time [s]", series.time}};
    add_columns(columns, "displacement", c.displacement, {"x_loc", "y_loc", "z_loc"}, "m");
    add_columns(columns, "velocity", c.velocity, {"x_loc", "y_loc", "z_loc"}, "m/s");
    columns.push_back({"gap [m]", c.gap});
    columns.push_back({"normal_force [N]", c.normal_force});
    add_columns(columns, "tangential_force", c.tangential_force, {"x_loc", "t"}, "N");
    columns.push_back({"state", Eigen::Map<const StateVector>(c.state.data(), c.gap.size()).cast<double>()});
    write_csv(directory / ("contact_" + path_name(c.name) + ".csv"), columns);
  }
  for (std::size_t c = 0; c < results.impacts.size(); ++c)
    write_impacts(directory / (path_name(results.contacts[c].name) + "_impacts.csv"),
                  results.impacts[c].rows);
  if (results.wear)
    export_wear_csv(directory, *results.wear);
  for (const post::NodeSeries& n : series.nodes) {
    std::vector<CsvColumn> columns{{"time [s]", series.time}};
    add_columns(columns, "displacement", n.displacement, {"x", "y", "z"}, "m");
    add_columns(columns, "velocity", n.velocity, {"x", "y", "z"}, "m/s");
    add_columns(columns, "acceleration", n.acceleration, {"x", "y", "z"}, "m/s2");
    write_csv(directory / ("node_" + path_name(n.name) + ".csv"), columns);
  }
  export_forces_csv(directory, results);
}

} // namespace fretwork::results
