// SPDX-License-Identifier: GPL-3.0-or-later
#include "results/checkpoint.hpp"
#include "core/error.hpp"
#include "core/hash.hpp"
#include "results/hdf5.hpp"
#include "results/write.hpp"
#include <cstring>
#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

namespace fretwork::results {
namespace {

namespace fs = std::filesystem;

/// A file's bytes, or a folder's names, are on the disk when this returns. Where a file system cannot promise that, there is nothing to do.
void sync_to_disk(const fs::path& path) {
  const int file = ::open(path.c_str(), O_RDONLY);
  if (file < 0)
    return;
  (void)::fsync(file);
  (void)::close(file);
}

} // namespace

void write_checkpoint(const fs::path& file, const RunIdentity& identity, const Checkpoint& checkpoint) {
  const h5::Quiet quiet;
  write_whole(file, [&](const fs::path& part) {
    try {
      const h5::Group root = h5::Group::create_file(part);
      root.set("version", identity.version);
      root.set("input_sha256", identity.input_sha256);
      root.set("run", identity.run);
      root.set("build", identity.build);
      root.set("time", checkpoint.time);
      root.set("state_sha256", core::sha256(checkpoint.state));
      const auto* bytes = reinterpret_cast<const std::uint8_t*>(checkpoint.state.data());
      root.write<std::uint8_t>("state", {bytes, checkpoint.state.size()}, {checkpoint.state.size()}, "");
      root.flush();
    } catch (const h5::Failure& failure) {
      throw core::Error(
          fmt::format("{}: cannot be written ({}); check the folder, its permissions and the space left",
                      file.string(), failure.what()));
    }
    sync_to_disk(part);
  });
  sync_to_disk(file.parent_path());
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
    Checkpoint found{root.number("time"), {reinterpret_cast<const char*>(bytes.data()), bytes.size()}};
    if (core::sha256(found.state) != root.text("state_sha256"))
      return refuse("is damaged");
    return {std::move(found), {}};
  } catch (const std::exception&) { // sizes beyond memory included
    return refuse("is damaged");
  }
}

} // namespace fretwork::results
