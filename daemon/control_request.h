// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

namespace navcal::daemon {

inline constexpr std::size_t kMaxControlLength = 4096;

enum class ControlCommand {
  event,
  log_rotate,
  calibration_start,
  calibration_accept,
  calibration_rollback,
  calibration_stop,
  status,
};

/// One line of the control socket, e.g. {"command":"event","text":"dive 3"}.
struct ControlRequest {
  ControlCommand command = ControlCommand::status;
  std::string text;        ///< of an event
  std::string calibrator;  ///< of calibration.*
  bool force = false;      ///< of calibration.accept: an estimate that is refused, too
};

/// The request, or why it is none, for people.
[[nodiscard]] std::variant<ControlRequest, std::string> parse_control(std::string_view line);

/// {"ok":false,"error":...}, newline included.
[[nodiscard]] std::string control_error(std::string_view message);

}  // namespace navcal::daemon
