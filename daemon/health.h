// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "daemon/alarms.h"
#include "daemon/disk_thread.h"
#include "daemon/port_session.h"
#include "pipeline/pipeline.h"

namespace navcal::daemon {

/// All that HEALTH tells, but for the client's own count (docs/status-protocol.md).
struct Health {
  std::optional<std::int64_t> utc_ns;
  double uptime_s = 0;
  std::span<const Alarms::Standing> alarms;
  std::string vehicle;  ///< vehicle_identity()
  std::string motor;    ///< MotorControl's, an object of JSON; empty where no orders are taken
  std::string remote;   ///< RemoteLink's, an object of JSON; empty where there is none
  std::span<const std::unique_ptr<PortSession>> ports;
  const pipeline::Pipeline* pipeline = nullptr;
  bool log_enabled = true;
  DiskState log;
  std::size_t clients = 0;
  std::size_t client_queue_bytes = 0;  ///< waiting for all clients together
  std::uint64_t client_dropped = 0;    ///< reports missed by all clients together
  std::string_view heading_source;     ///< StateCollector's
};

/// Number of ports in one line: libgps reads lines of up to 10 kB, so more ports make more lines.
inline constexpr std::size_t kPortsPerHealth = 8;

/// Id and name where they are given, and the sum of the configuration in force: an object of JSON.
[[nodiscard]] std::string vehicle_identity(const config::Settings& settings);

/// HEALTH lines without their end, to which the status server adds each client's own count: `,"dropped":0}`.
[[nodiscard]] std::vector<std::string> health_beginnings(const Health& health);

/// LOG: file, bytes, synced up to, what is left out. One line, newline included.
void append_log_report(std::string& out, bool enabled, const DiskState& log,
                       const std::vector<std::string>& left_out);

}  // namespace navcal::daemon
