// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Files of VTK's XML formats: unstructured grids (.vtu) and collections of them in time (.pvd). Arrays are base64 in line, after a header
/// of 64 bits; little-endian.
/// Source: The VTK User's Guide, "VTK File Formats", XML file formats.
#pragma once
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace fretwork::results::vtu {

/// An array of a point or cell a column. A name is not to have quotes, "&" or "<".
[[nodiscard]] std::string array(const std::string& name, const Eigen::MatrixXd& values);
[[nodiscard]] std::string array(const std::string& name, const std::vector<std::int64_t>& values);

/// Points and cells: what all files of a series repeat.
struct Grid {
  std::size_t points = 0, cells = 0;
  std::string text;
};
/// @param points  3 x n, m   @param lines  two points each   @param vertices  points that are cells, after the lines
[[nodiscard]] Grid grid(const Eigen::Matrix3Xd& points, const std::vector<std::array<std::int32_t, 2>>& lines,
                        const std::vector<std::int32_t>& vertices);

/// A .vtu file. @param point_data, cell_data  arrays, one after the other
[[nodiscard]] std::string file(const Grid& grid, const std::string& point_data,
                               const std::string& cell_data = {});

/// A .pvd file. @param files  times (s) and names
[[nodiscard]] std::string collection(const std::vector<std::pair<double, std::string>>& files);

} // namespace fretwork::results::vtu
