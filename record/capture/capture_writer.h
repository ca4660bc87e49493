// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "config/settings.h"
#include "protocols/frame.h"
#include "record/log/log_encoder.h"

namespace navcal::record {

/// Writes the text of a capture (ICD section 5). Pure: appends to a buffer, which the caller takes to a file.
class CaptureWriter {
 public:
  explicit CaptureWriter(const std::vector<config::PortSettings>& ports);

  /// The first line and the port lines.
  void begin(std::string& out) const;
  /// One line, or several of the same time where there are more than 4096 bytes. A time before that of the line
  /// before it is raised to it, since a capture's time never goes back.
  void bytes(std::string& out, std::uint16_t port, Direction direction, std::int64_t utc_ns,
             protocols::Bytes bytes);
  /// "#TEXT", for instance "event 12.5 dive begins". Line ends in the text become spaces.
  static void comment(std::string& out, std::string_view text);

  /// How many times were raised.
  [[nodiscard]] std::uint64_t raised() const { return raised_; }

 private:
  std::vector<config::PortSettings> ports_;
  std::int64_t last_ns_ = 0;
  std::uint64_t raised_ = 0;
};

}  // namespace navcal::record
