// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "control/lease_desk.h"
#include "control/order.h"

namespace navcal::daemon {

inline constexpr std::size_t kMaxControlLength = 4096;

enum class ControlCommand {
  event,
  log_rotate,
  log_start,
  log_stop,
  log_select,
  log_list,
  log_read,
  log_sum,
  power_on,
  power_off,
  power_list,
  calibration_start,
  calibration_accept,
  calibration_rollback,
  calibration_stop,
  motor_lease,
  motor_order,
  motor_release,
  motor_stop,
  battery_full,
  battery_set,
  device_command,
  device_commands,
  status,
};

/// One line of the control socket, e.g. {"command":"event","text":"dive 3"}.
struct ControlRequest {
  ControlCommand command = ControlCommand::status;
  std::string text;        ///< of an event
  std::string by;          ///< of motor.stop: who stops, for people
  std::string calibrator;  ///< of calibration.*
  bool force = false;      ///< of calibration.accept: an estimate that is refused, too; of device.command
  control::LeaseRequest lease_request;     ///< of motor.lease
  std::string lease;                       ///< of motor.order and motor.release
  control::Order order;                    ///< of motor.order
  std::optional<double> charge_Ah;         ///< of battery.set
  std::optional<double> charge_std_Ah;     ///< likewise
  std::optional<double> state_time_utc_s;  ///< of motor.order: the STATE that it answers
  std::string name;                        ///< of power.on and power.off: the supply; of device.command
  std::string port;          ///< of device.command, and of device.commands, where it may be empty: all
  std::string file;          ///< of log.read and log.sum; of log.list: the one before the first
  std::uint64_t offset = 0;  ///< of log.read and log.sum, bytes
  std::uint64_t length = 0;
  std::optional<std::vector<std::string>> leave_out;  ///< of log.select; nullopt: it only asks
};

/// The answer to a request.
struct ControlAnswer {
  ControlAnswer(std::string line) : text(std::move(line)) {}  // NOLINT: most answers are lines
  explicit ControlAnswer(std::function<std::string()> disk_work,
                         std::function<std::string(std::string)> afterwards = {})
      : work(std::move(disk_work)), then(std::move(afterwards)) {}

  std::string text;  ///< one line, newline included
  std::function<std::string()>
      work;  ///< where it is set: makes the line, may wait for the disk, runs on another thread
  std::function<std::string(std::string)>
      then;  ///< where it is set: makes the line of what `work` made, on this one
};

/// Whence a request came.
struct ControlOrigin {
  std::uint64_t client = 0;     ///< number of the connection
  std::int64_t arrival_ns = 0;  ///< monotonic: when the read returned that completed the line
  std::int64_t sent_ns = 0;     ///< monotonic: the line was sent then or later
};

/// The request, or why it is none, for people.
[[nodiscard]] std::variant<ControlRequest, std::string> parse_control(std::string_view line);

/// {"ok":false,"error":...}, newline included.
[[nodiscard]] std::string control_error(std::string_view message);

}  // namespace navcal::daemon
