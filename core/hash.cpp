// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/hash.hpp"
#include <fstream>
#include <sodium.h>
#include <vector>

namespace fretwork::core {
namespace {

constexpr std::size_t block_bytes = std::size_t{1} << 20; ///< read at a time

class Digest {
public:
  Digest() { crypto_hash_sha256_init(&state_); }
  void add(const char* bytes, std::size_t count) {
    crypto_hash_sha256_update(&state_, reinterpret_cast<const unsigned char*>(bytes), count);
  }
  [[nodiscard]] std::string hexadecimal() && {
    unsigned char digest[crypto_hash_sha256_BYTES];
    crypto_hash_sha256_final(&state_, digest);
    char hex[sha256_digits + 1];
    sodium_bin2hex(hex, sizeof hex, digest, sizeof digest);
    return hex;
  }

private:
  crypto_hash_sha256_state state_;
};

} // namespace

std::string sha256(std::string_view bytes) {
  Digest digest;
  digest.add(bytes.data(), bytes.size());
  return std::move(digest).hexadecimal();
}

std::string sha256_of_file(const std::string& file, std::size_t offset) {
  std::ifstream in(file, std::ios::binary);
  if (!in.seekg(static_cast<std::streamoff>(offset)))
    return {};
  Digest digest;
  std::vector<char> block(block_bytes);
  while (in.read(block.data(), static_cast<std::streamsize>(block.size())) || in.gcount() > 0)
    digest.add(block.data(), static_cast<std::size_t>(in.gcount()));
  return in.bad() ? std::string() : std::move(digest).hexadecimal();
}

} // namespace fretwork::core
