// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Disjoint sets of numbers (union-find): connected parts.
#pragma once
#include "core/types.hpp"
#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

namespace fretwork::fem {

/// The root of a set is its smallest number.
class DisjointSets {
public:
  explicit DisjointSets(std::size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), core::Index{0});
  }

  [[nodiscard]] core::Index root(core::Index i) {
    while (parent(i) != i) {
      parent(i) = parent(parent(i)); // halves the path for the next search
      i = parent(i);
    }
    return i;
  }

  void join(core::Index i, core::Index j) {
    const core::Index a = root(i), b = root(j);
    parent(std::max(a, b)) = std::min(a, b);
  }

  /// For each number, which set it is in: sets are numbered from 0 by their smallest member.
  [[nodiscard]] std::vector<std::size_t> labels(std::size_t& sets) {
    std::vector<std::size_t> label(parent_.size());
    sets = 0;
    for (std::size_t i = 0; i < label.size(); ++i) {
      const auto first = static_cast<std::size_t>(root(static_cast<core::Index>(i)));
      label[i] = first == i ? sets++ : label[first]; // the root comes first
    }
    return label;
  }

private:
  core::Index& parent(core::Index i) { return parent_[static_cast<std::size_t>(i)]; }
  std::vector<core::Index> parent_;
};

} // namespace fretwork::fem
