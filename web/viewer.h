// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

namespace navcal::web {

struct ViewerSettings {
  std::filesystem::path log;  ///< .mcap
  std::string name;           ///< of the recording, as the page shows it
  std::string version;
  std::uint16_t port = 0;  ///< of the loopback address; 0: any that is free
  double speed = 1;
  std::function<void(double)> progress;            ///< of reading the log, 0..1
  std::function<void(const std::string&)> remark;  ///< for the user: damage of the log
  std::function<void(const std::string&)> ready;   ///< the address of the page, once it is served
};

/// Serves the page with a recording until SIGINT or SIGTERM. Throws record::BadRecording when the log is none,
/// std::runtime_error when the port is taken.
void view_recording(const ViewerSettings& settings);

}  // namespace navcal::web
