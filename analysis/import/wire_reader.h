// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bit>
#include <cstring>
#include <string_view>
#include <type_traits>

namespace navcal::analysis {

/// Integer or floating-point number at `offset`, little-endian; 0 when it is not wholly there.
template <class T>
[[nodiscard]] T little_endian_at(std::string_view bytes, std::size_t offset) {
  static_assert(std::is_arithmetic_v<T> && std::endian::native == std::endian::little);
  T value{};
  if (offset <= bytes.size() && bytes.size() - offset >= sizeof value)
    std::memcpy(&value, bytes.data() + offset, sizeof value);
  return value;
}

}  // namespace navcal::analysis
