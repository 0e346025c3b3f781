// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/hash.hpp"
#include <gtest/gtest.h>

namespace hash_test {

// FIPS 180-2, appendix B: the digests of "" and "abc".
TEST(Sha256, AgreesWithTheStandard) {
  EXPECT_EQ(fretwork::core::sha256(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(fretwork::core::sha256("abc"),
            "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
}

} // namespace hash_test
