// SPDX-License-Identifier: Apache-2.0
#include "analysis/import/ros_bag.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>

#include "analysis/import/decompress.h"
#include "analysis/import/ros_commands.h"
#include "analysis/import/ros_messages.h"
#include "analysis/import/wire_reader.h"
#include "record/log/mcap_format.h"
#include "record/recording.h"

namespace navcal::analysis {
namespace {

using record::kMcapMagic;
using record::kRecordHead;
using record::Opcode;

constexpr std::uint8_t kChunk = 0x06;

/// Takes fields of a record from front to back; what lies beyond its end is empty or zero.
class RecordReader {
 public:
  explicit RecordReader(std::string_view record) : rest_(record) {}
  template <class T>
  T number() {
    const T value = little_endian_at<T>(rest_, 0);
    rest_.remove_prefix(std::min(sizeof(T), rest_.size()));
    return value;
  }
  std::string_view text() {
    const std::size_t length = std::min<std::size_t>(number<std::uint32_t>(), rest_.size());
    const std::string_view taken = rest_.substr(0, length);
    rest_.remove_prefix(length);
    return taken;
  }
  [[nodiscard]] std::string_view rest() const { return rest_; }

 private:
  std::string_view rest_;
};

struct BagChannel {
  ros::Topic topic;
  const ros::MessageType* type = nullptr;
  std::string command_type;  ///< of messages with commands; empty: others
  std::string left_as;       ///< why its messages are not taken
};

class RosBag {
 public:
  RosBag(std::string_view file, ImportSink& sink, MotorChannels& channels)
      : file_(file), sink_(sink), motor_channels_(channels) {}

  ImportFindings read() {
    findings_.times_are_utc = true;
    read_records(file_.substr(kMcapMagic.size()), kMcapMagic.size(), true);
    return std::move(findings_);
  }

 private:
  /// `offset`: of the records in the file.
  void read_records(std::string_view records, std::uint64_t offset, bool is_file) {
    while (!records.empty()) {
      const std::uint64_t length = little_endian_at<std::uint64_t>(records, 1);
      if (records.size() < kRecordHead || length > records.size() - kRecordHead) {
        // Behind the footer the file ends with its magic.
        if (!ended_ && !findings_.cut_at) findings_.cut_at = offset;
        return;
      }
      const auto opcode = static_cast<std::uint8_t>(records.front());
      if (opcode == kChunk && !is_file)
        throw record::BadRecording(fmt::format("byte {}: a chunk in a chunk", offset));
      take(opcode, records.substr(kRecordHead, length), offset + kRecordHead);
      records.remove_prefix(kRecordHead + length);
      offset += kRecordHead + length;
      if (is_file) sink_.progress(offset);
      if (ended_) return;
    }
    if (is_file && !ended_) findings_.cut_at = offset;
  }

  void take(std::uint8_t opcode, std::string_view record, std::uint64_t offset) {
    if (opcode == kChunk) return take_chunk(record, offset);
    switch (static_cast<Opcode>(opcode)) {
      case Opcode::schema: return take_schema(record);
      case Opcode::channel: return take_channel(record);
      case Opcode::message: return take_message(record);
      case Opcode::data_end:
      case Opcode::footer: ended_ = true; return;
      default: return;
    }
  }

  void take_chunk(std::string_view record, std::uint64_t offset) {
    RecordReader reader(record);
    for (int i = 0; i < 2; ++i) (void)reader.number<std::uint64_t>();
    const auto size = reader.number<std::uint64_t>();
    (void)reader.number<std::uint32_t>();
    const std::string_view compression = reader.text().substr(0, kLongestName);
    const auto length = reader.number<std::uint64_t>();
    const std::string_view inside = reader.rest().substr(0, length);
    if (compression.empty()) return read_records(inside, offset + (record.size() - reader.rest().size()), false);
    const auto whole = decompressed_chunk(compression, inside, size);
    if (!whole) return sink_.left(fmt::format("chunk (compressed with {}, and damaged)", compression));
    read_records(*whole, offset, false);
  }

