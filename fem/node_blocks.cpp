// SPDX-License-Identifier: GPL-3.0-or-later
#include "fem/node_blocks.hpp"
#include "fem/beam_element.hpp"
#include <algorithm>
#include <cassert>
#include <utility>

namespace fretwork::fem {
namespace {

using Pair = std::pair<Index, Index>; // node positions

template <class Item> const Item& at(const std::vector<Item>& items, Index number) {
  return items[static_cast<std::size_t>(number)];
}

void sort_once(std::vector<Pair>& pairs) {
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
}

/// Pairs of different node positions joined by a beam or a spring, both ways, sorted, each once.
std::vector<Pair> neighbour_pairs(const Model& model, const Structure& structure, Index first, Index last) {
  std::vector<Pair> pairs;
  const auto add = [&](Index node_a, Index node_b) {
    const Index a = position_of(structure, node_a), b = position_of(structure, node_b);
    if (a >= first && a < last)
      pairs.emplace_back(a, b);
    if (b >= first && b < last)
      pairs.emplace_back(b, a);
  };
  for (const Index i : structure.beams)
    add(at(model.beams, i).a, at(model.beams, i).b);
  for (const Index i : structure.springs)
    if (at(model.springs, i).other >= 0)
      add(at(model.springs, i).node, at(model.springs, i).other);
  sort_once(pairs);
  return pairs;
}

/// Fills the blocks of one range of rows.
class Builder {
public:
  Builder(const Model& model, const Structure& structure, Index first, Index last)
      : model_(model), structure_(structure), last_(last) {
    blocks_.first = first;
    std::vector<Pair> pairs = neighbour_pairs(model, structure, first, last);
    for (Index row = first; row < last; ++row)
      pairs.emplace_back(row, row);
    std::sort(pairs.begin(), pairs.end());
    blocks_.start.assign(static_cast<std::size_t>(last - first) + 1, 0);
    for (const auto& [row, column] : pairs) {
      ++blocks_.start[static_cast<std::size_t>(row - first) + 1];
      blocks_.column.push_back(column);
    }
    for (std::size_t i = 1; i < blocks_.start.size(); ++i)
      blocks_.start[i] += blocks_.start[i - 1];
    blocks_.stiffness.assign(pairs.size(), Matrix6::Zero());
    blocks_.mass.assign(pairs.size(), Matrix6::Zero());
  }

  NodeBlocks build() {
    for (const Index i : structure_.beams)
      add_beam(at(model_.beams, i));
    for (const Index i : structure_.masses)
      add_mass(at(model_.masses, i));
    for (const Index i : structure_.springs)
      add_spring(at(model_.springs, i));
    return std::move(blocks_);
  }

private:
  [[nodiscard]] bool owns(Index position) const { return position >= blocks_.first && position < last_; }

  [[nodiscard]] std::size_t block(Index row, Index column) const {
    const auto i = static_cast<std::size_t>(row - blocks_.first);
    const auto begin = blocks_.column.begin() + static_cast<std::ptrdiff_t>(blocks_.start[i]);
    const auto end = blocks_.column.begin() + static_cast<std::ptrdiff_t>(blocks_.start[i + 1]);
    const auto found = std::lower_bound(begin, end, column);
    assert(found != end && *found == column);
    return static_cast<std::size_t>(found - blocks_.column.begin());
  }

  void add_beam(const Beam& beam) {
    const std::array<Index, 2> ends{position_of(structure_, beam.a), position_of(structure_, beam.b)};
    if (!owns(ends[0]) && !owns(ends[1]))
      return;
    const BeamElement element(model_, beam);
    const Matrix12 stiffness = element.stiffness(), mass = element.mass();
    for (int i = 0; i < 2; ++i)
      for (int j = 0; j < 2 && owns(ends[static_cast<std::size_t>(i)]); ++j) {
        const std::size_t where = block(ends[static_cast<std::size_t>(i)], ends[static_cast<std::size_t>(j)]);
        blocks_.stiffness[where] += stiffness.block<6, 6>(6 * i, 6 * j);
        blocks_.mass[where] += mass.block<6, 6>(6 * i, 6 * j);
      }
  }

  void add_mass(const LumpedMass& body) {
    if (const Index row = position_of(structure_, body.node); owns(row))
      blocks_.mass[block(row, row)] += lumped_mass_matrix(body);
  }

  void add_spring(const Spring& spring) {
    const Eigen::Map<const Eigen::Matrix<double, 6, 1>> k(spring.stiffness.data());
    const Index a = position_of(structure_, spring.node);
    const Index b = spring.other < 0 ? -1 : position_of(structure_, spring.other);
    for (const Index row : {a, b}) {
      if (!owns(row))
        continue;
      blocks_.stiffness[block(row, row)].diagonal() += k;
      if (b >= 0)
        blocks_.stiffness[block(row, row == a ? b : a)].diagonal() -= k;
    }
  }

  const Model& model_;
  const Structure& structure_;
  Index last_;
  NodeBlocks blocks_;
};

} // namespace

NodeBlocks node_blocks(const Model& model, const Structure& structure, Index first, Index last) {
  return Builder(model, structure, first, last).build();
}

bool is_chain(const Model& model, const Structure& structure) {
  const auto count = static_cast<Index>(structure.nodes.size());
  std::vector<int> neighbours(structure.nodes.size());
  std::vector<Pair> pairs = neighbour_pairs(model, structure, 0, count);
  for (const Index i : structure.ties) {
    const Index a = position_of(structure, at(model.ties, i).node),
                b = position_of(structure, at(model.ties, i).other);
    pairs.emplace_back(a, b);
    pairs.emplace_back(b, a);
  }
  if (!structure.ties.empty())
    sort_once(pairs);
  for (const auto& [node, other] : pairs)
    if (node != other && ++neighbours[static_cast<std::size_t>(node)] > 2)
      return false;
  return true;
}

} // namespace fretwork::fem
