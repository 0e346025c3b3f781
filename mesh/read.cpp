// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/read.hpp"
#include "core/error.hpp"
#include "core/input_file.hpp"
#include "mesh/canonical_order.hpp"
#include "mesh/msh_reader.hpp"
#include "mesh/near_nodes.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace fretwork::mesh {
namespace {

namespace fs = std::filesystem;

/// Nodes nearer than this part of the extent are at the same place (a mesher's positions are good to 1e-11).
constexpr double coincidence = 1e-8;

bool positive(double value) { return value > 0.0 && std::isfinite(value); }

void check_source(const Source& source) {
  const std::string file = source.file.string();
  if (!positive(source.scale))
    throw core::Error(fmt::format("{}: scale = {} must be a number > 0", file, source.scale));
  if (!(source.merge_tolerance >= 0.0) || !std::isfinite(source.merge_tolerance))
    throw core::Error(
        fmt::format("{}: merge_tolerance = {} m must be a length >= 0", file, source.merge_tolerance));
  if (source.element_size && !positive(*source.element_size))
    throw core::Error(
        fmt::format("{}: element_size = {} m must be a length > 0", file, *source.element_size));
  if (source.order && *source.order != 1 && *source.order != 2)
    throw core::Error(fmt::format("{}: order = {} must be 1 or 2", file, *source.order));
  core::check_input_file(source.file, fmt::format("mesh file {}", file));
  if (source.element_size && !is_geometry(source.file))
    throw core::Error(fmt::format(
        "{}: element_size is for geometries (.geo, .step, .brep); this file is meshed already, leave "
        "it out",
        file));
}

RawMesh read_raw(const Source& source) {
  return is_msh(source.file) ? read_msh(source.file) : read_msh_text(as_msh(source), source.file.string());
}

void check_content(const RawMesh& mesh) {
  const bool has_points = std::any_of(mesh.points.begin(), mesh.points.end(),
                                      [](const auto& group) { return !group.second.empty(); });
  if (!mesh.lines.empty() || has_points)
    return;
  if (mesh.ignored_elements > 0)
    throw core::Error(fmt::format(
        "the mesh has {} surface or volume elements but no lines; beams need lines: in gmsh, put the "
        "curves into a Physical Curve",
        mesh.ignored_elements));
  throw core::Error(
      "the mesh has neither lines nor named points; in gmsh, put the curves into a Physical Curve");
}

void scale_nodes(RawMesh& mesh, double scale) {
  for (std::size_t i = 0; i < mesh.nodes.size(); ++i) {
    Vec3& x = mesh.nodes[i];
    x *= scale;
    if (!x.allFinite())
      throw core::Error(
          fmt::format("node number {} of the file is at ({}, {}, {}) m: every coordinate must be finite",
                      i + 1, x.x(), x.y(), x.z()));
  }
}

/// Keep the nodes that a line or a named point uses.
/// @return the number of the others
std::size_t drop_orphans(RawMesh& mesh) {
  std::vector<Index> number(mesh.nodes.size(), -1);
  const auto use = [&](Index node) {
    if (node >= 0)
      number[node] = 0;
  };
  for (const RawLine& line : mesh.lines) {
    use(line.nodes[0]);
    use(line.nodes[1]);
    use(line.middle);
  }
  for (const auto& [name, nodes] : mesh.points)
    std::for_each(nodes.begin(), nodes.end(), use);
  Index kept = 0;
  for (std::size_t i = 0; i < number.size(); ++i)
    if (number[i] == 0) {
      mesh.nodes[kept] = mesh.nodes[i];
      number[i] = kept++;
    }
  const std::size_t dropped = mesh.nodes.size() - kept;
  mesh.nodes.resize(kept);
  for (RawLine& line : mesh.lines)
    line = {{number[line.nodes[0]], number[line.nodes[1]]}, line.middle < 0 ? -1 : number[line.middle]};
  for (auto& [name, nodes] : mesh.points)
    for (Index& node : nodes)
      node = number[node];
  return dropped;
}

void check_lengths(const RawMesh& mesh) {
  const double shortest = coincidence * extent(mesh.nodes);
  for (std::size_t i = 0; i < mesh.lines.size(); ++i) {
    const auto& [a, b] = mesh.lines[i].nodes;
    if (a == b || (mesh.nodes[a] - mesh.nodes[b]).norm() <= shortest)
      throw core::Error(fmt::format("{} has no length; remove it from the mesh",
                                    describe_line(mesh, static_cast<Index>(i))));
  }
}

Groups renumbered(const Groups& groups, const std::vector<Index>& new_number) {
  Groups result;
  for (const auto& [name, members] : groups) {
    auto& group = result[name];
    for (const Index member : members)
      group.push_back(new_number[member]);
    std::sort(group.begin(), group.end());
    group.erase(std::unique(group.begin(), group.end()), group.end());
  }
  return result;
}

/// -1 for what has no new number.
std::vector<Index> inverse(const std::vector<Index>& old_number, std::size_t old_count) {
  std::vector<Index> result(old_count, -1);
  for (std::size_t i = 0; i < old_number.size(); ++i)
    result[old_number[i]] = static_cast<Index>(i);
  return result;
}

/// Every line of order 2 by two straight ones.
void straighten(RawMesh& mesh) {
  std::vector<Index> second(mesh.lines.size(), -1);
  for (std::size_t i = 0; i < second.size(); ++i) {
    const RawLine line = mesh.lines[i];
    if (line.middle < 0)
      continue;
    second[i] = static_cast<Index>(mesh.lines.size());
    mesh.lines[i] = {{line.nodes[0], line.middle}};
    mesh.lines.push_back({{line.middle, line.nodes[1]}});
  }
  for (auto& [name, lines] : mesh.curves)
    for (std::size_t i = 0, count = lines.size(); i < count; ++i)
      if (const Index added = second[lines[i]]; added >= 0)
        lines.push_back(added);
}

/// 1 for the middle nodes, which only say where a line passes.
std::vector<char> middle_nodes(const RawMesh& mesh) {
  std::vector<char> middle(mesh.nodes.size(), 0);
  for (const RawLine& line : mesh.lines)
    if (line.middle >= 0)
      middle[line.middle] = 1;
  const auto check = [&](Index node, const std::string& what) {
    if (!middle[node])
      return;
    const Vec3& x = mesh.nodes[node];
    throw core::Error(fmt::format(
        "{} at ({:.6g}, {:.6g}, {:.6g}) is the middle of a line of order 2, which only says where the "
        "line passes; mesh so that it is an end of lines, or set [mesh] order = 1",
        what, x.x(), x.y(), x.z()));
  };
  for (const auto& [name, nodes] : mesh.points)
    for (const Index node : nodes)
      check(node, "the point \"" + name + "\"");
  for (std::size_t i = 0; i < mesh.lines.size(); ++i)
    for (const Index node : mesh.lines[i].nodes)
      check(node, "the end of " + describe_line(mesh, static_cast<Index>(i)));
  return middle;
}

LineMesh ordered(const RawMesh& raw) {
  const std::vector<char> middle = middle_nodes(raw);
  CanonicalOrder order = canonical_order(raw.nodes, raw.lines, group_labels(raw));
  std::erase_if(order.nodes, [&](Index node) { return middle[node] != 0; });
  const std::vector<Index> new_node = inverse(order.nodes, raw.nodes.size()),
                           new_line = inverse(order.lines, raw.lines.size());
  LineMesh mesh;
  for (const Index old : order.nodes)
    mesh.nodes.push_back(raw.nodes[old]);
  for (std::size_t i = 0; i < order.lines.size(); ++i) {
    const RawLine& old = raw.lines[order.lines[i]];
    Line line{{new_node[old.nodes[0]], new_node[old.nodes[1]]}};
    if (old.middle >= 0)
      line.middle = raw.nodes[old.middle];
    if (order.reversed[i])
      std::swap(line.nodes[0], line.nodes[1]);
    mesh.lines.push_back(line);
  }
  mesh.points = renumbered(raw.points, new_node);
  mesh.curves = renumbered(raw.curves, new_line);
  for (const auto& [first, second] : near_pairs(mesh.nodes, coincidence * extent(mesh.nodes)))
    mesh.coincident.push_back({first, second});
  return mesh;
}

LineMesh prepared(RawMesh raw, const Source& source) {
  check_content(raw);
  scale_nodes(raw, source.scale);
  const std::size_t dropped = drop_orphans(raw);
  check_lengths(raw);
  std::size_t merged = 0;
  if (source.merge_tolerance > 0.0) {
    merged = merge_nodes(raw, source.merge_tolerance);
    drop_orphans(raw); // the nodes that went by merging
  }
  if (source.order == 1)
    straighten(raw);
  const auto curved = [](const RawLine& line) { return line.middle >= 0; };
  if (source.order == 2 && !std::any_of(raw.lines.begin(), raw.lines.end(), curved))
    throw core::Error("order = 2, but the file has lines of order 1 only; mesh it with order 2 (gmsh: "
                      "Mesh.ElementOrder = 2), or leave order out");
  LineMesh mesh = ordered(raw);
  mesh.dropped_nodes = dropped;
  mesh.merged_nodes = merged;
  mesh.ignored_elements = raw.ignored_elements;
  return mesh;
}

} // namespace

LineMesh read(const Source& source) {
  check_source(source);
  RawMesh raw = read_raw(source);
  try {
    return prepared(std::move(raw), source);
  } catch (const core::Error& error) {
    throw core::Error(source.file.string() + ": " + error.what());
  }
}

} // namespace fretwork::mesh
