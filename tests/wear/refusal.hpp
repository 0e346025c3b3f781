// SPDX-License-Identifier: GPL-3.0-or-later
// The message with which wrong input is refused.
#pragma once
#include "core/error.hpp"
#include <gtest/gtest.h>
#include <initializer_list>
#include <string>

namespace fretwork::wear {

template <class F> std::string message_of(F f) {
  try {
    f();
  } catch (const core::Error& error) {
    return error.what();
  }
  return "no error";
}

template <class F> void expect_refused(F f, std::initializer_list<const char*> parts) {
  const std::string message = message_of(f);
  for (const char* part : parts)
    EXPECT_NE(message.find(part), std::string::npos) << "\"" << part << "\" is not in: " << message;
}

} // namespace fretwork::wear
