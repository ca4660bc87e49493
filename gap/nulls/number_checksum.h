// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <type_traits>

#include "record/log/checksum.h"

namespace navcal::gap {

/// Checksum of a type that consists of numbers only: padding between members would make equal values differ.
template <class Numbers>
[[nodiscard]] std::uint32_t checksum_of(const Numbers& numbers) {
  static_assert(std::is_trivially_copyable_v<Numbers> && sizeof(Numbers) % sizeof(double) == 0);
  std::array<char, sizeof(Numbers)> bytes{};
  std::memcpy(bytes.data(), &numbers, bytes.size());
  return record::crc32c({bytes.data(), bytes.size()});
}

}  // namespace navcal::gap
