// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/child_process.hpp"
#include "core/error.hpp"
#include "folder.hpp"
#include "results/mode_fields.hpp"
#include "results/write.hpp"
#include "synthetic.hpp"
#include <cstring>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sstream>

namespace fretwork::results::export_test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

std::vector<double> numbers(std::string line) {
  std::vector<double> out;
  std::istringstream in(line);
  for (std::string cell; std::getline(in, cell, ',');)
    out.push_back(std::stod(cell));
  return out;
}

std::string refusal(const auto& exporter, const RunResults& results) {
  const Folder folder;
  try {
    exporter(folder.path(), results);
  } catch (const core::Error& error) {
    EXPECT_EQ(folder.files(), 0u);
    return error.what();
  }
  return {};
}

TEST(ExportCsv, HasAFileForEachContactAndNodeWithUnits) {
  const Folder folder;
  RunResults results = made_up({.contacts = 2, .outputs = 20});
  results.contacts[1].name = results.series.contacts[1].name = "leg/tsp";
  export_csv(folder.path(), results);
  EXPECT_EQ(folder.files(), 5u);
  EXPECT_TRUE(fs::exists(folder / "contact_leg%2Ftsp.csv"));
  EXPECT_TRUE(fs::exists(folder / "leg%2Ftsp_impacts.csv"));
  EXPECT_EQ(
      lines_of(folder / "contact_tsp1.csv").at(0),
      "time [s],displacement_x_loc [m],displacement_y_loc [m],displacement_z_loc [m],velocity_x_loc [m/s],"
      "velocity_y_loc [m/s],velocity_z_loc [m/s],gap [m],normal_force [N],tangential_force_x_loc [N],"
      "tangential_force_t [N],state");
  EXPECT_EQ(lines_of(folder / "tsp1_impacts.csv").at(0),
            "start [s],duration [s],peak_force [N],impulse [N s],velocity_before [m/s],velocity_after "
            "[m/s],energy_lost [J],rebounds");
  EXPECT_EQ(
      lines_of(folder / "node_apex.csv").at(0),
      "time [s],displacement_x [m],displacement_y [m],displacement_z [m],velocity_x [m/s],velocity_y [m/s],"
      "velocity_z [m/s],acceleration_x [m/s2],acceleration_y [m/s2],acceleration_z [m/s2]");
}

TEST(ExportCsv, HasNumbersThatReadBackBitForBit) {
  const Folder folder;
  const RunResults results = made_up({.contacts = 1, .outputs = 20});
  export_csv(folder.path(), results);
  const auto lines = lines_of(folder / "contact_tsp1.csv");
  ASSERT_EQ(lines.size(), 21u);
  const post::ContactSeries& s = results.series.contacts[0];
  for (Eigen::Index i = 0; i < 20; ++i)
    EXPECT_EQ(
        numbers(lines[static_cast<std::size_t>(i + 1)]),
        (std::vector<double>{results.series.time(i), s.displacement(i, 0), s.displacement(i, 1),
                             s.displacement(i, 2), s.velocity(i, 0), s.velocity(i, 1), s.velocity(i, 2),
                             s.gap(i), s.normal_force(i), s.tangential_force(i, 0), s.tangential_force(i, 1),
                             static_cast<double>(s.state[static_cast<std::size_t>(i)])}));
  const auto impacts = lines_of(folder / "tsp1_impacts.csv");
  const auto& rows = results.impacts[0].rows;
  ASSERT_GT(rows.size(), 0u);
  ASSERT_EQ(impacts.size(), rows.size() + 1);
  for (std::size_t i = 0; i + 1 < rows.size(); ++i) { // the last may hold a NaN
    const post::Impact& r = rows[i];
    EXPECT_EQ(numbers(impacts[i + 1]),
              (std::vector<double>{r.start, r.duration, r.peak, r.impulse, r.velocity_before,
                                   r.velocity_after, r.energy_lost, static_cast<double>(r.rebounds)}));
  }
}

TEST(ExportCsv, HasNoFilesOfImpactsWhereNoneWereKept) {
  const Folder folder;
  RunResults results = made_up({.contacts = 1, .outputs = 20});
  results.impacts.clear();
  export_csv(folder.path(), results);
  EXPECT_EQ(folder.files(), 2u);
}

