// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include "control/lease_desk.h"
#include "control/order.h"

namespace navcal::daemon {

inline constexpr std::size_t kMaxControlLength = 4096;

enum class ControlCommand {
  event,
  log_rotate,
  calibration_start,
  calibration_accept,
  calibration_rollback,
  calibration_stop,
  motor_lease,
  motor_order,
  motor_release,
  status,
};

/// One line of the control socket, e.g. {"command":"event","text":"dive 3"}.
struct ControlRequest {
  ControlCommand command = ControlCommand::status;
  std::string text;                        ///< of an event
  std::string calibrator;                  ///< of calibration.*
  bool force = false;                      ///< of calibration.accept: an estimate that is refused, too
  control::LeaseRequest lease_request;     ///< of motor.lease
  std::string lease;                       ///< of motor.order and motor.release
  control::Order order;                    ///< of motor.order
  std::optional<double> state_time_utc_s;  ///< of motor.order: the STATE that it answers
};

/// Whence a request came.
struct ControlOrigin {
  std::uint64_t client = 0;     ///< number of the connection
  std::int64_t arrival_ns = 0;  ///< monotonic: when the read returned that completed the line
};

/// The request, or why it is none, for people.
[[nodiscard]] std::variant<ControlRequest, std::string> parse_control(std::string_view line);

/// {"ok":false,"error":...}, newline included.
[[nodiscard]] std::string control_error(std::string_view message);

}  // namespace navcal::daemon
