// SPDX-License-Identifier: Apache-2.0
#include "record/log/log_recording.h"

#include <fmt/format.h>

#include <charconv>

#include "config/load.h"
#include "config/text_rules.h"
#include "record/json/calibration_json.h"
#include "record/json/flat_json.h"
#include "record/json/mapping_json.h"
#include "record/log/checksum.h"
#include "record/log/log_topics.h"

namespace navcal::record {
namespace {

constexpr std::size_t kMaxRecordingRemarks = 100;

/// The object as it was before its checksum was added.
std::string without_sum(std::string_view data) {
  return std::string(data.substr(0, data.size() - kJsonTail)) + '}';
}

}  // namespace

LogRecording::LogRecording(std::unique_ptr<ByteSource> source, std::string name, LogUtc utc)
    : reader_(std::move(source), std::move(name)), utc_(std::move(utc)) {
  const auto message = reader_.next();
  if (!message || !take_configuration(*message)) {
    assume_configuration();
    if (message) first_ = entry_of(*message);
  }
}

std::optional<Entry> LogRecording::next() {
  if (first_) {
    std::optional<Entry> entry = std::move(first_);
    first_.reset();
    return entry;
  }
  std::optional<Entry> entry;
  while (!entry) {
    const auto message = reader_.next();
    const auto& found = reader_.remarks();
    for (; reader_remarks_ < found.size(); ++reader_remarks_) {
      remarks_.push_back(fmt::format("{}: {}", reader_.name(), found[reader_remarks_]));
    }
    if (!message) break;
    entry = entry_of(*message);
  }
  return entry;
}

bool LogRecording::take_configuration(const LogMessage& message) {
  if (reader_.channels().at(message.channel).topic != "/config") return false;
  const auto json = FlatJson::parse(message.data);
  if (!json) return false;
  try {
    settings_ = config::parse(json->get("toml"), reader_.name() + " (its configuration)");
  } catch (const config::Error& error) {
    remark(message, error.what());
    return false;
  }
  return true;
}

/// Name, protocol and speed of every port stand in the definition of its channel, too.
void LogRecording::assume_configuration() {
  remarks_.push_back(reader_.name() + ": its configuration cannot be read: the usual settings are assumed");
  for (const auto& [id, channel] : reader_.channels()) {
    const auto protocol = channel.metadata.find("protocol");
    const auto baud_text = channel.metadata.find("baud");
    if (!channel.raw || protocol == channel.metadata.end() || baud_text == channel.metadata.end()) continue;
    const auto known = protocols::protocol_named(protocol->second);
    int baud = 0;
    const std::string& digits = baud_text->second;
    std::from_chars(digits.data(), digits.data() + digits.size(), baud);
    if (!known || baud <= 0 || !channel.topic.starts_with(topic::kRawPrefix)) continue;
    const std::string port = channel.topic.substr(topic::kRawPrefix.size());
    // The rule of configurations and captures: the name becomes one of a file.
    if (config::is_port_name(port)) settings_.ports.push_back(config::default_port(port, *known, baud));
  }
}

std::optional<Entry> LogRecording::entry_of(const LogMessage& message) {
  const LogChannel& channel = reader_.channels().at(message.channel);
  if (channel.raw) return raw_entry(message);
  if (channel.topic == "/time") {
    const auto json = FlatJson::parse(message.data);
    const auto at = json ? nanoseconds(json->get("monotonic")) : std::nullopt;
    const auto mapping = mapping_from_json(message.data);
    if (at && mapping) return MappingChange{*at, utc_.in_place_of(*mapping)};
    remark(message, "a time mapping that cannot be read: passed over");
  } else if (channel.topic == "/event") {
    const auto json = FlatJson::parse(message.data);
    const auto at = json ? nanoseconds(json->get("monotonic")) : std::nullopt;
    if (at) {
      note_left_out(json->get("name"), json->get("message"));
      return LoggedEvent{*at, without_sum(message.data)};
    }
    remark(message, "an event that cannot be read: passed over");
  } else if (channel.topic == "/command") {
    const auto json = FlatJson::parse(message.data);
    const auto at = json ? nanoseconds(json->get("monotonic")) : std::nullopt;
    if (at) return LoggedCommand{*at, without_sum(message.data)};
    remark(message, "an order that cannot be read: passed over");
  } else if (channel.topic == "/calib" && is_calibration_change(message.data)) {
    auto change = calibration_from_json(message.data);
    if (change) return std::move(*change);
    remark(message, "a change of the calibration that cannot be read: passed over");
  }
  return std::nullopt;
}

std::optional<Entry> LogRecording::raw_entry(const LogMessage& message) {
  auto port = ports_.find(message.channel);
  if (port == ports_.end()) {
    const std::string& topic = reader_.channels().at(message.channel).topic;
    std::size_t index = 0;
    while (index < settings_.ports.size() &&
           std::string(topic::kRawPrefix) + settings_.ports[index].name != topic) {
      ++index;
    }
    if (index == settings_.ports.size()) {
      remark(message, topic + ": the configuration has no such port: passed over");
      return std::nullopt;
    }
    port = ports_.emplace(message.channel, static_cast<std::uint16_t>(index)).first;
  }
  RawRead read;
  read.port = port->second;
  read.direction = static_cast<Direction>(message.data.front());
  read.time_ns = read_le<std::int64_t>(message.data, 1);
  const std::string_view bytes = message.data.substr(kRawHead, message.data.size() - kRawHead - kRawTail);
  read.bytes.assign(bytes.begin(), bytes.end());
  return read;
}

/// Says which parts were left out on purpose, so that nobody looks for a fault.
void LogRecording::note_left_out(std::string_view event, std::string_view message) {
  if (event != "log.left_out" || message == left_out_) return;
  left_out_ = message;
  if (message == "nothing") return;
  remarks_.push_back(
      fmt::format("{}: left out of this log by log.leave_out or log.select: {}", reader_.name(), message));
}

void LogRecording::remark(const LogMessage& message, std::string_view what) {
  if (remarks_.size() >= kMaxRecordingRemarks) return;
  remarks_.push_back(fmt::format("{}: byte {}: {}", reader_.name(), message.offset, what));
}

}  // namespace navcal::record
