// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "config/settings.h"
#include "protocols/frame.h"

namespace navcal::instruments {

/// A command that a person may give a device by its name. The list holds what ICD sections 1 and 2 show as
/// harmless.
struct DeviceCommandName {
  std::string_view name;
  std::string_view meaning;  ///< for people
  bool needs_force = false;  ///< data stop for a while, or the device forgets something
};

/// The commands of a device; empty for one that takes none.
[[nodiscard]] std::vector<DeviceCommandName> device_commands(protocols::Protocol protocol);

/// The dialogue of one command: sends it, repeats it when no answer comes, and tells the answer. A state machine
/// without I/O or clock, like StartUp, which must be silent meanwhile.
class DeviceCommand {
 public:
  struct Outcome {
    bool done = false;
    std::string text;  ///< the device's answer, or why there is none, for people
  };

  virtual ~DeviceCommand() = default;
  virtual void on_frame(const protocols::Frame& frame) = 0;
  /// Bytes to send now, if any; call again until nullopt.
  virtual std::optional<std::vector<std::uint8_t>> next(std::int64_t now_ns) = 0;
  /// Time at which next() should be called again, monotonic.
  [[nodiscard]] virtual std::int64_t deadline_ns() const = 0;
  /// Nullopt while the dialogue goes on.
  [[nodiscard]] virtual const std::optional<Outcome>& outcome() const = 0;
};

/// Begins the command of that name. Nullptr when the device has none of this name.
[[nodiscard]] std::unique_ptr<DeviceCommand> make_device_command(const config::PortSettings& settings,
                                                                 std::string_view name, std::int64_t now_ns);

}  // namespace navcal::instruments
