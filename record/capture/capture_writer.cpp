// SPDX-License-Identifier: Apache-2.0
#include "record/capture/capture_writer.h"

#include <fmt/format.h>

#include <algorithm>

#include "record/capture/capture_reader.h"
#include "record/content_hash.h"
#include "record/json/json_object.h"

namespace navcal::record {

CaptureWriter::CaptureWriter(const std::vector<config::PortSettings>& ports) : ports_(ports) {}

void CaptureWriter::begin(std::string& out) const {
  out += kCaptureFirstLine;
  out += '\n';
  for (const auto& port : ports_) {
    out += fmt::format("#port {} {} {}\n", port.name, protocols::name_of(port.protocol), port.baud);
  }
}

void CaptureWriter::bytes(std::string& out, std::uint16_t port, Direction direction, std::int64_t utc_ns,
                          protocols::Bytes bytes) {
  constexpr std::size_t kMostBytesOfALine = 4096;
  if (utc_ns < last_ns_) {
    utc_ns = last_ns_;
    ++raised_;
  }
  last_ns_ = utc_ns;
  while (!bytes.empty()) {
    const protocols::Bytes part = bytes.first(std::min(bytes.size(), kMostBytesOfALine));
    append_seconds(out, utc_ns);
    out += ' ';
    out += ports_[port].name;
    out += direction == Direction::received ? " < " : " > ";
    append_hexadecimal(out, part);
    out += '\n';
    bytes = bytes.subspan(part.size());
  }
}

void CaptureWriter::comment(std::string& out, std::string_view text) {
  out += '#';
  for (const char c : text) out += c == '\n' || c == '\r' ? ' ' : c;
  out += '\n';
}

}  // namespace navcal::record
