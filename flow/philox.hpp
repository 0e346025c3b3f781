// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Philox4x32-10, a counter-based generator: four words of 32 bits that depend on a counter and a key alone, so that any number of a
/// sequence is found without those before it.
/// Ten rounds of (c0, c1, c2, c3) <- (hi(M1 c2) ^ c1 ^ k0, lo(M1 c2), hi(M0 c0) ^ c3 ^ k1, lo(M0 c0)); after each (k0, k1) += (W0, W1).
/// Source: J. Salmon, M. Moraes, R. Dror, D. Shaw, Parallel random numbers: as easy as 1, 2, 3, SC11 (2011).
#pragma once
#include <array>
#include <cstdint>

namespace fretwork::flow {

struct PhiloxConstants {
  static constexpr int rounds = 10;
  static constexpr std::uint32_t m0 = 0xD2511F53, m1 = 0xCD9E8D57, w0 = 0x9E3779B9, w1 = 0xBB67AE85;
};

[[nodiscard]] constexpr std::array<std::uint32_t, 4> philox(std::array<std::uint32_t, 4> c,
                                                            std::array<std::uint32_t, 2> k) {
  using P = PhiloxConstants;
  for (int round = 0; round < P::rounds; ++round) {
    const std::uint64_t a = std::uint64_t{P::m0} * c[0], b = std::uint64_t{P::m1} * c[2];
    c = {static_cast<std::uint32_t>(b >> 32) ^ c[1] ^ k[0], static_cast<std::uint32_t>(b),
         static_cast<std::uint32_t>(a >> 32) ^ c[3] ^ k[1], static_cast<std::uint32_t>(a)};
    k = {k[0] + P::w0, k[1] + P::w1};
  }
  return c;
}

} // namespace fretwork::flow
