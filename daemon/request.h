// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "daemon/record_topics.h"
#include "daemon/report_class.h"

namespace navcal::daemon {

/// Longest request line taken; gpsd's own clients stay below 200 bytes.
inline constexpr std::size_t kMaxRequestLength = 4096;

/// Bounds of the rates in ?WATCH.
inline constexpr double kMinReportRate_Hz = 0.01;
inline constexpr double kMaxReportRate_Hz = 100;
/// Shortest time between two NMEA sentences of one kind and device, unless a client chooses.
inline constexpr std::int64_t kNmeaInterval_ns = 100'000'000;

/// Changes requested by ?WATCH={...}. A field that is absent stays as it is.
struct WatchChange {
  bool enable = true;
  std::optional<bool> json;
  std::optional<bool> nmea;
  std::optional<std::int64_t> nmea_interval_ns;
  std::optional<std::string> device;
  std::optional<ReportClasses> classes;
  std::optional<ReportIntervals> intervals_ns;
  std::optional<RecordTopics> topics;
  std::optional<RecordIntervals> topic_intervals_ns;
};

/// One command of gpsd's protocol.
struct Request {
  enum class Kind { version, devices, device, watch, poll, records, not_understood };
  Kind kind = Kind::not_understood;
  std::optional<WatchChange> watch;   ///< absent for a bare ?WATCH;, which only asks
  std::optional<std::string> device;  ///< ?DEVICE={"path":...}
  std::string message;                ///< for not_understood: why, for people
};

/// The commands of one line, in order: "?WATCH={...};?POLL;". A command ends with its semicolon, with the brace
/// that closes its object, or with the line.
[[nodiscard]] std::vector<Request> parse_requests(std::string_view line);

/// Clients leave out the newline, some the semicolon, too. Length of the commands at the beginning of `text` that
/// are complete, whatever follows.
[[nodiscard]] std::size_t complete_length(std::string_view text);

}  // namespace navcal::daemon
