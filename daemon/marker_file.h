// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <condition_variable>
#include <filesystem>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace navcal::daemon {

/// A file whose being there says something to the next run of the program. Made and removed by a thread of its
/// own, which begins when it is first needed, so that no disk holds up the caller. It outlives the process, not
/// always a loss of power.
class MarkerFile {
 public:
  explicit MarkerFile(std::filesystem::path file);
  ~MarkerFile();
  MarkerFile(const MarkerFile&) = delete;
  MarkerFile& operator=(const MarkerFile&) = delete;

  /// True when the file exists. Before the first set(), that is as the run before left it.
  [[nodiscard]] bool is_there() const;
  void set(bool there);
  /// Waits until the file is as set.
  void stop();
  /// Errors since the last call, for people.
  [[nodiscard]] std::vector<std::string> take_notices();

 private:
  void run();
  [[nodiscard]] std::string apply(bool there) const;

  std::filesystem::path file_;
  mutable std::mutex mutex_;
  std::condition_variable wake_;
  bool wanted_;
  bool done_;
  bool stopping_ = false;
  std::vector<std::string> notices_;
  std::thread thread_;
};

}  // namespace navcal::daemon
