// SPDX-License-Identifier: GPL-3.0-or-later
#include "results/basis_file.hpp"
#include "results/write.hpp"
#include <fmt/format.h>

namespace fretwork::results {

namespace fs = std::filesystem;

void write_bases(const fs::path& file, const RunRecord& record, const std::vector<modal::Basis>& bases,
                 const std::string& key, const std::vector<core::Vec3>& nodes,
                 const std::vector<std::array<core::Index, 2>>& lines) {
  h5::write_file(file, [&](const h5::Group& root) {
    write_record(root, record);
    root.set("key", key);
    if (!nodes.empty())
      write_mesh(root, nodes, lines);
    write_modes(root, bases);
  });
}

FoundBases read_bases(const fs::path& file, const std::string& key) {
  std::error_code ignored;
  if (!fs::exists(file, ignored))
    return {};
  const h5::Quiet quiet;
  try {
    const h5::Group root = h5::Group::open_file(file);
    if (root.text("key") != key)
      return {};
    return {read_modes(root), {}};
  } catch (const std::exception& failure) { // sizes beyond memory included
    return {{},
            fmt::format("{} is damaged or of another version ({}): the modes are computed again",
                        file.string(), failure.what())};
  }
}

} // namespace fretwork::results
