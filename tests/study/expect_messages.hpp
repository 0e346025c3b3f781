// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// What the program answers to a wrong study: one line of a study that is right is replaced, and the message
/// must start with the file and the line, then name key, value and cure.
#pragma once
#include "folder.hpp"
#include <algorithm>
#include <gtest/gtest.h>

namespace fretwork::study {

struct Case {
  std::string line;                  ///< of full_study, its first occurrence
  std::string instead;               ///< may be several lines
  std::vector<std::string> expected; ///< parts of the message
  std::string named_line = {};       ///< what the message names, where it is not `line`
  int shift = 0;                     ///< lines from there to the line named
};

inline void expect_messages(const std::vector<Case>& cases) {
  const std::string before = "\n" + full_study; // so that every line has an end in front of it
  for (const Case& c : cases) {
    const auto at = before.find("\n" + c.line + "\n");
    const auto named = c.named_line.empty() ? at : before.find("\n" + c.named_line + "\n");
    ASSERT_NE(at, std::string::npos) << c.line;
    ASSERT_NE(named, std::string::npos) << c.named_line;
    std::string text = before;
    text.replace(at + 1, c.line.size(), c.instead).erase(0, 1);
    const auto line = 1 + std::count(before.begin(), before.begin() + named, '\n') + c.shift;
    const std::string message = message_of(text);
    EXPECT_TRUE(message.starts_with("study.toml:" + std::to_string(line) + ": ")) << c.instead << "\n"
                                                                                  << message;
    for (const std::string& part : c.expected)
      EXPECT_NE(message.find(part), std::string::npos) << message << "\nlacks: " << part;
  }
}

} // namespace fretwork::study
