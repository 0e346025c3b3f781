// SPDX-License-Identifier: GPL-3.0-or-later
#include "results/columns_file.hpp"
#include "results/hdf5.hpp"
#include "results/text_file.hpp"

namespace fretwork::results {

void write_columns(const std::filesystem::path& file, const std::map<std::string, std::string>& attributes,
                   const std::vector<NumberColumn>& columns) {
  h5::write_file(file, [&](const h5::Group& root) {
    for (const auto& [name, text] : attributes)
      root.set(name, text);
    std::map<std::string, h5::Group> groups;
    for (const NumberColumn& column : columns) {
      const auto at = groups.find(column.group);
      const h5::Group& group = at != groups.end()
                                   ? at->second
                                   : groups.emplace(column.group, root.create(column.group)).first->second;
      group.write<double>(path_name(column.name), column.values, {column.values.size()}, column.unit);
    }
  });
}

} // namespace fretwork::results
