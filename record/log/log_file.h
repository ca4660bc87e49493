// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <system_error>

#include "record/log/disk.h"

namespace navcal::record {

/// One log file while it is being written. Every call may wait for the disk: the disk thread makes them.
class LogFile {
 public:
  /// Space is taken in steps of this size (docs/log-format.md says what that is worth).
  static constexpr std::uint64_t kReserveStep = 8ULL << 20;

  /// A new file whose name lasts (the folder is synced); null and `error` when it cannot be made.
  static std::unique_ptr<LogFile> create(Disk& disk, const std::filesystem::path& path, std::error_code& error);

  /// All or nothing: after an error the file is as before, and the same bytes may be offered again.
  [[nodiscard]] std::error_code append(std::string_view bytes);
  /// Makes all appended bytes durable: they survive a loss of power once this has returned without error. After an
  /// error the kernel may have dropped pages and marked them clean. Therefore all bytes since the last good sync
  /// are kept until then, and the next attempt writes them again.
  [[nodiscard]] std::error_code sync();
  /// Gives back the space not used and makes the file read-only, which marks it as finished. The footer
  /// (LogEncoder::finish) was appended before.
  [[nodiscard]] std::error_code finish();

  [[nodiscard]] bool is_gone() const { return file_->is_gone(); }
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  [[nodiscard]] std::uint64_t bytes() const { return bytes_; }
  [[nodiscard]] std::uint64_t synced_bytes() const { return synced_bytes_; }

 private:
  LogFile(std::unique_ptr<DiskFile> file, std::filesystem::path path);

  std::unique_ptr<DiskFile> file_;
  std::filesystem::path path_;
  std::uint64_t bytes_ = 0;
  std::uint64_t synced_bytes_ = 0;
  std::uint64_t reserved_bytes_ = 0;
  std::string unsynced_;  ///< from synced_bytes_ to bytes_
  bool write_anew_ = false;
};

}  // namespace navcal::record