  void take_schema(std::string_view record) {
    RecordReader reader(record);
    const auto id = reader.number<std::uint16_t>();
    schemas_[id] = reader.text().substr(0, kLongestName);
  }

  void take_channel(std::string_view record) {
    RecordReader reader(record);
    const auto id = reader.number<std::uint16_t>();
    const auto schema = schemas_.find(reader.number<std::uint16_t>());
    if (channels_.count(id) > 0) return;
    BagChannel channel;
    channel.topic.name = reader.text().substr(0, kLongestName);
    const std::string_view encoding = reader.text();
    const std::string type = schema == schemas_.end() ? "no type" : schema->second;
    channel.type = encoding == "cdr" ? ros::message_type(type) : nullptr;
    channel.left_as = fmt::format("{} ({}{})", channel.topic.name, type, encoding == "cdr" ? "" : ", not in CDR");
    if (encoding == "cdr" && ros::has_commands(type)) channel.command_type = type;
    if (channel.type != nullptr) channel.topic.instance = instances_[channel.type->kind]++;
    channels_.emplace(id, std::move(channel));
  }

  void take_message(std::string_view record) {
    RecordReader reader(record);
    const auto channel = channels_.find(reader.number<std::uint16_t>());
    (void)reader.number<std::uint32_t>();
    const auto log_time_ns = reader.number<std::uint64_t>();
    (void)reader.number<std::uint64_t>();
    if (channel == channels_.end()) return sink_.left("message without a channel");
    const BagChannel& of = channel->second;
    constexpr std::uint64_t kLast_ns = 9'000'000'000'000'000'000;
    if (!of.command_type.empty() && log_time_ns < kLast_ns)
      return take_commands(of, reader.rest(), static_cast<std::int64_t>(log_time_ns));
    if (of.type == nullptr) return sink_.left(of.left_as);
    const bool is_good = log_time_ns < kLast_ns &&
                         of.type->decode(reader.rest(), of.topic, static_cast<std::int64_t>(log_time_ns), sink_);
    if (!is_good) sink_.left(fmt::format("{} (not a whole message of its type)", of.topic.name));
  }

  void take_commands(const BagChannel& of, std::string_view cdr, std::int64_t log_time_ns) {
    const auto found = ros::decode_commands(of.command_type, cdr);
    if (!found) return sink_.left(fmt::format("{} (not a whole message of its type)", of.topic.name));
    ImportedSample sample = ros::sample_of(of.topic, PortKind::motor, log_time_ns, found->stamp_ns);
    const auto read = [&](std::string_view member) -> std::optional<double> {
      for (const auto& [name, value] : found->values) {
        if (name == member) return value;
      }
      return std::nullopt;
    };
    const bool is_mapped = motor_channels_.emit(of.topic.name, read, sample, sink_);
    std::size_t number = 0;
    for (const auto& [name, value] : found->values) {
      ++number;
      if (!found->are_pulses || value == 0 || motor_channels_.has(of.topic.name, name)) continue;
      protocols::samples_line::LineWriter line("SENSOR");
      line.text("quantity", fmt::format("output{}", number)).text("unit", "us").number("value", value);
      sink_.sample(sample, line);
      sample.continues = true;
    }
    if (!is_mapped && !sample.continues) sink_.left(of.left_as);
  }

  std::string_view file_;
  ImportSink& sink_;
  MotorChannels& motor_channels_;
  ImportFindings findings_;
  std::map<std::uint16_t, std::string> schemas_;
  std::map<std::uint16_t, BagChannel> channels_;
  std::map<PortKind, int> instances_;
  bool ended_ = false;
};

}  // namespace

bool is_ros_bag(std::string_view head) {
  if (!head.starts_with(kMcapMagic)) return false;
  const std::size_t profile = kMcapMagic.size() + kRecordHead;
  RecordReader reader(head.substr(std::min(profile, head.size())));
  return reader.text() != record::kProfile;
}

ImportFindings read_ros_bag(std::string_view file, ImportSink& sink, MotorChannels& channels) {
  if (!file.starts_with(kMcapMagic)) return {.cut_at = 0};
  return RosBag(file, sink, channels).read();
}

}  // namespace navcal::analysis
