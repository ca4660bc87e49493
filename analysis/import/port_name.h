// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string_view>

namespace navcal::analysis {

/// Source instruments of imported logs. Ports are in this order, so a magnetometer comes before the attitude that
/// another system made of it.
enum class PortKind : std::uint8_t {
  imu,
  compass,
  gps,
  depth,
  dvl,
  altimeter,
  baro,
  attitude,
  motor,
  battery,
  velocity,
  sensors
};

/// "imu" for instance 0, "imu2" for 1, and so on; instances beyond the ninth share its port. Lasts for ever.
[[nodiscard]] std::string_view port_name(PortKind kind, int instance);

/// Place of a port in a log, by its name; names of no kind come last.
[[nodiscard]] std::size_t port_rank(std::string_view name);

}  // namespace navcal::analysis
