// SPDX-License-Identifier: Apache-2.0
#include "validation/commitment.h"

#include <sys/random.h>

#include <array>
#include <cerrno>
#include <system_error>
#include <utility>

#include "record/content_hash.h"

namespace navcal::validation {
namespace {

std::string fresh_salt() {
  std::array<unsigned char, 32> bytes{};
  // So few bytes come whole, or not at all (getrandom(2)).
  while (::getrandom(bytes.data(), bytes.size(), 0) < 0) {
    if (errno != EINTR) throw std::system_error(errno, std::system_category(), "getrandom");
  }
  return record::hexadecimal(bytes);
}

}  // namespace

Commitment commitment_to(std::string truth) {
  Commitment seal{std::move(truth), fresh_salt(), {}};
  seal.digest = record::sha256_of(seal.truth + seal.salt);
  return seal;
}

}  // namespace navcal::validation
