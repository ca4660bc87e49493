// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <zstd.h>

#include <algorithm>
#include <map>

#include "record/export/export.h"
#include "record/json/flat_json.h"
#include "record/json/mapping_json.h"
#include "record/log/checksum.h"
#include "record/log/log_utc.h"
#include "record/log/mcap_summary.h"
#include "record/recording.h"
#include "record/ros2/sample_messages.h"
#include "record/whole_file.h"

namespace navcal::record {
namespace {

constexpr std::uint64_t kBagProgressEvery = 512;

/// Reliable, the last ten, volatile, without deadlines; in the numbers of distributions before Jazzy, which all
/// later ones read.
constexpr std::string_view kOfferedQuality =
    "- history: 1\n  depth: 10\n  reliability: 1\n  durability: 2\n"
    "  deadline:\n    sec: 9223372036\n    nsec: 854775807\n"
    "  lifespan:\n    sec: 9223372036\n    nsec: 854775807\n"
    "  liveliness: 1\n  liveliness_lease_duration:\n    sec: 9223372036\n    nsec: 854775807\n"
    "  avoid_ros_namespace_conventions: false\n";

/// A bag of ROS 2: MCAP as rosbag2 writes it, in chunks compressed with zstd.
class BagFile {
 public:
  explicit BagFile(const std::filesystem::path& path) : file_(path) { write(empty_log_head("ros2")); }

  void add(const RosMessage& message, std::uint64_t log_time_ns) {
    const std::uint16_t channel = channel_of(message);
    index_[channel].emplace_back(log_time_ns, chunk_.size());
    {
      const RecordScope record(chunk_, Opcode::message);
      append_le(chunk_, channel);
      append_le(chunk_, std::uint32_t{0});  // rosbag2 does not count
      append_le(chunk_, log_time_ns);
      append_le(chunk_, message.stamp_ns);
      chunk_ += message.cdr;
    }
    summary_.add_message(channel, log_time_ns);
    start_ns_ = std::min(start_ns_, log_time_ns);
    end_ns_ = std::max(end_ns_, log_time_ns);
    constexpr std::size_t kFlushAt = 1 << 20;
    if (chunk_.size() >= kFlushAt) flush();
  }

  void commit() {
    if (!chunk_.empty()) flush();
    std::string end;
    {
      const RecordScope record(end, Opcode::metadata);
      append_mcap_string(end, "rosbag2");
      append_mcap_string(end, mcap_map({{"ROS_DISTRO", "iron"}}));
    }
    summary_.add_metadata(bytes_, end.size(), "rosbag2");
    summary_.append_end(end, bytes_ + end.size());
    write(end);
    file_.commit();
  }
  [[nodiscard]] std::uint64_t messages() const { return summary_.messages(); }

 private:
  std::uint16_t channel_of(const RosMessage& message) {
    const auto [channel, is_new] =
        channels_.try_emplace(message.topic, static_cast<std::uint16_t>(channels_.size() + 1));
    if (!is_new) return channel->second;
    const auto [schema, is_new_type] =
        schemas_.try_emplace(message.type, static_cast<std::uint16_t>(schemas_.size() + 1));
    if (is_new_type) {
      const std::size_t begin = chunk_.size();
      append_schema(chunk_, schema->second, message.type->name, "ros2msg", message.type->definition);
      summary_.add_schema(schema->second, std::string_view(chunk_).substr(begin));
    }
    const std::string metadata =
        mcap_map({{"offered_qos_profiles", kOfferedQuality}, {"topic_type_hash", message.type->hash}});
    const std::size_t begin = chunk_.size();
    append_channel(chunk_, channel->second, schema->second, message.topic, "cdr", metadata);
    summary_.add_channel(channel->second, std::string_view(chunk_).substr(begin));
    return channel->second;
  }

