// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "config/settings.h"

namespace navcal::ports {

/// Present path of a configured port, whatever its name, and its properties in the system.
struct Found {
  std::string path;  ///< links resolved
  std::string description;
};

/// Finds a port by USB serial number, by the name that udev keeps (relative to /dev unless absolute), or by
/// path. nullopt when it is not there; `why` then states the reason for people.
[[nodiscard]] std::optional<Found> find_port(const config::PortSettings& settings, std::string& why);

}  // namespace navcal::ports
