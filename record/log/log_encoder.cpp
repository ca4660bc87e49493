// SPDX-License-Identifier: Apache-2.0
#include "record/log/log_encoder.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "record/json/json_object.h"
#include "record/log/checksum.h"
#include "record/log/mcap_format.h"
#include "record/log/mcap_summary.h"

namespace navcal::record {

struct LogEncoder::State {
  std::vector<config::PortSettings> ports;
  config::IdentitySettings vehicle;
  std::string config_toml;
  McapSummary summary;
  std::vector<std::uint32_t> sequences;  // by channel
  std::int64_t log_offset_ns = 0;
  std::uint64_t file_bytes = 0;

  /// Counts what a call appends.
  class Appending {
   public:
    Appending(State& state, const std::string& out) : state_(state), out_(out), before_(out.size()) {}
    Appending(const Appending&) = delete;
    Appending& operator=(const Appending&) = delete;
    ~Appending() { state_.file_bytes += out_.size() - before_; }

   private:
    State& state_;
    const std::string& out_;
    std::size_t before_;
  };

  [[nodiscard]] std::uint64_t log_time(std::int64_t monotonic_ns) const {
    return static_cast<std::uint64_t>(std::max<std::int64_t>(0, monotonic_ns + log_offset_ns));
  }

  void append_message_head(std::string& out, std::uint16_t channel, std::int64_t time_ns,
                           std::int64_t publish_ns) {
    const std::uint64_t at = log_time(time_ns);
    append_le(out, channel);
    append_le(out, sequences[channel]++);
    append_le(out, at);
    append_le(out, log_time(publish_ns));
    summary.add_message(channel, at);
  }

  void append_metadata(std::string& out) {
    const std::size_t begin = out.size();
    {
      const RecordScope record(out, Opcode::metadata);
      append_mcap_string(out, kProfile);
      std::string map = mcap_map({{"format", "1"},
                                  {kLogOffsetKey, fmt::format_int(log_offset_ns).str()},
                                  {"config_crc32c", config_sum(config_toml)}});
      if (!vehicle.id.empty()) map += mcap_map({{"vehicle_id", vehicle.id}});
      if (!vehicle.name.empty()) map += mcap_map({{"vehicle_name", vehicle.name}});
      append_mcap_string(out, map);
    }
    summary.add_metadata(begin, out.size() - begin, kProfile);
  }

  void append_schema(std::string& out, const Topic& topic) {
    const std::size_t begin = out.size();
    record::append_schema(out, topic.id, topic.schema_name, "jsonschema", json_schema(topic));
    summary.add_schema(topic.id, std::string_view(out).substr(begin));
  }

  void append_channel(std::string& out, std::uint16_t id, std::uint16_t schema, std::string_view name,
                      std::string_view encoding, std::string_view metadata) {
    const std::size_t begin = out.size();
    record::append_channel(out, id, schema, name, encoding, metadata);
    summary.add_channel(id, std::string_view(out).substr(begin));
  }

  void append_raw_channel(std::string& out, std::uint16_t port) {
    std::string metadata = mcap_map({{"baud", fmt::format_int(ports[port].baud).str()},
                                     {"protocol", protocols::name_of(ports[port].protocol)}});
    if (const auto& serial = ports[port].serial_number; !serial.empty())
      metadata += mcap_map({{"serial_number", serial}});
    append_channel(out, static_cast<std::uint16_t>(topic::kFirstRaw + port), 0,
                   std::string(topic::kRawPrefix) + ports[port].name, kRawEncoding, metadata);
  }

  void append_definitions(std::string& out) {
    const Appending counted(*this, out);
    out += empty_log_head();
    append_metadata(out);
    for (const Topic& topic : json_topics()) {
      append_schema(out, topic);
      append_channel(out, topic.id, topic.id, topic.name, kJsonEncoding, "");
    }
    for (std::size_t i = 0; i < ports.size(); ++i) append_raw_channel(out, static_cast<std::uint16_t>(i));
  }
};

std::string config_sum(std::string_view config_toml) { return fmt::format("{:08x}", crc32c(config_toml)); }

LogEncoder::LogEncoder(const config::Settings& settings, std::string config_toml)
    : state_(std::make_unique<State>()) {
  state_->ports = settings.ports;
  state_->vehicle = settings.vehicle;
  state_->config_toml = std::move(config_toml);
}

LogEncoder::~LogEncoder() = default;

void LogEncoder::begin(std::string& out, std::int64_t now_ns, const pipeline::UtcMapping& mapping) {
  State& s = *state_;
  s.summary = {};
  s.sequences.assign(topic::kFirstRaw + s.ports.size(), 0);
  s.file_bytes = 0;
  s.log_offset_ns = mapping.offset_ns;
  // Offsets in the metadata index count from the magic: it must be the first thing in the caller's buffer.
  std::string head;
  s.append_definitions(head);
  out += head;
  put(out, {topic::kConfig, now_ns, now_ns}, [&](std::string& text) {
    JsonObject json(text, "CONFIG");
    json.seconds("time", mapping.to_utc(now_ns));
    json.seconds("monotonic", now_ns);
    json.text("toml", s.config_toml);
  });
  this->mapping(out, now_ns, mapping);
}

void LogEncoder::raw(std::string& out, std::uint16_t port, Direction direction, std::int64_t time_ns,
                     protocols::Bytes bytes) {
  State& s = *state_;
  const State::Appending counted(s, out);
  const RecordScope record(out, Opcode::message);
  s.append_message_head(out, static_cast<std::uint16_t>(topic::kFirstRaw + port), time_ns, time_ns);
  const std::size_t begin = out.size();
  out += static_cast<char>(direction);
  append_le(out, time_ns);
  out.append(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  append_le(out, crc32c(std::string_view(out).substr(begin)));
}

void LogEncoder::put(std::string& out, const MessageHead& head, const AppendJson& append) {
  const State::Appending counted(*state_, out);
  const RecordScope record(out, Opcode::message);
  state_->append_message_head(out, head.topic, head.time_ns, head.validity_ns);
  append_payload(out, append);
}

std::string_view LogEncoder::port_name(std::uint16_t port) const { return state_->ports[port].name; }

void LogEncoder::finish(std::string& out, std::int64_t /*now_ns*/) {
  const std::uint64_t data_bytes = state_->file_bytes;
  const State::Appending counted(*state_, out);
  state_->summary.append_end(out, data_bytes);
}

std::uint64_t LogEncoder::file_bytes() const { return state_->file_bytes; }
std::uint64_t LogEncoder::messages() const { return state_->summary.messages(); }

}  // namespace navcal::record
