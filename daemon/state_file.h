// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <filesystem>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace navcal::daemon {

/// A checked file (record/log/checked_file.h) that a thread of its own writes and removes, because a disk may take
/// seconds. Of several waiting contents only the newest is written. The thread begins when it is first needed.
class StateFile {
 public:
  explicit StateFile(std::filesystem::path file);
  ~StateFile();
  StateFile(const StateFile&) = delete;
  StateFile& operator=(const StateFile&) = delete;

  void save(std::string content);
  /// The same, and waits until it is on the disk. Returns why it is not within `limit`; empty: it is. For any
  /// thread but that of the ports.
  [[nodiscard]] std::string keep(std::string content, std::chrono::milliseconds limit);
  void remove();
  /// Does what is waiting and ends the thread.
  void stop();
  void note(std::string notice);
  /// Notices since the last call, for people.
  [[nodiscard]] std::vector<std::string> take_notices();
  [[nodiscard]] const std::filesystem::path& path() const { return file_; }

 private:
  /// `content` nullopt: no file. `may_stay`: a file that has this content already is not written again. Returns
  /// the number of the change.
  std::uint64_t change(std::optional<std::string> content, bool may_stay = false);
  void run();
  [[nodiscard]] std::string apply(const std::optional<std::string>& content, bool may_stay) const;

  const std::filesystem::path file_;
  std::mutex mutex_;
  std::condition_variable wake_, done_;
  std::optional<std::string> wanted_;
  bool may_stay_ = false;
  std::uint64_t asked_ = 0, answered_ = 0;  ///< changes, and those that the disk has taken or refused
  std::string problem_;                     ///< of the last change
  std::vector<std::string> notices_;
  bool stopping_ = false;
  std::thread thread_;
};

}  // namespace navcal::daemon
