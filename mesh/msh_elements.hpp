// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// What the reader of .msh files collects: nodes by their tag, elements by their type, groups by their
/// physical tag.
#pragma once
#include "mesh/msh_scanner.hpp"
#include "mesh/raw_mesh.hpp"
#include <array>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <unordered_set>

namespace fretwork::mesh {

/// Nodes in the order of the file, found by their tag.
class MshNodes {
public:
  void reserve(std::size_t count);
  /// @throws core::Error (through `in`) where the tag was given before
  void add(const MshScanner& in, std::size_t tag, const Vec3& position);
  /// Number of the node of this tag.
  /// @throws core::Error (through `in`) where there is none
  [[nodiscard]] Index find(const MshScanner& in, std::size_t tag) const;
  [[nodiscard]] std::vector<Vec3>&& release() { return std::move(positions_); }

private:
  [[nodiscard]] Index number(std::size_t tag) const;

  std::vector<Vec3> positions_;
  std::vector<Index> dense_; ///< by tag, as far as tags are not much larger than the number of nodes
  std::unordered_map<std::size_t, Index> sparse_; ///< the other tags
};

/// Elements, one at a time: begin, node_count() times add_node, end.
class MshElements {
public:
  MshElements(const MshScanner& in, MshNodes& nodes) : in_(in), nodes_(nodes) {}

  /// Dimensions other than 0 and 1 are passed over.
  void name_group(int dimension, int tag, const std::string& name);
  /// @param type      gmsh's number of the element's shape
  /// @param entity    curve of the element; two lines of one entity over the same nodes are one
  /// @param physical  tags of the groups it belongs to, > 0
  void begin(int type, int entity, std::span<const int> physical);
  [[nodiscard]] int node_count() const { return node_count_; }
  void add_node(std::size_t tag);
  void end();
  /// All that was collected; the groups under their names.
  [[nodiscard]] RawMesh finish();

private:
  struct LineKey {
    std::array<Index, 4> values; ///< entity, smaller end, larger end, middle
    bool operator==(const LineKey&) const = default;
  };
  struct LineKeyHash {
    std::size_t operator()(const LineKey& key) const;
  };
  using ByTag = std::unordered_map<int, std::vector<Index>>;

  void add_line();

  const MshScanner& in_;
  MshNodes& nodes_;
  RawMesh mesh_;
  int type_ = 0;
  int entity_ = 0;
  int node_count_ = 0;
  std::span<const int> physical_;
  std::array<Index, 3> element_nodes_{};
  int added_ = 0;
  std::unordered_map<LineKey, Index, LineKeyHash> line_of_;
  std::array<ByTag, 2> groups_;
  std::array<std::unordered_map<int, std::string>, 2> names_;
};

} // namespace fretwork::mesh
