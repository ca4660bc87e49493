// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "config/settings.h"

namespace navcal::ports {

/// Present place of a configured port, under any name, and its properties in the system.
struct Found {
  std::string path;  ///< links resolved
  std::string description;
};

/// Looks it up by USB serial number, by the name that udev keeps (relative to /dev unless absolute), or by path;
/// nullopt when it is not there. `why` then says so for people.
[[nodiscard]] std::optional<Found> find_port(const config::PortSettings& settings, std::string& why);

}  // namespace navcal::ports
