// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "instruments/dialogue.h"

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

/// The dialogue of one command: sends it, repeats it when no answer comes, and tells the answer. StartUp must be
/// silent meanwhile.
class DeviceCommand : public Dialogue {
 public:
  struct Outcome {
    bool done = false;
    std::string text;  ///< the device's answer, or why there is none, for people
  };

  /// Nullopt while the dialogue goes on.
  [[nodiscard]] const std::optional<Outcome>& outcome() const { return outcome_; }

 protected:
  std::optional<Outcome> outcome_;
};

/// Begins the command of that name. Nullptr when the device has none of this name.
[[nodiscard]] std::unique_ptr<DeviceCommand> make_device_command(const config::PortSettings& settings,
                                                                 std::string_view name, std::int64_t now_ns);

}  // namespace navcal::instruments
