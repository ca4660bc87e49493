// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "config/settings.h"
#include "control/order.h"
#include "daemon/status_server.h"
#include "instruments/samples.h"
#include "pipeline/battery.h"
#include "pipeline/navigation.h"
#include "pipeline/utc_mapping.h"
#include "record/log/log_payload.h"

namespace navcal::daemon {

/// Sends RECORD, the log's JSON messages, to the clients of the status socket that ask for it
/// (docs/status-protocol.md). Nothing is encoded while nobody asks. Times are monotonic nanoseconds.
class RecordFeed {
 public:
  RecordFeed(const config::Settings& settings, StatusServer& server);

  void set_mapping(const pipeline::UtcMapping& mapping) { mapping_ = mapping; }
  void sample(const instruments::Sample& sample);
  void navigation(const pipeline::NavigationSample& sample);
  void battery(const pipeline::BatterySample& sample);
  void mapping(std::int64_t now_ns, const pipeline::UtcMapping& mapping);
  void event(std::int64_t now_ns, std::string_view severity, std::string_view name, std::string_view port,
             std::string_view message);
  void health(std::int64_t now_ns, std::string_view json);
  void calib(std::int64_t now_ns, std::string_view json);
  void command(std::int64_t now_ns, std::string_view device, const control::OrderRecord& record);

 private:
  [[nodiscard]] std::optional<std::uint16_t> port_named(std::string_view name) const;
  /// `device` empty: of no device. `append(out)` writes the JSON object.
  template <class Append>
  void publish(const RecordKey& key, std::string_view device, std::int64_t utc_ns, Append&& append);

  StatusServer& server_;
  std::vector<std::string> devices_;  ///< names of the ports
  pipeline::UtcMapping mapping_;
  std::string line_;
};

}  // namespace navcal::daemon
