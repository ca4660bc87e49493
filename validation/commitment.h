// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace navcal::validation {

/// A truth that is fixed before anybody answers: the digest (SHA-256, record/content_hash.h) is published first,
/// truth and salt after the last answer, and then everybody can reckon that digest = SHA-256(truth salt), the two
/// texts one after the other. Without the salt the few possible truths could be tried one by one.
struct Commitment {
  std::string truth;
  std::string salt;  ///< 32 random bytes of the kernel, in hexadecimal
  std::string digest;
};

[[nodiscard]] Commitment commitment_to(std::string truth);

}  // namespace navcal::validation
