// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Where the tests find the sources and what was built. In a file of its own, so that no other object depends on the checkout's place.
#pragma once
#include <filesystem>

namespace fretwork::test_paths {

[[nodiscard]] std::filesystem::path source_dir();
[[nodiscard]] std::filesystem::path binary_dir(); ///< its bin/ holds the executables

} // namespace fretwork::test_paths
