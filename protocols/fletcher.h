// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "protocols/frame.h"

namespace navcal::protocols {

/// Fletcher's checksum of eight bits (RFC 1145, modulo 256): the sum of the bytes, and the sum of these sums.
/// u-blox UBX and MicroStrain MIP send `first`, then `second`.
struct Fletcher {
  std::uint8_t first = 0, second = 0;

  bool operator==(const Fletcher&) const = default;
};

[[nodiscard]] inline Fletcher fletcher_of(Bytes bytes) {
  std::uint32_t first = 0, second = 0;
  for (const std::uint8_t byte : bytes) {
    first += byte;
    second += first;
  }
  return {static_cast<std::uint8_t>(first), static_cast<std::uint8_t>(second)};
}

}  // namespace navcal::protocols
