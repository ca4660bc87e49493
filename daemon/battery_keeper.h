// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "config/settings.h"
#include "daemon/control_request.h"
#include "daemon/state_file.h"
#include "pipeline/battery.h"

namespace navcal::daemon {

/// Keeps the battery's charge across restarts, in battery.state of the log folder, and understands the operator's
/// battery.* commands. It writes nothing when the battery is not counted.
class BatteryKeeper {
 public:
  explicit BatteryKeeper(const config::Settings& settings);

  /// The charge with which the last run ended. Its standard deviation is larger by kRestart of the capacity,
  /// because nothing was counted between the runs. Nullopt without a file that fits this battery.
  [[nodiscard]] std::optional<pipeline::BatteryCharge> load();
  /// Called with every estimate; saves now and then.
  void take(const pipeline::BatterySample& sample);
  /// Saves the last estimate.
  void stop();
  /// The charge that a battery.* command states, or why it cannot be, for people.
  [[nodiscard]] std::optional<pipeline::BatteryCharge> charge_of(const ControlRequest& request,
                                                                 std::string& problem) const;
  [[nodiscard]] std::vector<std::string> take_notices() { return file_.take_notices(); }

  static constexpr double kRestart = 0.02;
  static constexpr double kFull = 0.02;  ///< standard deviation of a full charge, relative to the capacity

 private:
  void save();

  const config::BatterySettings settings_;
  StateFile file_;
  std::optional<pipeline::BatteryCharge> newest_;
  std::int64_t next_save_ns_ = 0;
};

}  // namespace navcal::daemon
