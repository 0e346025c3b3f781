// SPDX-License-Identifier: GPL-3.0-or-later
// Files of HDF5 that are read back (modes.h5, results.h5, checkpoint.h5): whole files in which attributes and datasets are missing, or of
// another type, shape and content, under a checksum that fits. The readers give a value or a refusal. HDF5's own format is not altered:
// files that are no HDF5 are stopped by the checksum before the library sees them.
//
// The first byte says which file, and which export of results.h5; the others are edits (hdf5_edits.hpp).
#include "core/error.hpp"
#include "core/temporary_directory.hpp"
#include "hdf5_edits.hpp"
#include "results/checkpoint.hpp"
#include "results/write.hpp"
#include "synthetic.hpp"
#include <cstdlib>

namespace {

using namespace fretwork;

constexpr const char* key = "fuzz";
const results::RunIdentity identity{"1", "2", 3, "4"};

struct Files {
  core::TemporaryDirectory folder;
  std::filesystem::path modes_file = folder.path() / "modes.h5", results_file = folder.path() / "results.h5",
                        checkpoint_file = folder.path() / "checkpoint.h5";
  fuzz::Hdf5Edits modes, results, checkpoint;

  Files() {
    results::RunResults run = results::made_up({.contacts = 1, .outputs = 4, .modes = 2, .elements = 2});
    run.wear = results::made_up_wear(run);
    results::write_bases(modes_file, run.record, run.bases, key, run.nodes, run.lines);
    modes.load(modes_file);
    std::filesystem::remove(modes_file);
    results::write_archive(results_file, run);
    results.load(results_file);
    results::write_checkpoint(checkpoint_file, identity, {0.5, "state"});
    checkpoint.load(checkpoint_file);
  }
};

void check(bool holds) {
  if (!holds)
    std::abort();
}

/// What the exports rely on.
void check_modes(const std::vector<modal::Basis>& bases) {
  for (const modal::Basis& basis : bases) {
    check(basis.shapes.cols() == basis.size() && basis.damping.size() == basis.size());
    check(basis.shapes.rows() == static_cast<Eigen::Index>(6 * basis.nodes.size()));
  }
}

void fuzz_checkpoint(const Files& files, std::span<const std::uint8_t> edits) {
  files.checkpoint.write(files.checkpoint_file, edits);
  const auto found = results::read_checkpoint(files.checkpoint_file, identity);
  check(found.checkpoint.has_value() == found.refusal.empty());
}

void fuzz_modes(const Files& files, std::span<const std::uint8_t> edits) {
  files.modes.write(files.modes_file, edits);
  if (const auto found = results::read_bases(files.modes_file, key); found.bases)
    check_modes(*found.bases);
  std::filesystem::remove(files.modes_file);
}

void fuzz_exports(const Files& files, std::span<const std::uint8_t> edits, int format) {
  files.results.write(files.results_file, edits);
  try {
    const results::RunResults run = results::read_archive(files.folder.path());
    check_modes(run.bases);
    const results::OutputWindow all;
    if (format == 0)
      results::export_csv(files.folder.path(), run);
    else if (format == 1)
      (void)results::export_vtu(files.folder.path(), run, all);
    else
      results::export_msh(files.folder.path(), run);
  } catch (const core::Error&) {
  }
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  static const Files files;
  if (size == 0)
    return 0;
  const std::span<const std::uint8_t> edits(bytes + 1, size - 1);
  const int kind = bytes[0] % 5;
  if (kind == 0)
    fuzz_checkpoint(files, edits);
  else if (kind == 1)
    fuzz_modes(files, edits);
  else
    fuzz_exports(files, edits, kind - 2);
  return 0;
}
