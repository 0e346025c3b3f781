// SPDX-License-Identifier: GPL-3.0-or-later
/// Writes made-up results into a folder: write_made_up DIR CONTACTS OUTPUTS STRUCTURES [wear]; prints the
/// terminal table.
#include "results/write.hpp"
#include "synthetic.hpp"
#include <cstdio>
#include <cstdlib>

int main(int argc, char** argv) {
  if (argc != 5 && argc != 6) {
    std::fprintf(stderr, "usage: write_made_up DIR CONTACTS OUTPUTS STRUCTURES [wear]\n");
    return 1;
  }
  const std::filesystem::path directory = argv[1];
  auto results =
      fretwork::results::made_up({std::atoi(argv[2]), std::atol(argv[3]), std::atoi(argv[4]), 12, 90});
  if (argc == 6)
    results.wear = fretwork::results::made_up_wear(results);
  fretwork::results::write_archive(directory / "results.h5", results);
  fretwork::results::write_summary(directory / "summary.json", results);
  std::fputs(fretwork::results::terminal_table(results, directory).c_str(), stdout);
}
