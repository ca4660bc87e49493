// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>

namespace navcal::bench {

/// XOR of all bytes, one at a time: what the checksum of a stream costs at least in a plain loop. Compiled on its
/// own with -O2 -fno-tree-vectorize (bench/CMakeLists.txt), as a measure that no compiler improves upon.
[[nodiscard]] std::uint8_t xor_byte_by_byte(std::span<const std::uint8_t> bytes);

}  // namespace navcal::bench
