// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <filesystem>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace navcal::daemon {

/// A file whose being there says something to the next run of the program, whatever becomes of this one: it and
/// its folder are synced. Made and removed by a thread of its own, which begins when it is first needed, so that
/// no disk holds up the caller.
class MarkerFile {
 public:
  /// `content`: of the file, as a checked file (record/log/checked_file.h).
  MarkerFile(std::filesystem::path file, std::string content);
  ~MarkerFile();
  MarkerFile(const MarkerFile&) = delete;
  MarkerFile& operator=(const MarkerFile&) = delete;

  /// True when the run before left the file, or when nobody can tell.
  [[nodiscard]] bool was_there() const { return was_there_; }
  /// Makes the file and waits until it is on the disk. Returns why it is not within `limit`; empty: it is. For any
  /// thread but that of the ports.
  [[nodiscard]] std::string keep(std::chrono::milliseconds limit);
  /// True from keep() to remove().
  [[nodiscard]] bool is_kept() const;
  /// Does not wait.
  void remove();
  /// Waits until the file is as told.
  void stop();
  /// Errors since the last call, for people.
  [[nodiscard]] std::vector<std::string> take_notices();

 private:
  void run();
  [[nodiscard]] std::string apply(bool there) const;

  const std::filesystem::path file_;
  const std::string content_;
  bool was_there_ = false;
  mutable std::mutex mutex_;
  std::condition_variable wake_, done_;
  bool wanted_;
  std::uint64_t asked_ = 0, answered_ = 0;  ///< changes of `wanted_`, and those that the disk has taken or refused
  std::string problem_;                     ///< of the last change
  bool stopping_ = false;
  std::vector<std::string> notices_;
  std::thread thread_;
};

}  // namespace navcal::daemon
