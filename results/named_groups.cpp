// SPDX-License-Identifier: GPL-3.0-or-later
#include "results/named_groups.hpp"
#include "results/text_file.hpp"
#include <algorithm>

namespace fretwork::results {

h5::Group create_named(const h5::Group& parent, const std::string& name, std::size_t index) {
  h5::Group group = parent.create(path_name(name));
  group.set("name", name);
  group.set("index", static_cast<std::int64_t>(index));
  return group;
}

std::vector<h5::Group> in_order(const h5::Group& parent) {
  std::vector<std::pair<std::int64_t, std::string>> order;
  for (const std::string& name : parent.children())
    order.emplace_back(parent.open(name).integer("index"), name);
  std::sort(order.begin(), order.end());
  std::vector<h5::Group> groups;
  for (const auto& entry : order)
    groups.push_back(parent.open(entry.second));
  return groups;
}

} // namespace fretwork::results
