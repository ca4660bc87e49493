// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "analysis/import/decompress.h"
#include "analysis/import/log_readers.h"
#include "analysis/import/ros_messages.h"
#include "analysis/import/wire_reader.h"
#include "protocols/ros2/cdr_reader.h"
#include "protocols/ros2/ros_messages.h"
#include "record/log/checksum.h"
#include "record/log/mcap_fields.h"
#include "record/recording.h"

namespace navcal::analysis {
namespace {

using record::kMcapMagic;
using record::kRecordHead;
using record::McapFields;
using record::Opcode;

/// Numbers of one message of commands or of joints.
struct CommandValues {
  std::int64_t stamp_ns = 0;  ///< of its header; 0: it has none
  /// By the name of the member as a map has it: "data", "data[1]", "channels[0]", "rudder/position".
  std::vector<std::pair<std::string, double>> values;
  /// The numbers are pulses in us, which are samples also without a map.
  bool are_pulses = false;
};

namespace ros2 = protocols::ros2;

template <class T>
void take_list(const std::vector<T>& numbers, std::string_view name, CommandValues& found) {
  for (std::size_t i = 0; i < numbers.size(); ++i)
    found.values.emplace_back(fmt::format("{}[{}]", name, i), static_cast<double>(numbers[i]));
}

template <class T>
void take(const ros2::Number<T>& number, CommandValues& found) {
  found.values.emplace_back("data", static_cast<double>(number.data));
}

template <class T>
void take(const ros2::NumberArray<T>& array, CommandValues& found) {
  take_list(array.data, "data", found);
}

void take(const ros2::RcOut& outputs, CommandValues& found) {
  found.are_pulses = true;
  found.stamp_ns = outputs.header.stamp_ns();
  take_list(outputs.channels, "channels", found);
}

void take(const ros2::JointState& joints, CommandValues& found) {
  found.stamp_ns = joints.header.stamp_ns();
  const auto take_of = [&](const std::vector<double>& values, std::string_view quantity) {
    for (std::size_t i = 0; i < std::min(values.size(), joints.name.size()); ++i)
      found.values.emplace_back(fmt::format("{}/{}", joints.name[i], quantity), values[i]);
  };
  take_of(joints.position, "position");
  take_of(joints.velocity, "velocity");
  take_of(joints.effort, "effort");
}

struct CommandType {
  std::string name;
  std::optional<CommandValues> (*decode)(std::string_view cdr);
};
template <class Message>
CommandType type_with_commands() {
  return {ros2::full_name(Message::kType), [](std::string_view cdr) -> std::optional<CommandValues> {
            const auto message = ros2::decode<Message>(cdr);
            if (!message) return std::nullopt;
            CommandValues found;
            take(*message, found);
            return found;
          }};
}

const CommandType* command_type(std::string_view name) {
  static const std::array kCommandTypes{type_with_commands<ros2::Number<float>>(),
                                        type_with_commands<ros2::Number<double>>(),
                                        type_with_commands<ros2::NumberArray<float>>(),
                                        type_with_commands<ros2::NumberArray<double>>(),
                                        type_with_commands<ros2::RcOut>(),
                                        type_with_commands<ros2::JointState>()};
  const auto found = std::ranges::find(kCommandTypes, name, &CommandType::name);
  return found == kCommandTypes.end() ? nullptr : &*found;
}

/// Whether messages of this type are read: std_msgs Float32, Float64 and their arrays, mavros_msgs/RCOut,
/// sensor_msgs/JointState.
bool has_commands(std::string_view type) { return command_type(type) != nullptr; }

/// nullopt when the message is shorter than its type.
std::optional<CommandValues> decode_commands(std::string_view type, std::string_view cdr) {
  const CommandType* const known = command_type(type);
  return known == nullptr ? std::nullopt : known->decode(cdr);
}

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
      const auto opcode = static_cast<Opcode>(records.front());
      if (opcode == Opcode::chunk && !is_file)
        throw record::BadRecording(fmt::format("byte {}: a chunk in a chunk", offset));
      take(opcode, records.substr(kRecordHead, length), offset + kRecordHead);
      records.remove_prefix(kRecordHead + length);
      offset += kRecordHead + length;
      if (is_file) sink_.progress(offset);
      if (ended_) return;
    }
    if (is_file && !ended_) findings_.cut_at = offset;
  }

  void take(Opcode opcode, std::string_view record, std::uint64_t offset) {
    switch (opcode) {
      case Opcode::chunk: return take_chunk(record, offset);
      case Opcode::schema: return take_schema(record);
      case Opcode::channel: return take_channel(record);
      case Opcode::message: return take_message(record);
      case Opcode::data_end:
      case Opcode::footer: ended_ = true; return;
      default: return;
    }
  }

  void take_chunk(std::string_view record, std::uint64_t offset) {
    McapFields reader(record);
    for (int i = 0; i < 2; ++i) (void)reader.integer<std::uint64_t>();
    const auto size = reader.integer<std::uint64_t>();
    const auto crc = reader.integer<std::uint32_t>();
    const std::string_view compression = reader.string().substr(0, kLongestName);
    const auto length = reader.integer<std::uint64_t>();
    const std::string_view inside = reader.rest().substr(0, length);
    const bool is_plain = compression.empty();
    const auto whole = is_plain ? std::nullopt : decompressed_chunk(compression, inside);
    const std::string_view bytes = whole ? *whole : inside;
    const bool has_come_out = is_plain || (whole && bytes.size() == size);
    if (has_come_out && (crc == 0 || record::crc32(bytes) == crc))
      return read_records(bytes, is_plain ? offset + (record.size() - reader.rest().size()) : offset, false);
    constexpr int kMostNamed = 10;
    const std::string_view reason = has_come_out ? "its sum is wrong" : "cannot be decompressed";
    const std::string form = is_plain ? "not compressed" : fmt::format("compressed with {}", compression);
    if (++bad_chunks_ <= kMostNamed)
      findings_.remarks.push_back(
          fmt::format("byte {}: chunk of {} bytes left ({}, {})", offset - kRecordHead, size, form, reason));
    sink_.left(fmt::format("chunk ({}, {})", form, reason));
  }

  /// Types and channels stand in the summary too: a damaged chunk does not take those of others with it.
  void read_summary() {
    constexpr std::size_t kEnd = kRecordHead + record::kFooterLength + kMcapMagic.size();
    if (std::exchange(has_read_summary_, true) || file_.size() < kEnd || !file_.ends_with(kMcapMagic)) return;
    const std::size_t footer = file_.size() - kEnd;
    std::size_t at = little_endian_at<std::uint64_t>(file_, footer + kRecordHead);
    while (at > 0 && at < footer && footer - at > kRecordHead) {
      const std::uint64_t length = little_endian_at<std::uint64_t>(file_, at + 1);
      if (length > footer - at - kRecordHead) return;
      const auto opcode = static_cast<Opcode>(file_[at]);
      if (opcode == Opcode::schema || opcode == Opcode::channel)
        take(opcode, file_.substr(at + kRecordHead, length), at + kRecordHead);
      at += kRecordHead + length;
    }
  }

  void take_schema(std::string_view record) {
    McapFields reader(record);
    const auto id = reader.integer<std::uint16_t>();
    schemas_[id] = reader.string().substr(0, kLongestName);
  }

  void take_channel(std::string_view record) {
    McapFields reader(record);
    const auto id = reader.integer<std::uint16_t>();
    const auto schema = schemas_.find(reader.integer<std::uint16_t>());
    if (channels_.count(id) > 0) return;
    BagChannel channel;
    channel.topic.name = reader.string().substr(0, kLongestName);
    const std::string_view encoding = reader.string();
    const std::string type = schema == schemas_.end() ? "no type" : schema->second;
    channel.type = encoding == "cdr" ? ros::message_type(type) : nullptr;
    channel.left_as = fmt::format("{} ({}{})", channel.topic.name, type, encoding == "cdr" ? "" : ", not in CDR");
    if (encoding == "cdr" && has_commands(type)) channel.command_type = type;
    if (channel.type != nullptr) channel.topic.instance = instances_[channel.type->kind]++;
    channels_.emplace(id, std::move(channel));
  }

  void take_message(std::string_view record) {
    McapFields reader(record);
    const auto id = reader.integer<std::uint16_t>();
    if (!channels_.contains(id)) read_summary();
    const auto channel = channels_.find(id);
    (void)reader.integer<std::uint32_t>();
    const auto log_time_ns = reader.integer<std::uint64_t>();
    (void)reader.integer<std::uint64_t>();
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
    const auto found = decode_commands(of.command_type, cdr);
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
  int bad_chunks_ = 0;
  bool has_read_summary_ = false;
  bool ended_ = false;
};

}  // namespace

bool is_ros_bag(std::string_view head) {
  if (!head.starts_with(kMcapMagic)) return false;
  const std::size_t profile = kMcapMagic.size() + kRecordHead;
  McapFields reader(head.substr(std::min(profile, head.size())));
  return reader.string() != record::kProfile;
}

ImportFindings read_ros_bag(std::string_view file, ImportSink& sink, MotorChannels& channels) {
  if (!file.starts_with(kMcapMagic)) return {.cut_at = 0};
  return RosBag(file, sink, channels).read();
}

}  // namespace navcal::analysis
