// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/hash.hpp"
#include <array>
#include <fstream>
#include <memory>
#include <new>
#include <openssl/evp.h>
#include <vector>

namespace fretwork::core {
namespace {

constexpr std::size_t block_bytes = std::size_t{1} << 20; ///< read at a time

/// OpenSSL's calls fail for want of memory only.
void require(int success) {
  if (success != 1)
    throw std::bad_alloc();
}

class Digest {
public:
  Digest() { require(EVP_DigestInit_ex(state_.get(), EVP_sha256(), nullptr)); }
  void add(const char* bytes, std::size_t count) { require(EVP_DigestUpdate(state_.get(), bytes, count)); }
  [[nodiscard]] std::string hexadecimal() && {
    std::array<unsigned char, sha256_digits / 2> digest{};
    require(EVP_DigestFinal_ex(state_.get(), digest.data(), nullptr));
    std::string hex;
    for (const unsigned char byte : digest) {
      constexpr const char* digits = "0123456789abcdef";
      hex += digits[byte / 16];
      hex += digits[byte % 16];
    }
    return hex;
  }

private:
  std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)> state_{EVP_MD_CTX_new(), &EVP_MD_CTX_free};
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
