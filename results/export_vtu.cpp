// SPDX-License-Identifier: GPL-3.0-or-later
#include "results/mode_fields.hpp"
#include "results/text_file.hpp"
#include "results/write.hpp"
#include <fmt/format.h>

namespace fretwork::results {
namespace {

constexpr std::uint8_t vtk_vertex = 1, vtk_line = 3;

/// Bytes in base64, after their number as VTK wants it: both in one go.
std::string encoded(const void* data, std::size_t size) {
  static constexpr char letters[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  const auto length = static_cast<std::uint64_t>(size);
  std::string bytes(reinterpret_cast<const char*>(&length), sizeof length);
  bytes.append(static_cast<const char*>(data), size);
  std::string out;
  out.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t left = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t word = 0;
    for (std::size_t k = 0; k < 3; ++k)
      word = word << 8 | (k < left ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k)
      out += k <= left ? letters[word >> (18 - 6 * k) & 63u] : '=';
  }
  return out;
}

template <class T>
std::string data_array(const std::string& type, const std::string& name, int components, const T* values,
                       std::size_t count) {
  return fmt::format(
      R"(<DataArray type="{}" Name="{}" NumberOfComponents="{}" format="binary">{}</DataArray>)"
      "\n",
      type, name, components, encoded(values, count * sizeof(T)));
}

std::string vectors(const std::string& name, const Field& field) {
  return data_array("Float64", name, 3, field.data(), static_cast<std::size_t>(field.size()));
}

/// Points and cells: the part that every file of a run repeats.
std::string geometry(const RunResults& results) {
  Field points(3, static_cast<Eigen::Index>(results.nodes.size()));
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    points.col(i) = results.nodes[static_cast<std::size_t>(i)];
  std::vector<std::int64_t> connectivity, offsets;
  std::vector<std::uint8_t> types;
  const auto close_cell = [&](std::uint8_t type) {
    offsets.push_back(static_cast<std::int64_t>(connectivity.size()));
    types.push_back(type);
  };
  for (const auto& line : results.lines) {
    connectivity.insert(connectivity.end(), line.begin(), line.end());
    close_cell(vtk_line);
  }
  for (const core::Index node : lone_nodes(results)) {
    connectivity.push_back(node);
    close_cell(vtk_vertex);
  }
  return fmt::format("<Points>\n{}</Points>\n<Cells>\n{}{}{}</Cells>\n", vectors("Points", points),
                     data_array("Int64", "connectivity", 1, connectivity.data(), connectivity.size()),
                     data_array("Int64", "offsets", 1, offsets.data(), offsets.size()),
                     data_array("UInt8", "types", 1, types.data(), types.size()));
}

std::string grid(const RunResults& results, const std::string& geometry, const std::string& point_data) {
  return fmt::format("<?xml version=\"1.0\"?>\n"
                     "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" "
                     "header_type=\"UInt64\">\n"
                     "<UnstructuredGrid>\n<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n"
                     "{}<PointData>\n{}</PointData>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n",
                     results.nodes.size(), results.lines.size() + lone_nodes(results).size(), geometry,
                     point_data);
}

void write_snapshots(const std::filesystem::path& directory, const RunResults& results,
                     const std::string& geometry) {
  const Eigen::VectorXd& time = results.series.time;
  const Eigen::Index count = std::min(most_snapshots, time.size());
  std::string index =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\">\n<Collection>\n";
  for (Eigen::Index i = 0; i < count; ++i) {
    const Eigen::Index at = count > 1 ? i * (time.size() - 1) / (count - 1) : 0;
    const std::string name = fmt::format("snapshots/snapshot_{:04}.vtu", i);
    write_text(directory / name, grid(results, geometry, vectors("displacement [m]", motion(results, at))));
    index += fmt::format("<DataSet timestep=\"{}\" part=\"0\" file=\"{}\"/>\n", time(at), name);
  }
  write_text(directory / "snapshots.pvd", index + "</Collection>\n</VTKFile>\n");
}

} // namespace

void export_vtu(const std::filesystem::path& directory, const RunResults& results) {
  require_mesh(results);
  const std::string shared = geometry(results);
  std::string modes;
  for (Eigen::Index k = 0; k < mode_count(results); ++k) {
    const ModeField field = mode_field(results, k);
    modes += vectors(field.name, field.displacement);
  }
  write_text(directory / "modes.vtu", grid(results, shared, modes));
  if (results.series.modal_displacement.size() > 0)
    write_snapshots(directory, results, shared);
}

} // namespace fretwork::results
