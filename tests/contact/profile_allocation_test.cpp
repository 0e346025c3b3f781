// SPDX-License-Identifier: GPL-3.0-or-later
// Looking up a profile allocates nothing: counted by an operator new of its own.
#include "contact/obstacle.hpp"
#include "profile_holes.hpp"
#include <atomic>
#include <cstdlib>
#include <gtest/gtest.h>
#include <new>

using namespace fretwork;
using contact::Profile;
using namespace fretwork::tests::holes;

namespace {
std::atomic<long> allocations{0};
} // namespace

[[gnu::noinline]] void* operator new(std::size_t size) {
  ++allocations;
  if (void* p = std::malloc(size))
    return p;
  throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* p) noexcept { std::free(p); }
[[gnu::noinline]] void operator delete(void* p, std::size_t) noexcept { std::free(p); }

TEST(Profile, LooksUpWithoutAllocating) {
  for (const Profile& profile : all()) {
    const long before = allocations;
    for (int i = 0; i < 100; ++i)
      EXPECT_FALSE(std::isnan(profile.locate(0.02 * i - 1.0, 0.03 * i - 1.5).gap));
    EXPECT_EQ(allocations, before);
  }
}
