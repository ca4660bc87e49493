// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "config/settings.h"
#include "record/read_window.h"
#include "record/recording.h"

namespace navcal::record {

inline constexpr std::string_view kCaptureFirstLine = "#capture 1";

/// Reads a capture (ICD section 5, docs/capture-format.md) line by line, in constant memory.
class CaptureReader {
 public:
  /// Reads as far as the first line with bytes. `name` stands for the file in messages. Throws BadRecording, which
  /// names file and line, as next() does.
  CaptureReader(std::unique_ptr<ByteSource> source, std::string name);

  /// The next line with bytes, as UTC; false at the end.
  bool next(RawRead& read);

  /// Texts of the `#event` lines between the line with bytes that next() gave last and the one that follows it;
  /// before the first call of next(), those at the head of the file. Each is given once.
  [[nodiscard]] std::vector<std::string> take_events();

  [[nodiscard]] const std::vector<config::PortSettings>& ports() const { return ports_; }
  /// "FILE:17: last line cut short: left out".
  [[nodiscard]] const std::vector<std::string>& remarks() const { return remarks_; }
  [[nodiscard]] double progress() const;

 private:
  bool read_line(std::string_view& line);
  bool find_read();
  void parse_port(std::string_view line);
  void parse_read(std::string_view line, RawRead& read);
  [[nodiscard]] std::uint16_t port_index(std::string_view name) const;
  [[noreturn]] void fail(std::string_view what) const;

  ReadWindow window_;
  std::string name_;
  std::vector<config::PortSettings> ports_;
  std::vector<std::string> remarks_, events_;
  std::string_view pending_;  ///< the line with bytes that find_read() came to
  std::size_t pass_ = 0;      ///< length of the line handed out last, with its end
  std::uint64_t line_ = 0;
  std::int64_t last_ns_ = 0;
};

}  // namespace navcal::record
