// SPDX-License-Identifier: Apache-2.0
#include "validation/commitment.h"

#include <openssl/evp.h>
#include <sys/random.h>

#include <array>
#include <cerrno>
#include <cstdint>
#include <span>
#include <stdexcept>
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
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
  unsigned int length = 0;
  if (::EVP_Digest(text.data(), text.size(), digest.data(), &length, ::EVP_sha256(), nullptr) != 1)
    throw std::runtime_error("libcrypto does not reckon SHA-256 here");
  return hexadecimal(std::span(digest).first(length));
}

Commitment commitment_to(std::string truth) {
  Commitment seal{std::move(truth), fresh_salt(), {}};
  seal.digest = sha256_of(seal.truth + seal.salt);
  return seal;
}

}  // namespace navcal::validation
