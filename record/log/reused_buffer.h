// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>

namespace navcal::record {

/// Empties a buffer that is filled again and again. Its memory is given back when it is large, or when the last
/// use took less than a quarter of it: one long message or a stall of the disk would otherwise hold memory for
/// ever.
inline void empty_for_reuse(std::string& buffer) {
  constexpr std::size_t kAlwaysKept_bytes = 16 << 10, kNeverKept_bytes = 256 << 10;
  const bool oversized = buffer.capacity() > kAlwaysKept_bytes && buffer.size() < buffer.capacity() / 4;
  if (oversized || buffer.capacity() > kNeverKept_bytes) {
    std::string().swap(buffer);  // an assignment of an empty text keeps the memory
  } else {
    buffer.clear();
  }
}

}  // namespace navcal::record
