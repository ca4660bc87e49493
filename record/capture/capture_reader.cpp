// SPDX-License-Identifier: Apache-2.0
#include "record/capture/capture_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "base/line_reader.h"
#include "config/described/outputs_port.h"
#include "config/load.h"
#include "config/text_rules.h"
#include "protocols/decimal.h"
#include "protocols/device_types.h"
#include "record/json/mapping_json.h"

namespace navcal::record {
namespace {

constexpr std::size_t kMaxBytes = 4096;
/// The longest line with bytes has some 8.3 kB; comments may be longer.
constexpr std::size_t kMaxLine = 64 << 10;
constexpr std::size_t kMaxPorts = 1000;
constexpr std::string_view kCaptureLine = "#capture ";
constexpr std::string_view kPort = "#port ";
constexpr std::string_view kEventLine = "#event ";

constexpr std::uint8_t kNoDigit = 0xFF;
constexpr std::array<std::uint8_t, 256> kHexadecimal = [] {
  std::array<std::uint8_t, 256> digits{};
  digits.fill(kNoDigit);
  for (std::uint8_t i = 0; i < 10; ++i) digits['0' + i] = i;
  for (std::uint8_t i = 0; i < 6; ++i) digits['a' + i] = static_cast<std::uint8_t>(10 + i);
  return digits;
}();

/// Digits, a point, nine digits.
std::optional<std::int64_t> parse_stamp(std::string_view word) {
  const std::size_t dot = word.find('.');
  if (dot == std::string_view::npos || word.size() - dot != 10 || word.front() == '-') return std::nullopt;
  return nanoseconds(word);
}

std::string protocol_names() {
  std::string names;
  for (const auto& device : protocols::kDeviceTypes) {
    names += names.empty() ? "" : ", ";
    names += device.name;
  }
  return names;
}

/// A capture does not say what a described device sends. The outputs to the actuators of a simulated layout are
/// known without that.
config::PortSettings port_of(std::string_view name, protocols::Protocol protocol, int baud) {
  if (protocol != protocols::Protocol::described || name != config::kOutputsPort) {
    return config::default_port(std::string(name), protocol, baud);
  }
  config::PortSettings outputs = config::outputs_port();
  outputs.baud = baud;
  return outputs;
}

}  // namespace

CaptureReader::CaptureReader(std::unique_ptr<ByteSource> source, std::string name)
    : window_(std::move(source)), name_(std::move(name)) {
  std::string_view first;
  if (!read_line(first)) fail("empty: a capture begins with \"#capture 1\"");
  if (first != kCaptureFirstLine) {
    fail(first.starts_with(kCaptureLine) ? "this version of captures is not known; 1 is"
                                         : "a capture begins with \"#capture 1\"");
  }
  find_read();
}

std::vector<std::string> CaptureReader::take_events() { return std::exchange(events_, {}); }

bool CaptureReader::next(RawRead& read) {
  if (pending_.empty()) return false;
  parse_read(pending_, read);
  find_read();
  return true;
}

/// Goes over comments and port lines to the next line with bytes.
bool CaptureReader::find_read() {
  std::string_view line;
  while (read_line(line)) {
    if (line.empty()) fail("empty line");
    if (line.front() != '#') {
      pending_ = line;
      return true;
    }
    if (line.starts_with(kPort)) parse_port(line);
    if (line.starts_with(kEventLine)) events_.emplace_back(line.substr(kEventLine.size()));
    if (line.starts_with(kCaptureLine)) fail("a second \"#capture\" line");
  }
  pending_ = {};
  return false;
}

bool CaptureReader::read_line(std::string_view& line) {
  window_.advance(pass_);
  pass_ = 0;
  std::size_t end = window_.view().find('\n');
  if (end == std::string_view::npos) {
    window_.ensure(kMaxLine);
    end = window_.view().find('\n');
  }
  if (window_.view().empty()) return false;
  ++line_;
  if (std::min(end, window_.view().size()) >= kMaxLine) fail("line is longer than 65535 bytes");
  if (end == std::string_view::npos) {
    remarks_.push_back(fmt::format("{}:{}: last line cut short: left out", name_, line_));
    window_.advance(window_.view().size());
    return false;
  }
  line = window_.view().substr(0, end);
  if (line.ends_with('\r')) {
    fail("line ends in CR LF; a capture's lines end in LF alone (sed 's/\\r$//' FILE converts it)");
  }
  pass_ = end + 1;
  return true;
}

void CaptureReader::parse_port(std::string_view line) {
  if (last_ns_ != 0) fail("a port line behind the first line with bytes");
  std::string_view rest = line.substr(kPort.size());
  const std::string_view port_name = base::take_until(rest, " ");
  const std::string_view protocol_name = base::take_until(rest, " ");
  const std::string_view baud_text = base::take_until(rest, " ");
  if (!config::is_port_name(port_name)) fail("a port's name is 1 to 31 of a-z, 0-9, _ and -");
  const auto protocol = protocols::protocol_named(protocol_name);
  if (!protocol) fail("protocol must be one of " + protocol_names());
  const int baud = protocols::integer<int>(baud_text).value_or(0);
  if (baud < 1 || baud > 4'000'000) fail("speed must be a number of 1 to 4000000 baud");
  if (!rest.empty()) fail("more behind the speed of a port line");
  for (const auto& port : ports_) {
    if (port.name == port_name) fail("the port is named a second time");
  }
  if (ports_.size() >= kMaxPorts) fail("more than 1000 ports");
  ports_.push_back(port_of(port_name, *protocol, baud));
}

void CaptureReader::parse_read(std::string_view line, RawRead& read) {
  std::string_view rest = line;
  const auto stamp = parse_stamp(base::take_until(rest, " "));
  if (!stamp) fail("expected UTC seconds with nine decimals");
  if (*stamp < last_ns_) fail("time goes backwards");
  const std::string_view port_name = base::take_until(rest, " ");
  const std::string_view arrow = base::take_until(rest, " ");
  if (arrow != "<" && arrow != ">") fail("expected \"STAMP PORT < BYTES\", or \">\" for bytes sent");
  if (rest.empty() || rest.size() % 2 != 0 || rest.size() > 2 * kMaxBytes) {
    fail("expected 1 to 4096 bytes of two hexadecimal digits each");
  }
  read.port = port_index(port_name);
  read.direction = arrow == "<" ? Direction::received : Direction::sent;
  read.time_ns = *stamp;
  read.bytes.resize(rest.size() / 2);
  unsigned bad = 0;
  for (std::size_t i = 0; i < read.bytes.size(); ++i) {
    const std::uint8_t high = kHexadecimal[static_cast<unsigned char>(rest[2 * i])];
    const std::uint8_t low = kHexadecimal[static_cast<unsigned char>(rest[2 * i + 1])];
    bad |= (high | low) & 0x80U;
    read.bytes[i] = static_cast<std::uint8_t>(high << 4 | low);
  }
  if (bad != 0) fail("bytes must be lower-case hexadecimal");
  last_ns_ = *stamp;
}

std::uint16_t CaptureReader::port_index(std::string_view port_name) const {
  for (std::size_t i = 0; i < ports_.size(); ++i) {
    if (ports_[i].name == port_name) return static_cast<std::uint16_t>(i);
  }
  fail("no \"#port\" line names this port");
}

void CaptureReader::fail(std::string_view what) const {
  throw BadRecording(fmt::format("{}:{}: {}", name_, line_, what));
}

double CaptureReader::progress() const {
  if (window_.size() == 0) return 1.0;
  return static_cast<double>(window_.offset()) / static_cast<double>(window_.size());
}

}  // namespace navcal::record