TEST(ExportCsv, NeedsSeries) {
  EXPECT_THAT(refusal(export_csv, made_up({.outputs = 0})),
              HasSubstr("no time series to write as CSV; `fretwork run`"));
  RunResults results = made_up();
  results.series.contacts.clear();
  results.series.nodes.clear();
  EXPECT_THAT(refusal(export_csv, results), HasSubstr("no contacts, observed nodes or forces"));
}

TEST(ExportVtu, NeedsAMesh) {
  RunResults results = made_up();
  results.nodes.clear();
  EXPECT_THAT(refusal([](const auto& folder, const auto& made) { export_vtu(folder, made); }, results),
              HasSubstr("modes without a mesh"));
  EXPECT_THAT(refusal(export_msh, results), HasSubstr("modes without a mesh"));
}

TEST(ExportVtu, HasOneFileAnInstantAndOneCollection) {
  const Folder folder;
  export_vtu(folder.path(), made_up({.outputs = 500, .elements = 4}));
  EXPECT_EQ(std::distance(fs::directory_iterator(folder / "snapshots"), {}), most_snapshots);
  const auto collection = lines_of(folder / "snapshots.pvd");
  EXPECT_THAT(collection.at(3), HasSubstr("timestep=\"0\" part=\"0\" file=\"snapshots/snapshot_0000.vtu\""));
  EXPECT_THAT(collection.at(2 + most_snapshots), HasSubstr("timestep=\"2\""));
  EXPECT_THAT(collection.at(2 + most_snapshots), HasSubstr("snapshots/snapshot_0199.vtu"));
}

TEST(ExportVtu, HasEveryInstantOfAShortSeriesAndNoneWithoutATransient) {
  const Folder folder;
  export_vtu(folder.path(), made_up({.outputs = 1, .elements = 4}));
  EXPECT_EQ(std::distance(fs::directory_iterator(folder / "snapshots"), {}), 1);
  const Folder other;
  export_vtu(other.path(), made_up({.outputs = 0}));
  EXPECT_EQ(other.files(), 1u);
}

/// What meshio, a reader that is not ours, prints of a file; the test is skipped where no Python has it.
std::string seen_by_meshio(const fs::path& file, const std::string& program) {
  const std::string script =
      "import sys\ntry:\n    import meshio, numpy as np\nexcept ImportError:\n    sys.exit(42)\n"
      "print(end='|')\nm = meshio.read(sys.argv[1])\nprint(end='|')\n" +
      program;
  const char* given = std::getenv("FRETWORK_PYTHON");
  for (const std::string& python :
       {std::string(given ? given : "python3"), std::string("/usr/bin/python3")}) {
    const core::ChildResult child = core::run_child({python, "-c", script, file.string()});
    if (child.status == 0)
      return child.output.substr(child.output.find('|', child.output.find('|') + 1) +
                                 1); // without meshio's own lines
    if (child.status != 42 && child.status != 127)
      return "failed: " + child.output;
  }
  return "no meshio";
}

/// Prints nodes, lines, lone points and, for each mode, its name and the values at node 3.
const char* const print_all = R"(
cells = {b.type: len(b.data) for b in m.cells}
print(len(m.points), cells.get('line', 0), cells.get('vertex', 0))
print(*['%.17g' % x for x in m.points[3]])
for name, values in m.point_data.items():
    if 'mode' in name:
        print(name + ':', *['%.17g' % x for x in np.asarray(values)[3]])
)";

/// As print_all prints them. Tube 1 has nodes 0 to 8; node 3 of it is at three eighths.
std::string expected_print(const RunResults& results, const std::vector<std::string>& names) {
  std::string out = fmt::format("{} {} {}\n", results.nodes.size(), results.lines.size(),
                                results.nodes.size() - results.lines.size() - results.bases.size());
  const auto row = [](const core::Vec3& v) {
    return fmt::format("{:.17g} {:.17g} {:.17g}\n", v.x(), v.y(), v.z());
  };
  out += row(results.nodes[3]);
  for (std::size_t k = 0; k < names.size(); ++k) {
    const modal::Basis& basis = results.bases[0];
    const auto mode = static_cast<Eigen::Index>(k);
    double largest = 0.0;
    for (Eigen::Index i = 0; i < 9; ++i)
      largest = std::max(largest, basis.shapes.block<3, 1>(6 * i, mode).norm());
    out += names[k] + ": " + row(basis.shapes.block<3, 1>(18, mode) / largest);
  }
  return out;
}

