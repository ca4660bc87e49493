// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace navcal::web {

struct MqttOptions {
  std::string broker{};  ///< HOST or HOST:PORT; empty: no MQTT
  std::string prefix = "navcal";
  std::string login_file{};
  double rate_Hz = 1;
};

/// What the command line says of the outlets.
struct OutletOptions {
  std::string version{};
  std::string vessel{};  ///< name of the vessel in Signal K; empty: default_vessel()
  MqttOptions mqtt{};
  std::string chrony_socket{};  ///< empty: chrony is not served
};

}  // namespace navcal::web
