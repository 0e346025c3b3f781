// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/msh_elements.hpp"
#include <algorithm>

namespace fretwork::mesh {
namespace {

constexpr int line_type = 1, line3_type = 8, point_type = 15;

/// Number of nodes of gmsh's element types (0: not a type we know); lines of order 3 and more are 26 to 28
/// and 62 to 66.
int nodes_of_type(int type) {
  static constexpr int nodes[] = {0, 2,  3,  4,  4, 8,  6,  5,  3,  6,  9, 10, 27, 18, 14, 1,
                                  8, 20, 15, 13, 9, 10, 12, 15, 15, 21, 4, 5,  6,  20, 35, 56};
  if (type == 92)
    return 64;
  if (type == 93)
    return 125;
  return type >= 0 && type < static_cast<int>(std::size(nodes)) ? nodes[type] : 0;
}

bool is_high_order_line(int type) { return (type >= 26 && type <= 28) || (type >= 62 && type <= 66); }

} // namespace

void MshNodes::reserve(std::size_t count) {
  positions_.reserve(positions_.size() + count);
  // Tags of a compact file, with room for some that were deleted.
  dense_.resize(std::max(dense_.size(), 4 * count + 1024), -1);
}

Index MshNodes::number(std::size_t tag) const {
  if (tag < dense_.size())
    return dense_[tag];
  const auto found = sparse_.find(tag);
  return found == sparse_.end() ? -1 : found->second;
}

void MshNodes::add(const MshScanner& in, std::size_t tag, const Vec3& position) {
  if (number(tag) >= 0)
    in.fail("node " + std::to_string(tag) + " is given twice");
  const auto index = static_cast<Index>(positions_.size());
  if (tag < dense_.size())
    dense_[tag] = index;
  else
    sparse_[tag] = index;
  positions_.push_back(position);
}

Index MshNodes::find(const MshScanner& in, std::size_t tag) const {
  const Index index = number(tag);
  if (index < 0)
    in.fail("an element has node " + std::to_string(tag) + ", which the file does not define");
  return index;
}

std::size_t MshElements::LineKeyHash::operator()(const LineKey& key) const {
  std::uint64_t hash = 0;
  for (const Index value : key.values)
    hash = (hash ^ static_cast<std::uint32_t>(value)) * 0x9E3779B97F4A7C15u, hash ^= hash >> 32;
  return hash;
}

void MshElements::name_group(int dimension, int tag, const std::string& name) {
  if (dimension == 0 || dimension == 1)
    names_[static_cast<std::size_t>(dimension)][tag] = name;
}

void MshElements::begin(int type, int entity, std::span<const int> physical) {
  if (is_high_order_line(type))
    in_.fail("lines of order 3 or more are not read; set Mesh.ElementOrder = 1 or 2");
  type_ = type;
  entity_ = entity;
  physical_ = physical;
  node_count_ = nodes_of_type(type);
  added_ = 0;
  if (node_count_ == 0)
    in_.fail("element type " + std::to_string(type) + " is not known");
}

void MshElements::add_node(std::size_t tag) {
  if (type_ == line_type || type_ == line3_type || type_ == point_type)
    element_nodes_[static_cast<std::size_t>(added_++)] = nodes_.find(in_, tag);
}

void MshElements::add_line() {
  const auto [a, b, middle] =
      std::array{element_nodes_[0], element_nodes_[1], type_ == line3_type ? element_nodes_[2] : Index{-1}};
  const LineKey key{{entity_, std::min(a, b), std::max(a, b), middle}};
  const auto [entry, is_new] = line_of_.try_emplace(key, static_cast<Index>(mesh_.lines.size()));
  if (is_new)
    mesh_.lines.push_back({{a, b}, middle});
  for (const int tag : physical_)
    groups_[1][tag].push_back(entry->second);
}

void MshElements::end() {
  if (type_ == line_type || type_ == line3_type)
    add_line();
  else if (type_ == point_type)
    for (const int tag : physical_)
      groups_[0][tag].push_back(element_nodes_[0]);
  else
    ++mesh_.ignored_elements;
}

RawMesh MshElements::finish() {
  mesh_.nodes = nodes_.release();
  for (std::size_t dimension = 0; dimension < 2; ++dimension) {
    Groups& groups = dimension == 0 ? mesh_.points : mesh_.curves;
    for (const auto& [tag, name] : names_[dimension])
      groups[name]; // a group that is named exists, if empty
    for (const auto& [tag, members] : groups_[dimension]) {
      const auto named = names_[dimension].find(tag);
      auto& group = groups[named == names_[dimension].end() ? std::to_string(tag) : named->second];
      group.insert(group.end(), members.begin(), members.end());
    }
  }
  return std::move(mesh_);
}

} // namespace fretwork::mesh
