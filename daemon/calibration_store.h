// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "config/settings.h"
#include "daemon/state_file.h"

namespace navcal::daemon {

/// Keeps the state of the calibrators, with the active calibration, across restarts: one checked file in the
/// log folder (daemon/state_file.h). A file that is damaged, or that belongs to instruments
/// that have changed, is kept aside and reported; the calibrators then start anew.
class CalibrationStore {
 public:
  explicit CalibrationStore(const config::Settings& settings);

  /// Called at start-up. Returns the state to continue from, if there is one.
  [[nodiscard]] std::optional<std::string> load();
  /// The state that load() gave is not understood: it is of another version.
  void reject(std::string_view reason);
  void save(std::string state);
  /// Writes pending states and ends the thread.
  void stop() { file_.stop(); }

  /// Notices since the last call, for people.
  [[nodiscard]] std::vector<std::string> take_notices() { return file_.take_notices(); }
  [[nodiscard]] const std::filesystem::path& file() const { return file_.path(); }

 private:
  void keep_aside(std::string_view suffix, std::string_view reason);

  StateFile file_;
  const std::string instruments_;  ///< description of the instruments for which a state is valid
};

/// The instruments and those settings of theirs on which what was learnt depends, one a line.
[[nodiscard]] std::string describe_instruments(const config::Settings& settings);

}  // namespace navcal::daemon
