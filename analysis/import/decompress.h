// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace navcal::analysis {

/// A chunk of a ROS 2 bag. `compression` is "lz4" (frames) or "zstd". nullopt: another one, damaged, or more than
/// 256 MiB when it is whole.
[[nodiscard]] std::optional<std::string> decompressed_chunk(std::string_view compression, std::string_view bytes);

/// A compressed file of a Slocum glider: blocks of LZ4, each behind its length in two bytes, big-endian. Ends
/// before the first block that is damaged or not whole.
[[nodiscard]] std::string decompressed_blocks(std::string_view file);

}  // namespace navcal::analysis
