// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

namespace navcal::web {

struct MqttOptions {
  std::string broker{};  ///< HOST or HOST:PORT; empty: no MQTT
  std::string prefix = "navcal";
  std::string login_file{};
  double rate_Hz = 1;
};

/// A rate is the most messages a second; 0: none.
struct MavlinkOptions {
  std::string address{};  ///< as of a port of navcald, or the path of a serial port; empty: no MAVLink
  int baud = 115200;
  double odometry_Hz = 20, gps_Hz = 0, values_Hz = 1;
  bool has_texts = true;
  std::uint8_t system = 1, component = 197;
  double tilt_std_deg = 0;  ///< standard error of roll and pitch; 0: unknown
  std::string key_file{};   ///< empty: without signatures
};

/// What the command line says of the outlets.
struct OutletOptions {
  std::string version{};
  std::string vessel{};  ///< name of the vessel in Signal K; empty: default_vessel()
  MqttOptions mqtt{};
  std::string chrony_socket{};  ///< empty: chrony is not served
  MavlinkOptions mavlink{};
};

}  // namespace navcal::web
