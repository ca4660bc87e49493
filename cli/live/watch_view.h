// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "cli/live/watch_calibration.h"

namespace navcal::cli {

/// View of a running daemon: lines of the status socket in, text out. No I/O.
class WatchView {
 public:
  enum class Colour { none, ansi };

  /// Takes one line of the stream. Lines that are not understood are skipped.
  void take(std::string_view line);
  /// Forgets everything: the connection was lost.
  void clear();

  /// The whole picture, alarms first, several lines.
  [[nodiscard]] std::string page(Colour colour) const;
  /// The same in one line, for a log or a pipe.
  [[nodiscard]] std::string line() const;

 private:
  using Json = nlohmann::json;
  void take_health(const Json& health);
  void append_alarms(std::string& out, Colour colour) const;
  void append_ports(std::string& out) const;
  void append_sources(std::string& out) const;
  void append_attitude(std::string& out) const;
  void append_position(std::string& out) const;
  void append_motor(std::string& out) const;
  void append_battery(std::string& out) const;
  void append_log(std::string& out) const;
  void append_time(std::string& out) const;

  Json alarms_ = Json::array();
  Json log_;
  Json sources_;
  Json time_;
  Json navigation_;
  std::map<std::string, Json> ports_;                        ///< of HEALTH, by device
  std::map<std::string, double> frames_per_s_;               ///< by device
  std::map<std::string, std::map<std::string, Json>> last_;  ///< newest report, by class and device
  WatchCalibration calibration_;
  double uptime_s_ = 0;
  std::map<std::string, double> counted_at_s_;  ///< uptime of the HEALTH before, by device
  double dropped_ = 0;
};

}  // namespace navcal::cli
