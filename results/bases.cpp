// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/error.hpp"
#include "results/basis_file.hpp"
#include "results/write.hpp"
#include <fmt/format.h>

namespace fretwork::results {

namespace fs = std::filesystem;

void write_bases(const fs::path& file, const RunRecord& record, const std::vector<modal::Basis>& bases,
                 const std::string& key, const std::vector<core::Vec3>& nodes,
                 const std::vector<std::array<core::Index, 2>>& lines) {
  const h5::Quiet quiet;
  write_whole(file, [&](const fs::path& part) {
    try {
      const h5::Group root = h5::Group::create_file(part);
      write_record(root, record);
      root.set("key", key);
      if (!nodes.empty())
        write_mesh(root, nodes, lines);
      write_modes(root, bases);
      root.flush();
    } catch (const h5::Failure& failure) {
      throw core::Error(
          fmt::format("{}: cannot be written ({}); check the folder, its permissions and the space left",
                      file.string(), failure.what()));
    }
  });
}

std::optional<std::vector<modal::Basis>> read_bases(const fs::path& file, const std::string& key) {
  const h5::Quiet quiet;
  try {
    const h5::Group root = h5::Group::open_file(file);
    if (root.text("key") != key)
      return std::nullopt;
    return read_modes(root);
  } catch (const std::exception&) {
    return std::nullopt; // no file, not one of ours or damaged (sizes beyond memory included): the modes are
                         // computed
  }
}

} // namespace fretwork::results
