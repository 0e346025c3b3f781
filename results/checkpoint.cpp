// SPDX-License-Identifier: GPL-3.0-or-later
#include "results/checkpoint.hpp"
#include "results/hdf5.hpp"
#include <fmt/format.h>

namespace fretwork::results {

namespace fs = std::filesystem;

void write_checkpoint(const fs::path& file, const RunIdentity& identity, const Checkpoint& checkpoint) {
  h5::write_file(file, [&](const h5::Group& root) {
    root.set("version", identity.version);
    root.set("input_sha256", identity.input_sha256);
    root.set("run", identity.run);
    root.set("build", identity.build);
    root.set("time", checkpoint.time);
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(checkpoint.state.data());
    root.write<std::uint8_t>("state", {bytes, checkpoint.state.size()}, {checkpoint.state.size()}, "");
  });
}

FoundCheckpoint read_checkpoint(const fs::path& file, const RunIdentity& wanted) {
  if (!fs::exists(file))
    return {};
  const auto refuse = [&](const std::string& why) {
    return FoundCheckpoint{{}, fmt::format("{} {}: the run starts again", file.string(), why)};
  };
  const h5::Quiet quiet;
  try {
    const h5::Group root = h5::Group::open_file(file);
    if (const std::string version = root.text("version"); version != wanted.version)
      return refuse(fmt::format("is of version {} of the program, this is {}", version, wanted.version));
    if (root.text("build") != wanted.build)
      return refuse(fmt::format("was written by another build of version {} of the program", wanted.version));
    if (root.text("input_sha256") != wanted.input_sha256 || root.integer("run") != wanted.run)
      return refuse("belongs to other inputs");
    const auto bytes = root.read<std::uint8_t>("state");
    return {Checkpoint{root.number("time"), {reinterpret_cast<const char*>(bytes.data()), bytes.size()}}, {}};
  } catch (const std::exception&) { // sizes beyond memory included
    return refuse("is damaged");
  }
}

} // namespace fretwork::results
