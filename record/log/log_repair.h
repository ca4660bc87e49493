// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <system_error>

#include "record/log/disk.h"

namespace navcal::record {

/// Result of finishing one log.
struct Repair {
  std::string file;            ///< its name
  std::error_code error;       ///< why nothing was done, or why it could not be completed
  std::string reason;          ///< where it is no log: what() of BadRecording
  std::uint64_t messages = 0;  ///< kept
  std::uint64_t bad_crc = 0;   ///< messages whose checksum does not hold: left as they are, readers pass over them
  std::uint64_t cut_bytes = 0;     ///< removed behind the last whole record
  std::uint64_t masked_bytes = 0;  ///< damaged stretches before it, made into records that MCAP readers pass over
  bool was_finished = false;       ///< it was whole already; at most its mode was changed
  /// "navcal-...mcap: finished, 1234 messages kept, 17 bytes after the last whole record removed".
  [[nodiscard]] std::string message() const;
};

/// Gives an unfinished log its end (DataEnd, summary, footer), as LogEncoder::finish would have. A log that
/// somebody is still writing is left alone: std::errc::resource_unavailable_try_again.
[[nodiscard]] Repair finish_log(Disk& disk, const std::filesystem::path& file);

}  // namespace navcal::record
