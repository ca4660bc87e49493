// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

#include "record/capture/capture_writer.h"

namespace navcal::analysis {

/// A capture of exactly what went over the emulated lines, with the time at which it was on the wire. Directions
/// are the host's: `<` is what a device sent and a client could read, `>` what the client sent.
class SentLog {
 public:
  /// Throws Failure when the file cannot be made.
  SentLog(const std::filesystem::path& file, const std::vector<config::PortSettings>& ports);
  /// "#TEXT", such as "event 12.5 dive begins".
  void comment(std::string_view text);
  void add(std::uint16_t port, record::Direction direction, std::int64_t utc_ns, protocols::Bytes bytes);

 private:
  record::CaptureWriter writer_;
  std::ofstream file_;
  std::string line_;
};

}  // namespace navcal::analysis
