// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "cli/live/arrivals.h"

namespace navcal::cli {

/// What an owner says to `navcal start`; empty or 0 where the default of the kind holds.
struct StartRequest {
  std::string kind;  ///< bluerov2, ros2, gpsd or nmea
  std::filesystem::path output;
  std::string address, device;  ///< the port: in the network, or a serial one
  int baud = 0;
  std::vector<std::string> topics;  ///< KIND=/TOPIC of ros2
  std::uint16_t status_port = 2947;
};

/// What `navcal start` does for a request.
struct StartPlan {
  std::filesystem::path configuration;  ///< absolute
  std::string toml;
  std::string port;         ///< name of the port in it
  std::string samples;      ///< Unix socket of the port of ros2
  bool is_service = false;  ///< it is the configuration of the installed service
  std::vector<ExpectedQuantity> expected;
  std::string silent;  ///< what to do when nothing comes
};

/// Throws base::Failure: usage where an option is not of this kind, failed where a serial port is needed and
/// none, or more than one, is there.
[[nodiscard]] StartPlan start_plan(const StartRequest& request);

}  // namespace navcal::cli
