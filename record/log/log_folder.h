// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <system_error>
#include <vector>

#include "record/log/disk.h"
#include "record/log/log_file.h"
#include "record/log/log_repair.h"

namespace navcal::record {

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
