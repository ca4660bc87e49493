// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "record/log/disk.h"
#include "record/log/log_repair.h"

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

/// The folder of logs, owned by one process at a time. Files are named navcal-<UTC>-<counter>.mcap; the counter
/// orders them and never repeats, whatever the clock does. A finished file is one that is read-only.
class LogFolder {
 public:
  /// Takes the folder. Throws std::system_error saying what is wrong: it is not there, is read-only, or another
  /// navcald holds it.
  LogFolder(Disk& disk, std::filesystem::path folder);

  /// Logs that a loss of power left open get their end; call before the first create().
  std::vector<Repair> finish_unfinished();
  /// The next file; `utc_ns` only gives it its name.
  [[nodiscard]] std::unique_ptr<LogFile> create(std::int64_t utc_ns, std::error_code& error);

  struct Space {
    std::uint64_t free_bytes = 0;
    std::vector<std::string> removed;  ///< finished logs that made room, oldest first
    std::error_code error;
  };
  /// Removes the oldest finished logs until `floor_bytes` are free; none where all of them would not be enough.
  /// Never an unfinished one, nor the newest from before this process: what is not fetched yet is the only copy.
  Space keep_free(std::uint64_t floor_bytes);
  /// Removes the oldest of them, because the disk is full.
  Space remove_oldest();

  [[nodiscard]] const std::filesystem::path& path() const { return folder_; }

 private:
  struct Log;
  [[nodiscard]] std::vector<Log> logs(std::error_code& error);
  [[nodiscard]] std::vector<Log> removable(std::error_code& error);
  void remove(const Log& log, Space& space);

  Disk& disk_;
  std::filesystem::path folder_;
  std::unique_ptr<DiskLock> lock_;
  std::uint64_t last_counter_ = 0;
  std::uint64_t kept_counter_ = 0;  ///< of the newest log from before
};

/// Whether this is the name of a log, as log_name() makes them, and nothing else: no path leads through it.
[[nodiscard]] bool is_log_name(std::string_view name);

/// "navcal-20261121T023000Z-000123.mcap".
[[nodiscard]] std::string log_name(std::int64_t utc_ns, std::uint64_t counter);

}  // namespace navcal::record
