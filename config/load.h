// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "config/error.h"
#include "config/settings.h"
#include "protocols/frame.h"

namespace navcal::config {

/// Settings given on the command line, "key=value" with the keys of the file: "status.port=29470",
/// "port.compass.path=/dev/pts/3", "log.enabled=false". Text needs no quotes. Where a port is (path, udev_name,
/// usb_serial or address) replaces what the file says of it, whichever of the four that was.
using Overrides = std::vector<std::string>;

/// Reads a configuration file (docs/configuration.md). Throws Error.
[[nodiscard]] Settings load(const std::filesystem::path& file, const Overrides& overrides = {});

/// The same from memory; `name` stands for the file in messages. Other files are not read: a described device
/// needs the text of its description. Throws Error.
[[nodiscard]] Settings parse(std::string_view toml, std::string_view name, const Overrides& overrides = {});

/// A complete file of these settings: parse(to_toml(s)) == s for whatever a file can state, and to the last bit.
[[nodiscard]] std::string to_toml(const Settings& settings);

/// A port with everything that is usual for its protocol: latency, rate, units, zeros and scales. Its place is not
/// filled in. This is what a [port.NAME] table starts from, and what a capture's #port line means.
[[nodiscard]] PortSettings default_port(std::string name, protocols::Protocol protocol, int baud);

/// The line speed at which devices of this protocol are delivered.
[[nodiscard]] int default_baud(protocols::Protocol protocol);

}  // namespace navcal::config
