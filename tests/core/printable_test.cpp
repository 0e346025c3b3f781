// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/printable.hpp"
#include <gtest/gtest.h>

namespace printable_test {

using fretwork::core::printable;

TEST(Printable, KeepsLinesAndCharactersOfAllLanguages) {
  EXPECT_EQ(printable("a\nt\xc3\xb4le\n\n", 100), "a\nt\xc3\xb4le\n\n");
  EXPECT_EQ(printable("", 100), "");
}

TEST(Printable, ShowsControlCharacters) {
  EXPECT_EQ(printable("\x1b]0;title\x07\x7f\r", 100), "\\x1b]0;title\\x07\\x7f\\x0d");
  EXPECT_EQ(printable("\xc2\x9b"
                      "31m",
                      100),
            "\\xc2\\x9b31m")
      << "CSI in one character of UTF-8";
}

TEST(Printable, ShortensLongLinesAtACharacter) {
  EXPECT_EQ(printable(std::string(10, 'x') + "\nshort", 4), "xxxx... (6 more bytes)\nshor... (1 more bytes)");
  EXPECT_EQ(printable("abc\xc3\xb4", 4), "abc... (2 more bytes)");
}

} // namespace printable_test
