// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "base/local_plane.h"
#include "protocols/mavlink.h"
#include "web/outlets/chrony.h"
#include "web/outlets/outlet_options.h"
#include "web/outlets/pacer.h"
#include "web/record.h"

namespace navcal::web {

/// Makes MAVLink messages of navcald's records (docs/wires.md). What is not known is not sent, or marked as
/// unknown; nothing is repeated. Times are those of validity, UTC.
class MavlinkMessages {
 public:
  using Send = std::function<void(std::uint32_t id, protocols::Bytes payload)>;
  MavlinkMessages(const MavlinkOptions& options, Send send) : options_(options), send_(std::move(send)) {}

  void take(const Record& record, Pacer::Clock::time_point now);
  /// Once a second. The autopilot wants ODOMETRY ten times a second: of estimates that are fewer there is none.
  void tick();
  /// UTC minus the monotonic clock, by navcald; nullopt before it has said so.
  [[nodiscard]] const std::optional<ClockMapping>& mapping() const { return mapping_; }
  /// Why no position goes out; empty while it does, or should not.
  [[nodiscard]] const std::string& problem() const { return problem_; }

 private:
  void take_estimate(const nlohmann::json& nav, std::optional<std::int64_t> utc_ns, Pacer::Clock::time_point now);
  void send_odometry(const nlohmann::json& nav, std::int64_t utc_ns);
  void send_gps(const nlohmann::json& nav, std::int64_t utc_ns);
  void send_values(const nlohmann::json& nav, std::int64_t utc_ns);
  void send_text(std::uint8_t severity, std::string_view text);

  MavlinkOptions options_;
  Send send_;
  Pacer odometry_, gps_, values_;
  std::optional<ClockMapping> mapping_;
  std::optional<base::LocalPlane> origin_;  ///< of ODOMETRY: the first position
  bool knows_north_ = false, is_often_ = false;
  bool is_own_heading_ = false;   ///< estimated by the autopilot, which does not get it back as a measurement
  int estimates_ = 0, sent_ = 0;  ///< since the last tick
  std::string missing_ = "no estimate comes from navcald", problem_, calibration_;
  std::uint8_t resets_ = 0;
  std::uint16_t texts_ = 0;
};

}  // namespace navcal::web
