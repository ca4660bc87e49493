// SPDX-License-Identifier: Apache-2.0
#include "bench/xor_reference.h"

namespace navcal::bench {

std::uint8_t xor_byte_by_byte(std::span<const std::uint8_t> bytes) {
  std::uint8_t sum = 0;
  for (const std::uint8_t byte : bytes) sum ^= byte;
  return sum;
}

}  // namespace navcal::bench
