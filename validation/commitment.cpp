// SPDX-License-Identifier: Apache-2.0
#include "validation/commitment.h"

#include <nettle/sha2.h>
#include <sys/random.h>

#include <array>
#include <cerrno>
#include <cstdint>
#include <span>
#include <system_error>
#include <utility>

namespace navcal::validation {
namespace {

std::string hexadecimal(std::span<const unsigned char> bytes) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string text;
  for (const unsigned char byte : bytes) {
    text += kDigits[byte >> 4U];
    text += kDigits[byte & 0xFU];
  }
  return text;
}

std::string fresh_salt() {
  std::array<unsigned char, 32> bytes{};
  // So few bytes come whole, or not at all (getrandom(2)).
  while (::getrandom(bytes.data(), bytes.size(), 0) < 0) {
    if (errno != EINTR) throw std::system_error(errno, std::system_category(), "getrandom");
  }
  return hexadecimal(bytes);
}

}  // namespace

std::string sha256_of(std::string_view text) {
  sha256_ctx context;
  sha256_init(&context);
  sha256_update(&context, text.size(), reinterpret_cast<const std::uint8_t*>(text.data()));
  std::array<unsigned char, SHA256_DIGEST_SIZE> digest{};
  sha256_digest(&context, digest.size(), digest.data());
  return hexadecimal(digest);
}

Commitment commitment_to(std::string truth) {
  Commitment seal{std::move(truth), fresh_salt(), {}};
  seal.digest = sha256_of(seal.truth + seal.salt);
  return seal;
}

}  // namespace navcal::validation