  void flush() {
    std::string compressed(ZSTD_compressBound(chunk_.size()), '\0');
    constexpr int kLevel = 3;
    compressed.resize(ZSTD_compress(compressed.data(), compressed.size(), chunk_.data(), chunk_.size(), kLevel));
    std::string out;
    {
      const RecordScope record(out, Opcode::chunk);
      append_le(out, start_ns_);
      append_le(out, end_ns_);
      append_le(out, std::uint64_t{chunk_.size()});
      append_le(out, crc32(chunk_));
      append_mcap_string(out, "zstd");
      append_le(out, std::uint64_t{compressed.size()});
      out += compressed;
    }
    const std::uint64_t chunk_bytes = out.size();
    std::string offsets;
    for (const auto& [channel, messages] : index_) {
      append_le(offsets, channel);
      append_le(offsets, bytes_ + out.size());
      const RecordScope record(out, Opcode::message_index);
      append_le(out, channel);
      append_le(out, static_cast<std::uint32_t>(messages.size() * 2 * sizeof(std::uint64_t)));
      for (const auto& [time_ns, offset] : messages) {
        append_le(out, time_ns);
        append_le(out, offset);
      }
    }
    std::string index;
    {
      const RecordScope record(index, Opcode::chunk_index);
      for (const std::uint64_t number : {start_ns_, end_ns_, bytes_, chunk_bytes}) append_le(index, number);
      append_mcap_string(index, offsets);
      append_le(index, out.size() - chunk_bytes);
      append_mcap_string(index, "zstd");
      append_le(index, std::uint64_t{compressed.size()});
      append_le(index, std::uint64_t{chunk_.size()});
    }
    summary_.add_chunk(index);
    write(out);
    chunk_.clear();
    index_.clear();
    start_ns_ = UINT64_MAX;
    end_ns_ = 0;
  }

  void write(std::string_view bytes) {
    file_.write(bytes);
    bytes_ += bytes.size();
  }

  WholeFile file_;
  std::uint64_t bytes_ = 0;
  McapSummary summary_;
  std::map<std::string, std::uint16_t> channels_;
  std::map<const protocols::ros2::MessageType*, std::uint16_t> schemas_;
  std::string chunk_;  ///< not yet compressed
  std::uint64_t start_ns_ = UINT64_MAX, end_ns_ = 0;
  std::map<std::uint16_t, std::vector<std::pair<std::uint64_t, std::uint64_t>>> index_;
};

Exported export_bag(const std::filesystem::path& log_file, const std::filesystem::path& path,
                    const Progress& progress, RosAxes axes) {
  LogReader log(open_file(log_file), log_file.string());
  LogUtc utc(log_file);
  SampleMessages samples(axes);
  BagFile bag(path);
  std::uint64_t messages = 0, without_utc = 0;
  while (const auto message = log.next()) {
    if (++messages % kBagProgressEvery == 0) progress(log.progress());
    const LogChannel& channel = log.channels().at(message->channel);
    if (channel.raw) continue;
    const std::string_view json = utc.on_scale(*message, log);
    constexpr std::string_view kTime = "\"time\":";
    const std::string_view from_time = json.substr(std::min(json.find(kTime), json.size()));
    const std::string_view seconds = from_time.substr(std::min(kTime.size(), from_time.size()));
    const auto arrival_ns =
        utc.mapping().to_utc(static_cast<std::int64_t>(message->log_time_ns) - log.log_offset_ns());
    // /health has its time in words. No instrument measured it, so it holds for the time when it was sent.
    const auto time_ns = seconds.starts_with('"') ? std::optional(arrival_ns)
                                                  : nanoseconds(seconds.substr(0, seconds.find_first_of(",}")));
    const auto made = samples.made_of(channel.topic, json, time_ns.value_or(0));
    if (!utc.is_known() || !time_ns) {
      without_utc += made.size();
      continue;
    }
    for (const RosMessage& each : made) bag.add(each, static_cast<std::uint64_t>(arrival_ns));
  }
  Exported exported{{path}, {}};
  if (bag.messages() == 0)
    exported.remarks.emplace_back("no message of the log has a type in ROS 2: an empty bag");
  if (without_utc > 0)
    exported.remarks.push_back(fmt::format("{} messages are of before UTC was known: left out", without_utc));
  for (const auto& remark : log.remarks()) exported.remarks.push_back(log.name() + ": " + remark);
  progress(1.0);
  bag.commit();
  return exported;
}

}  // namespace

Exported export_ros2(const std::filesystem::path& log, const std::filesystem::path& bag,
                     const Progress& progress) {
  return export_bag(log, bag, progress, RosAxes::rep103);
}

Exported export_ros2_ned(const std::filesystem::path& log, const std::filesystem::path& bag,
                         const Progress& progress) {
  return export_bag(log, bag, progress, RosAxes::ned);
}

}  // namespace navcal::record
