// SPDX-License-Identifier: GPL-3.0-or-later
#include "modal/basis.hpp"
#include <algorithm>

namespace fretwork::modal {

Eigen::Index Basis::row_of(core::Index node) const {
  const auto found = std::lower_bound(nodes.begin(), nodes.end(), node);
  return found != nodes.end() && *found == node ? (found - nodes.begin()) * core::dofs_per_node : -1;
}

} // namespace fretwork::modal
