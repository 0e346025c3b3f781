// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/share_out.hpp"
#include <algorithm>
#include <numeric>

namespace fretwork::core {

std::vector<int> share_out(const std::vector<double>& costs, int ranks) {
  std::vector<std::size_t> order(costs.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return costs[a] > costs[b]; });
  std::vector<double> load(static_cast<std::size_t>(ranks), 0.0);
  std::vector<int> owner(costs.size());
  for (const std::size_t piece : order) {
    const auto rank = std::min_element(load.begin(), load.end()) - load.begin();
    owner[piece] = static_cast<int>(rank);
    load[static_cast<std::size_t>(rank)] += costs[piece];
  }
  return owner;
}

} // namespace fretwork::core
