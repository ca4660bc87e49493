// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "daemon/record_topics.h"
#include "daemon/report_class.h"
#include "daemon/request.h"

namespace navcal::daemon {

// Replies of the status socket about itself, in gpsd's terms. Each function appends one line with kLineEnd,
// unless it says otherwise.

/// Version of gpsd's protocol that these replies follow: that of gpsd 3.22.
inline constexpr int kProtocolMajor = 3;
inline constexpr int kProtocolMinor = 14;

/// A configured port as gpsd's clients see it.
struct DeviceState {
  std::string_view name;    ///< "path" of the DEVICE object and "device" of every report
  std::string_view driver;  ///< its protocol
  std::string_view tty;     ///< open device; empty while it is absent
  int baud = 0;
  double cycle_s = 0;  ///< nominal time between frames; 0: not periodic
  bool gps = false;
  std::optional<std::int64_t> activated_utc_ns;  ///< absent while it is away
};

void append_version(std::string& out);
/// The object alone, without newline.
void append_device_object(std::string& out, const DeviceState& device);
/// Active policy; classes, rates and topics only where a client chose them. "nmea":false and "raw":0 state that
/// NMEA and raw pass-through are not offered.
struct WatchPolicy {
  bool enable = false;
  bool json = false;
  bool nmea = false;
  std::optional<std::string_view> device;
  ReportClasses classes = ReportClasses::usual();
  ReportIntervals intervals_ns{};
  RecordTopics topics = RecordTopics::all();
  RecordIntervals topic_intervals_ns{};
  std::int64_t nmea_interval_ns = kNmeaInterval_ns;
};
void append_watch(std::string& out, const WatchPolicy& policy);
/// RECORDS: the topics that RECORD has, with the names and JSON schemas of the log's.
void append_records(std::string& out);
void append_error(std::string& out, std::string_view message);

}  // namespace navcal::daemon
