// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh_text.hpp"
#include <algorithm>
#include <fmt/format.h>

namespace fretwork::app::test {
namespace {

/// Physical groups in the order of their first use; their numbers count from 1.
class Groups {
public:
  int number(int dimension, const std::string& name) {
    const std::pair<int, std::string> group{dimension, name};
    const auto found = std::find(groups_.begin(), groups_.end(), group);
    if (found != groups_.end())
      return static_cast<int>(found - groups_.begin()) + 1;
    groups_.push_back(group);
    return static_cast<int>(groups_.size());
  }
  [[nodiscard]] std::string text() const {
    std::string out = fmt::format("$PhysicalNames\n{}\n", groups_.size());
    for (std::size_t i = 0; i < groups_.size(); ++i)
      out += fmt::format("{} {} \"{}\"\n", groups_[i].first, i + 1, groups_[i].second);
    return out + "$EndPhysicalNames\n";
  }

private:
  std::vector<std::pair<int, std::string>> groups_;
};

} // namespace

std::string MeshText::text() const {
  const auto number = [&](int node) {
    return numbers.empty() ? node + 1 : numbers[static_cast<std::size_t>(node)];
  };
  std::string places = fmt::format("$Nodes\n{}\n", nodes.size());
  for (std::size_t i = 0; i < nodes.size(); ++i)
    places +=
        fmt::format("{} {} {} {}\n", number(static_cast<int>(i)), nodes[i].x(), nodes[i].y(), nodes[i].z());
  std::string elements = fmt::format("$EndNodes\n$Elements\n{}\n", points.size() + lines.size());
  Groups groups;
  int element = 0;
  for (const auto& [group, node] : points)
    elements += fmt::format("{} 15 2 {} 1 {}\n", ++element, groups.number(0, group), number(node));
  for (const Line& line : lines)
    elements += fmt::format("{} 1 2 {} 1 {} {}\n", ++element, groups.number(1, line.group),
                            number(line.nodes[0]), number(line.nodes[1]));
  return "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n" + groups.text() + places + elements + "$EndElements\n";
}

MeshText lone_points(const std::vector<std::string>& names) {
  MeshText mesh;
  for (const std::string& name : names) {
    mesh.points.emplace_back(name, static_cast<int>(mesh.nodes.size()));
    mesh.nodes.emplace_back(static_cast<double>(mesh.nodes.size()), 0.0, 0.0);
  }
  return mesh;
}

MeshText straight_line(const std::string& group, const core::Vec3& a, const core::Vec3& b, int elements) {
  MeshText mesh;
  for (int i = 0; i <= elements; ++i)
    mesh.nodes.push_back(a + (b - a) * i / elements);
  for (int i = 0; i < elements; ++i)
    mesh.lines.push_back({group, {i, i + 1}});
  mesh.points = {{group + "_begin", 0}, {group + "_end", elements}};
  return mesh;
}

MeshText together(const MeshText& a, const MeshText& b) {
  MeshText out = a;
  const int shift = static_cast<int>(a.nodes.size());
  out.nodes.insert(out.nodes.end(), b.nodes.begin(), b.nodes.end());
  for (const auto& [group, node] : b.points)
    out.points.emplace_back(group, node + shift);
  for (const auto& line : b.lines)
    out.lines.push_back({line.group, {line.nodes[0] + shift, line.nodes[1] + shift}});
  return out;
}

} // namespace fretwork::app::test
