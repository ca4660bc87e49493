// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <condition_variable>
#include <filesystem>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "config/settings.h"

namespace navcal::daemon {

/// Keeps the state of the calibrators, with the active calibration, across restarts: one checked file in the
/// log folder (record/log/checked_file.h). A thread of its own writes it, because a disk may take seconds. Of
/// several waiting states only the newest is written. A file that is damaged, or that belongs to instruments
/// that have changed, is kept aside and reported; the calibrators then start anew.
class CalibrationStore {
 public:
  explicit CalibrationStore(const config::Settings& settings);
  ~CalibrationStore();
  CalibrationStore(const CalibrationStore&) = delete;
  CalibrationStore& operator=(const CalibrationStore&) = delete;

  /// Called at start-up. Returns the state to continue from, if there is one.
  [[nodiscard]] std::optional<std::string> load();
  /// The state that load() gave is not understood: it is of another version.
  void reject(std::string_view reason);
  void save(std::string state);
  /// Writes pending states and ends the thread.
  void stop();

  /// Notices since the last call, for people.
  [[nodiscard]] std::vector<std::string> take_notices();
  [[nodiscard]] const std::filesystem::path& file() const { return file_; }

 private:
  void run();
  void keep_aside(std::string_view suffix, std::string_view reason);
  void note(std::string notice);

  const std::filesystem::path file_;
  const std::string instruments_;  ///< description of the instruments for which a state is valid

  std::mutex mutex_;
  std::condition_variable wake_;
  std::optional<std::string> waiting_;
  std::vector<std::string> notices_;
  bool stopping_ = false;
  bool failing_ = false;  ///< told already
  std::thread thread_;
};

/// The instruments and those settings of theirs on which what was learnt depends, one a line.
[[nodiscard]] std::string describe_instruments(const config::Settings& settings);

}  // namespace navcal::daemon
