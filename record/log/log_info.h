// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "record/log/log_reader.h"

namespace navcal::record {

/// Called now and then with how far a file has been read, 0..1.
using Progress = std::function<void(double)>;

/// Summary of a log or a capture.
struct RecordingInfo {
  struct Port {
    std::string name, protocol;
    int baud = 0;
    std::uint64_t reads = 0, received_bytes = 0, sent = 0, sent_bytes = 0;
    std::int64_t first_ns = 0, last_ns = 0;  ///< of the reads
    std::int64_t longest_gap_ns = 0;         ///< between two reads
    std::uint64_t gaps = 0;                  ///< longer than 2 s, or ten nominal periods where that is more
  };
  struct Event {
    std::string time, severity, name, port, message;
  };

  std::string file;
  std::uint64_t bytes = 0;
  bool log = false;
  bool finished = true;
  std::uint64_t bad_crc = 0, damaged_bytes = 0, tail_bytes = 0;
  std::int64_t start_utc_ns = 0, end_utc_ns = 0;
  std::vector<Port> ports;
  struct Topic {
    std::uint64_t messages = 0, bytes = 0;
  };
  std::map<std::string, Topic> topics;
  std::vector<Event> events;  ///< the first hundred
  std::uint64_t further_events = 0;
  std::vector<std::string> remarks;
};

/// Throws BadRecording.
[[nodiscard]] RecordingInfo read_info(const std::filesystem::path& file, const Progress& progress);

/// The summary as text, and as one JSON object.
[[nodiscard]] std::string to_text(const RecordingInfo& info);
[[nodiscard]] std::string to_json(const RecordingInfo& info);

}  // namespace navcal::record
