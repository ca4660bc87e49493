// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "config/settings.h"
#include "protocols/frame.h"

namespace navcal::instruments {

/// The dialogue that brings a device to the configured state (ICD sections 1 and 2), and again after the device
/// has lost its power. A state machine without I/O or clock: it gets frames and the time, and returns the bytes
/// to send and the next deadline.
class StartUp {
 public:
  virtual ~StartUp() = default;
  /// To be called when the port was opened, or opened anew.
  virtual void begin(std::int64_t now_ns) = 0;
  virtual void on_frame(const protocols::Frame& frame, std::int64_t now_ns) = 0;
  /// Bytes to send now, if any; call again until nullopt.
  virtual std::optional<std::vector<std::uint8_t>> next(std::int64_t now_ns) = 0;
  /// Time at which next() should be called again, monotonic; INT64_MAX when only a frame can change something.
  [[nodiscard]] virtual std::int64_t deadline_ns() const { return due_ns_; }
  /// True when the dialogue is over and the device delivers.
  [[nodiscard]] virtual bool in_service() const = 0;
  /// State as text for people: "running", "settings sent", "no answer to Ha: trying Ea", ...
  [[nodiscard]] virtual std::string state() const = 0;

 protected:
  std::int64_t due_ns_ = std::numeric_limits<std::int64_t>::max();
};

/// nullptr for a device that takes no commands (IMU card, motor card, NMEA) or when start_up is off.
[[nodiscard]] std::unique_ptr<StartUp> make_start_up(const config::PortSettings& settings);

}  // namespace navcal::instruments
