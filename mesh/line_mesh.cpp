// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/line_mesh.hpp"
#include "core/error.hpp"
#include "core/names.hpp"
#include <algorithm>

namespace fretwork::mesh {
namespace {

[[noreturn]] void fail_empty(const std::string& group, const std::string& what) {
  throw core::Error(what + ": the group \"" + group +
                    "\" is empty: the mesh names it, but no element is in it (was it meshed and saved?)");
}

} // namespace

std::vector<std::string> group_names(const LineMesh& mesh) {
  std::vector<std::string> names;
  for (const auto& [name, nodes] : mesh.points)
    names.push_back(name);
  for (const auto& [name, lines] : mesh.curves)
    if (!mesh.points.contains(name))
      names.push_back(name);
  return names;
}

std::vector<Index> group_nodes(const LineMesh& mesh, const std::string& group, const std::string& what) {
  const auto point = mesh.points.find(group);
  const auto curve = mesh.curves.find(group);
  if (point == mesh.points.end() && curve == mesh.curves.end())
    throw core::Error(what + ": the mesh has no group \"" + group + "\"" +
                      core::name_help(group, group_names(mesh), "groups of the mesh"));
  std::vector<Index> nodes;
  if (point != mesh.points.end())
    nodes = point->second;
  if (curve != mesh.curves.end())
    for (const Index i : curve->second) {
      const Line& line = mesh.lines[i];
      nodes.insert(nodes.end(), line.nodes.begin(), line.nodes.end());
    }
  if (nodes.empty())
    fail_empty(group, what);
  // Nodes are numbered along the walk: ascending numbers are the walking order.
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

std::vector<Index> group_lines(const LineMesh& mesh, const std::string& group, const std::string& what) {
  const auto curve = mesh.curves.find(group);
  if (curve == mesh.curves.end()) {
    if (mesh.points.contains(group))
      throw core::Error(what + ": the group \"" + group +
                        "\" is a physical point; a physical curve is needed here");
    std::vector<std::string> curves;
    for (const auto& [name, lines] : mesh.curves)
      curves.push_back(name);
    throw core::Error(what + ": the mesh has no curve \"" + group + "\"" +
                      (curves.empty()
                           ? ", for it names no curves; in gmsh: Physical Curve(\"" + group + "\") = {...};"
                           : core::name_help(group, curves, "curves of the mesh")));
  }
  if (curve->second.empty())
    fail_empty(group, what);
  return curve->second;
}

} // namespace fretwork::mesh