RunResults small(int structures, int lone) {
  RunResults results = made_up({.outputs = 3, .structures = structures, .modes = 2, .elements = 8});
  for (int i = 0; i < lone; ++i)
    results.nodes.emplace_back(0.1 * i, 1.0, 2.0);
  return results;
}

TEST(ExportVtu, IsReadByMeshioWithAllModes) {
  const Folder folder;
  const RunResults results = small(1, 2);
  export_vtu(folder.path(), results);
  const std::string seen = seen_by_meshio(folder / "modes.vtu", print_all);
  if (seen == "no meshio")
    GTEST_SKIP() << seen;
  EXPECT_EQ(seen, expected_print(results, {"mode 1, 0.5 Hz", "mode 2, 0.5 Hz"}));
}

TEST(ExportVtu, NamesStaticModes) {
  RunResults results = small(1, 2);
  results.bases[0].static_modes = 1;
  EXPECT_EQ(mode_count(results), 2);
  EXPECT_EQ(mode_field(results, 0).name, "mode 1, 0.5 Hz");
  EXPECT_EQ(mode_field(results, 1).name, "static mode 1, 0.5 Hz");
}

TEST(ExportVtu, ShowsStaticModesOfSeveralStructuresAfterAllModes) {
  RunResults results = small(3, 0);
  results.bases[0].static_modes = 1; // mode and static mode; the others two modes
  ASSERT_EQ(mode_count(results), 3);
  EXPECT_EQ(mode_field(results, 1).name, "mode 2 of each structure");
  const ModeField last = mode_field(results, 2);
  EXPECT_EQ(last.name, "static mode 1 of each structure");
  for (const std::size_t s : {std::size_t{0}, std::size_t{1}, std::size_t{2}}) {
    const core::Index node = results.bases[s].nodes[1]; // moves in every mode, of its own structure
    EXPECT_EQ(mode_field(results, 1).displacement.col(node).isZero(0.0), s == 0);
    EXPECT_EQ(last.displacement.col(node).isZero(0.0), s != 0);
  }
}

TEST(ExportVtu, ShowsTheModesOfSeveralStructuresTogether) {
  const Folder folder;
  const RunResults results = small(3, 0);
  export_vtu(folder.path(), results);
  const std::string seen = seen_by_meshio(folder / "modes.vtu", print_all);
  if (seen == "no meshio")
    GTEST_SKIP() << seen;
  EXPECT_EQ(seen, expected_print(results, {"mode 1 of each structure", "mode 2 of each structure"}));
}

TEST(ExportVtu, HasTheMotionOfTheModesInItsSnapshots) {
  const Folder folder;
  const RunResults results = small(2, 1);
  export_vtu(folder.path(), results);
  const std::string program = "print(*['%.12e' % x for x in m.point_data['displacement [m]'][12]])";
  const std::string seen = seen_by_meshio(folder / "snapshots" / "snapshot_0002.vtu", program);
  if (seen == "no meshio")
    GTEST_SKIP() << seen;
  // node 12 is node 3 of the second tube, whose modes are the third and fourth of the series
  const core::Vec3 u =
      results.bases[1].shapes.middleRows<3>(18) * results.series.modal_displacement.col(2).segment(2, 2);
  EXPECT_EQ(seen, fmt::format("{:.12e} {:.12e} {:.12e}\n", u.x(), u.y(), u.z()));
}

TEST(ExportMsh, IsReadByMeshioWithAllModes) {
  const Folder folder;
  const RunResults results = small(1, 0);
  export_msh(folder.path(), results);
  const std::string seen = seen_by_meshio(folder / "modes.msh", print_all);
  if (seen == "no meshio")
    GTEST_SKIP() << seen;
  EXPECT_EQ(seen, expected_print(results, {"mode 1, 0.5 Hz", "mode 2, 0.5 Hz"}));
}

TEST(ExportMsh, IsMsh41WithAViewAMode) {
  const Folder folder;
  export_msh(folder.path(), small(2, 1));
  const auto lines = lines_of(folder / "modes.msh");
  EXPECT_EQ(lines.at(1), "4.1 0 8");
  EXPECT_EQ(lines.at(4), "1 19 1 19");
  EXPECT_EQ(std::count(lines.begin(), lines.end(), "$NodeData"), 2);
  EXPECT_EQ(std::count(lines.begin(), lines.end(), "\"mode 2 of each structure\""), 1);
  EXPECT_EQ(std::count(lines.begin(), lines.end(), "0 1 15 1"), 1); // the lone node is a point element
}

} // namespace
} // namespace fretwork::results::export_test
