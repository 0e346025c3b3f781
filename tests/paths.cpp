// SPDX-License-Identifier: GPL-3.0-or-later
#include "paths.hpp"

namespace fretwork::test_paths {

std::filesystem::path source_dir() { return FRETWORK_SOURCE_DIR; }
std::filesystem::path binary_dir() { return FRETWORK_BINARY_DIR; }

} // namespace fretwork::test_paths
