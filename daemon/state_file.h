// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <condition_variable>
#include <filesystem>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace navcal::daemon {

/// A checked file (record/log/checked_file.h) that a thread of its own writes, because a disk may take seconds. Of
/// several waiting contents only the newest is written. The thread begins with the first save().
class StateFile {
 public:
  explicit StateFile(std::filesystem::path file);
  ~StateFile();
  StateFile(const StateFile&) = delete;
  StateFile& operator=(const StateFile&) = delete;

  void save(std::string content);
  /// Writes what is waiting and ends the thread.
  void stop();
  void note(std::string notice);
  /// Notices since the last call, for people.
  [[nodiscard]] std::vector<std::string> take_notices();
  [[nodiscard]] const std::filesystem::path& path() const { return file_; }

 private:
  void run();

  const std::filesystem::path file_;
  std::mutex mutex_;
  std::condition_variable wake_;
  std::optional<std::string> waiting_;
  std::vector<std::string> notices_;
  bool stopping_ = false;
  bool failing_ = false;  ///< told already
  std::thread thread_;
};

}  // namespace navcal::daemon
