// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The message of a core::Error.
#pragma once
#include "core/error.hpp"
#include <gtest/gtest.h>
#include <string>
#include <vector>

namespace fretwork::tests {

/// Expects core::Error whose message contains every part.
template <class Work> void expect_error(const Work& work, const std::vector<std::string>& parts) {
  try {
    work();
    ADD_FAILURE() << "no error";
  } catch (const core::Error& error) {
    for (const std::string& part : parts)
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos)
          << "\"" << part << "\" in: " << error.what();
  }
}

} // namespace fretwork::tests
