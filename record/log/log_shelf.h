// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <variant>
#include <vector>

#include "record/log/log_folder.h"

namespace navcal::record {

/// Times of a log's first and last message on the scale of its log_time (about UTC), nanoseconds.
struct LogSpan {
  std::int64_t begin_ns = 0;
  std::int64_t end_ns = 0;
};

/// One log of a folder.
struct ShelvedLog {
  std::string name;
  std::uint64_t bytes = 0;
  bool finished = false;
  std::optional<LogSpan> span;  ///< of a finished log that has messages
};

struct ShelfPage {
  std::vector<ShelvedLog> logs;  ///< by counter, oldest first
  bool more = false;             ///< there are others behind them
  std::error_code error;
};

/// Greatest lengths in one call.
inline constexpr std::uint64_t kMaxPart_bytes = 65536;
inline constexpr std::uint64_t kMaxSum_bytes = 16ULL << 20;
inline constexpr std::size_t kMaxPage = 100;

/// The logs behind the one named `after` (empty: all), at most `limit`. Other files are passed over.
[[nodiscard]] ShelfPage list_logs(const std::filesystem::path& folder, std::string_view after, std::size_t limit);

struct LogPart {
  std::string bytes;  ///< empty from sum_log()
  std::uint64_t offset = 0;
  std::uint64_t length = 0;  ///< less than asked for at the end of the file
  std::uint64_t size = 0;    ///< of the file now; a log that is being written grows
  std::uint32_t crc32 = 0;   ///< of these bytes
};

/// Bytes of a log, for who downloads it. Only regular files with the name of a log are read, never through a link.
/// The alternative is why not, for people. May wait for the disk.
[[nodiscard]] std::variant<LogPart, std::string> read_log(const std::filesystem::path& folder,
                                                          const std::string& name, std::uint64_t offset,
                                                          std::uint64_t length);
/// The checksum alone.
[[nodiscard]] std::variant<LogPart, std::string> sum_log(const std::filesystem::path& folder,
                                                         const std::string& name, std::uint64_t offset,
                                                         std::uint64_t length);

}  // namespace navcal::record
