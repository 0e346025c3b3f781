// SPDX-License-Identifier: GPL-3.0-or-later
#include "results/vtu_file.hpp"
#include <fmt/format.h>

namespace fretwork::results::vtu {
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
std::string data_array(const char* type, const std::string& name, Eigen::Index components, const T* values,
                       std::size_t count) {
  return fmt::format(
      R"(<DataArray type="{}" Name="{}" NumberOfComponents="{}" format="binary">{}</DataArray>)"
      "\n",
      type, name, components, encoded(values, count * sizeof(T)));
}

} // namespace

std::string array(const std::string& name, const Eigen::MatrixXd& values) {
  return data_array("Float64", name, values.rows(), values.data(), static_cast<std::size_t>(values.size()));
}

std::string array(const std::string& name, const std::vector<std::int64_t>& values) {
  return data_array("Int64", name, 1, values.data(), values.size());
}

Grid grid(const Eigen::Matrix3Xd& points, const std::vector<std::array<std::int32_t, 2>>& lines,
          const std::vector<std::int32_t>& vertices) {
  std::vector<std::int64_t> connectivity, offsets;
  std::vector<std::uint8_t> types;
  const auto close_cell = [&](std::uint8_t type) {
    offsets.push_back(static_cast<std::int64_t>(connectivity.size()));
    types.push_back(type);
  };
  for (const auto& line : lines) {
    connectivity.insert(connectivity.end(), line.begin(), line.end());
    close_cell(vtk_line);
  }
  for (const std::int32_t point : vertices) {
    connectivity.push_back(point);
    close_cell(vtk_vertex);
  }
  return {static_cast<std::size_t>(points.cols()), types.size(),
          fmt::format("<Points>\n{}</Points>\n<Cells>\n{}{}{}</Cells>\n", array("Points", points),
                      array("connectivity", connectivity), array("offsets", offsets),
                      data_array("UInt8", "types", 1, types.data(), types.size()))};
}

std::string file(const Grid& grid, const std::string& point_data, const std::string& cell_data) {
  return fmt::format("<?xml version=\"1.0\"?>\n"
                     "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" "
                     "header_type=\"UInt64\">\n"
                     "<UnstructuredGrid>\n<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n"
                     "{}<PointData>\n{}</PointData>\n<CellData>\n{}</CellData>\n</Piece>\n"
                     "</UnstructuredGrid>\n</VTKFile>\n",
                     grid.points, grid.cells, grid.text, point_data, cell_data);
}

std::string collection(const std::vector<std::pair<double, std::string>>& files) {
  std::string text = "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\">\n<Collection>\n";
  for (const auto& [time, name] : files)
    text += fmt::format("<DataSet timestep=\"{}\" part=\"0\" file=\"{}\"/>\n", time, name);
  return text + "</Collection>\n</VTKFile>\n";
}

} // namespace fretwork::results::vtu
