// SPDX-License-Identifier: GPL-3.0-or-later
// The main of every test executable that has none of its own: sets what child processes and MPI need, where
// the caller has not.
#include "paths.hpp"
#include <cstdlib>
#include <gtest/gtest.h>

int main(int argc, char** argv) {
  setenv("FRETWORK_GEOMETRY", (fretwork::test_paths::binary_dir() / "bin" / "fretwork-geometry").c_str(), 0);
  setenv("OMPI_ALLOW_RUN_AS_ROOT", "1", 0);
  setenv("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1", 0);
  setenv("OMPI_MCA_rmaps_base_oversubscribe", "1", 0);
  setenv("OMPI_MCA_btl_vader_single_copy_mechanism", "none", 0);
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
