// SPDX-License-Identifier: GPL-3.0-or-later
#include "modal/basis.hpp"
#include <algorithm>

namespace fretwork::modal {

Eigen::Index Basis::row_of(core::Index node) const {
  const auto found = std::lower_bound(nodes.begin(), nodes.end(), node);
  return found != nodes.end() && *found == node ? (found - nodes.begin()) * core::dofs_per_node : -1;
}

std::optional<std::size_t> structure_of(const std::vector<Basis>& bases, core::Index node) {
  const auto found =
      std::find_if(bases.begin(), bases.end(), [&](const Basis& basis) { return basis.row_of(node) >= 0; });
  if (found == bases.end())
    return std::nullopt;
  return static_cast<std::size_t>(found - bases.begin());
}

} // namespace fretwork::modal
