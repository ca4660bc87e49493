// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "control/order.h"
#include "instruments/samples.h"
#include "pipeline/battery.h"
#include "pipeline/navigation.h"
#include "pipeline/utc_mapping.h"
#include "record/json/mapping_json.h"
#include "record/json/message_json.h"
#include "record/log/log_topics.h"

namespace navcal::record {

/// Topic and times of one JSON message of the log. Log files and the status socket share it and the payload, so
/// they agree to the byte.
struct MessageHead {
  std::uint16_t topic = 0;               ///< number of log_topics.h; 0: this has no message
  std::int64_t time_ns = 0;              ///< monotonic: when it became known
  std::int64_t validity_ns = 0;          ///< monotonic: the instant that it is about
  std::string_view device{};             ///< name of the port; empty: of no device
  std::optional<std::int64_t> utc_ns{};  ///< of validity; absent: by the mapping in force
  bool repeats = false;                  ///< comes again by itself at a rate
};
/// Satellites in view have no message: the raw bytes have them.
[[nodiscard]] std::uint16_t topic_of(const instruments::Sample& sample);

using AppendJson = std::function<void(std::string&)>;
/// Appends one payload: the object that `append` writes, with its CRC-32C in place of its closing brace:
/// `,"crc":"1a2b3c4d"}`.
void append_payload(std::string& out, const AppendJson& append);
void append_sum(std::string& out, std::size_t begin);

/// The messages of all that happens; Derived has put(to..., head, append), and port_name() of a port's number.
/// Times are monotonic nanoseconds.
template <class Derived, class... To>
class LogMessages {
 public:
  void sample(To... to, const instruments::Sample& sample) {
    if (const std::uint16_t topic = topic_of(sample); topic != 0) put_of_port(to..., topic, sample);
  }
  void navigation(To... to, const pipeline::NavigationSample& sample) {
    const auto& stamp = sample.stamp;
    self().put(to...,
               {topic::kNav, stamp.arrival_ns, stamp.validity_ns, pipeline::kNavigationDevice,
                stamp.validity_utc_ns, true},
               [&](std::string& out) { append_json(out, sample); });
  }
  void battery(To... to, const pipeline::BatterySample& sample) { put_of_port(to..., topic::kBattery, sample); }
  void mapping(To... to, std::int64_t now_ns, const pipeline::UtcMapping& mapping) {
    mapping_ = mapping;
    self().put(to..., {topic::kTime, now_ns, now_ns},
               [&](std::string& out) { append_json(out, now_ns, mapping); });
  }
  /// `severity`: "info", "warning", "error", "alarm"; `name`: a short key such as "port.lost"; `port` may be
  /// empty.
  void event(To... to, std::int64_t now_ns, std::string_view severity, std::string_view name,
             std::string_view port, std::string_view message) {
    self().put(to..., {topic::kEvent, now_ns, now_ns, port},
               [&](std::string& out) { append_event_json(out, mapping_, now_ns, severity, name, port, message); });
  }
  /// `json` is one object {...} as it goes to the status socket; "crc" is added.
  void health(To... to, std::int64_t now_ns, std::string_view json) {
    self().put(to..., {topic::kHealth, now_ns, now_ns}, [&](std::string& out) { out += json; });
  }
  void calib(To... to, std::int64_t now_ns, std::string_view json) {
    self().put(to..., {topic::kCalib, now_ns, now_ns}, [&](std::string& out) { out += json; });
  }
  /// The outcome of an order to the motor card at port `device`, known at `now_ns`.
  void command(To... to, std::int64_t now_ns, std::string_view device, const control::OrderRecord& record) {
    const std::int64_t validity_ns = record.sent_ns.value_or(record.asked_ns.value_or(now_ns));
    self().put(to..., {topic::kCommand, now_ns, validity_ns, device},
               [&](std::string& out) { append_json(out, mapping_, now_ns, device, record); });
  }

 protected:
  pipeline::UtcMapping mapping_;

 private:
  Derived& self() { return static_cast<Derived&>(*this); }
  template <class Sample>
  void put_of_port(To... to, std::uint16_t topic, const Sample& sample) {
    const std::string_view device = self().port_name(sample.port);
    const auto& stamp = sample.stamp;
    self().put(to..., {topic, stamp.arrival_ns, stamp.validity_ns, device, stamp.validity_utc_ns, true},
               [&](std::string& out) { append_json(out, sample, device); });
  }
};

}  // namespace navcal::record
