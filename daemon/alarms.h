// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "instruments/samples.h"

namespace navcal::daemon {

/// The first four are the inertial card's, then the motor card's; two follow from estimates.
enum class Alarm : std::uint8_t {
  leak_forward,
  leak_aft,
  over_range,
  low_supply,
  command_not_echoed,
  battery_low,
  floor_near,
  link_dead,
  log_failing,    ///< nothing is logged, though it should be
  orders_refused  ///< the note of the motor's orders cannot be kept
};

/// In place of a port: the alarms of the remote link and of the log.
inline constexpr std::uint16_t kRemotePort = 0xFFFF, kLogPort = 0xFFFE;
/// "remote", "log"; empty for a port.
[[nodiscard]] constexpr std::string_view place_beside_ports(std::uint16_t port) {
  return port == kRemotePort ? "remote" : port == kLogPort ? "log" : "";
}

/// "leak_forward", "leak_aft", "over_range", "low_supply", "command_not_echoed", "battery_low", "floor_near",
/// "link_dead", "log_failing", "orders_refused".
[[nodiscard]] std::string_view name_of(Alarm alarm);
inline constexpr std::array kCardAlarms{Alarm::leak_forward, Alarm::leak_aft, Alarm::over_range,
                                        Alarm::low_supply};

/// Alarms that are raised. A leak of an inertial card stays raised until the card has reported none for
/// `kClear_ns` without a break: water that sloshes over a sensor is one leak, not twenty a second. The other
/// alarms of the card are treated alike.
class Alarms {
 public:
  static constexpr std::int64_t kClear_ns = 2'000'000'000;

  struct Standing {
    std::uint16_t port = 0;
    Alarm alarm = Alarm::leak_forward;
    std::int64_t since_ns = 0;  ///< monotonic
    std::int64_t last_seen_ns = 0;
  };
  struct Change {
    std::uint16_t port = 0;
    Alarm alarm = Alarm::leak_forward;
    bool raised = false;
  };

  /// Changes caused by one sample; usually none.
  [[nodiscard]] const std::vector<Change>& update(std::uint16_t port, const instruments::ImuSample& imu,
                                                  std::int64_t now_ns);
  /// Sets an alarm that the caller has judged. Returns true when that is a change.
  [[nodiscard]] bool set(std::uint16_t port, Alarm alarm, bool stands, std::int64_t now_ns);
  /// Raised alarms, leaks first.
  [[nodiscard]] const std::vector<Standing>& standing() const { return standing_; }

 private:
  void raise(std::uint16_t port, Alarm alarm, std::int64_t now_ns);

  std::vector<Standing> standing_;
  std::vector<Change> changes_;
};

}  // namespace navcal::daemon
