// SPDX-License-Identifier: Apache-2.0
#include "record/log/log_reader.h"

#include <fmt/format.h>

#include <charconv>

#include "record/log/checksum.h"
#include "record/log/mcap_fields.h"
#include "record/recording.h"

namespace navcal::record {
namespace {

constexpr std::uint8_t kChunkOpcode = 0x06;
constexpr std::size_t kMaxRemarks = 40;
/// A longer topic is damage; remarks name topics.
constexpr std::size_t kMaxTopic = 256;
constexpr std::size_t kMaxStretches = 1000;
/// All schemas and channels together; a log has a few kB.
constexpr std::uint64_t kMaxDefinitions = 16ULL << 20;
/// Only a message up to this size is looked for behind damage, which bounds the time spent on false beginnings.
constexpr std::uint64_t kMaxFound = 64ULL << 10;

std::int64_t integer_or_zero(std::string_view text) {
  std::int64_t value = 0;
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

bool zero(std::string_view bytes) { return bytes.find_first_not_of('\0') == std::string_view::npos; }

}  // namespace

LogReader::LogReader(std::unique_ptr<ByteSource> source, std::string name)
    : window_(std::move(source)), name_(std::move(name)) {
  if (!window_.ensure(kMcapMagic.size()) || window_.view().substr(0, kMcapMagic.size()) != kMcapMagic) {
    throw BadRecording(name_ + ": byte 0: not an MCAP file");
  }
  window_.advance(kMcapMagic.size());
  const auto header = record_here(kMaxRecord);
  if (!header || header->opcode != Opcode::header) throw BadRecording(name_ + ": byte 8: no whole MCAP header");
  const std::string_view profile = McapFields(header->content).string();
  if (profile != kProfile) {
    throw BadRecording(
        fmt::format("{}: byte 8: an MCAP file, but not a log of navcal (its profile is \"{}\"); "
                    "\"navcal log import\" reads bags of ROS 2",
                    name_, profile.substr(0, 64)));
  }
  window_.advance(header->length);
  findings_.data_end = window_.offset();
}

std::optional<LogMessage> LogReader::next() {
  window_.advance(pass_);
  pass_ = 0;
  while (!ended_) {
    if (!window_.more()) {
      end_in_tail(true);
      break;
    }
    const auto record = record_here(kMaxRecord);
    const Verdict verdict = record ? judge(*record) : Verdict::damaged;
    if (verdict == Verdict::bad_crc && good_at(record->length)) {
      ++findings_.bad_crc;
      remark(fmt::format("byte {}: checksum of a message does not hold: passed over", window_.offset()));
      window_.advance(record->length);
      continue;
    }
    if (verdict != Verdict::good) {
      resynchronise();
      continue;
    }
    if (record->opcode == Opcode::data_end) {
      read_end();
      break;
    }
    findings_.data_end = window_.offset() + record->length;
    if (record->opcode == Opcode::message) return hand_out(*record);
    window_.advance(record->length);
  }
  return std::nullopt;
}

std::optional<LogReader::Record> LogReader::record_here(std::uint64_t limit) {
  if (!window_.ensure(kRecordHead)) return std::nullopt;
  const auto length = read_le<std::uint64_t>(window_.view(), 1);
  if (length > limit || !window_.ensure(kRecordHead + length)) return std::nullopt;
  return Record{static_cast<Opcode>(window_.view().front()), window_.view().substr(kRecordHead, length),
                kRecordHead + static_cast<std::size_t>(length)};
}

LogReader::Verdict LogReader::judge(const Record& record) {
  const auto verdict = [](bool good) { return good ? Verdict::good : Verdict::damaged; };
  switch (record.opcode) {
    case Opcode::message: {
      if (record.content.size() < kMessageHead) return Verdict::damaged;
      const auto channel = channels_.find(read_le<std::uint16_t>(record.content, 0));
      if (channel == channels_.end()) return Verdict::bad_crc;
      const std::string_view data = record.content.substr(kMessageHead);
      const bool holds = channel->second.raw ? raw_crc_holds(data) : json_crc_holds(data);
      return holds ? Verdict::good : Verdict::bad_crc;
    }
    case Opcode::schema:
    case Opcode::channel:
    case Opcode::metadata: return verdict(define(record));
    case Opcode::data_end: return verdict(record.content.size() == sizeof(std::uint32_t));
    default: break;
  }
  const auto opcode = static_cast<std::uint8_t>(record.opcode);
  if (opcode == kChunkOpcode && summary_.messages() == 0) {
    throw BadRecording(fmt::format("{}: byte {}: chunked by another tool; navcal reads its own logs only", name_,
                                   window_.offset()));
  }
  if (opcode < static_cast<std::uint8_t>(Opcode::masked)) return Verdict::damaged;
  findings_.damaged_bytes += record.length;
  return Verdict::good;
}

/// Whether a record that holds begins there, so that the length which led there can be trusted.
bool LogReader::good_at(std::size_t distance) {
  if (!window_.ensure(distance + kRecordHead)) return false;
  const auto length = read_le<std::uint64_t>(window_.view(), distance + 1);
  if (length > kMaxRecord || !window_.ensure(distance + kRecordHead + length)) return false;
  const auto opcode = static_cast<Opcode>(window_.view()[distance]);
  if (opcode == Opcode::masked) return true;
  if (opcode != Opcode::message && opcode != Opcode::data_end) return false;
  return judge({opcode, window_.view().substr(distance + kRecordHead, length), 0}) == Verdict::good;
}

bool LogReader::define(const Record& record) {
  if (definition_bytes_ + record.length > kMaxDefinitions) return false;
  const std::string_view whole = window_.view().substr(0, record.length);
  McapFields fields(record.content);
  if (record.opcode == Opcode::metadata) {
    const std::string_view metadata_name = fields.string();
    McapFields map(fields.string());
    while (fields.complete() && map.complete() && !map.at_end()) {
      const std::string_view key = map.string();
      const std::string_view value = map.string();
      metadata_.insert_or_assign(std::string(key), std::string(value));
      if (key == kLogOffsetKey) log_offset_ns_ = integer_or_zero(value);
    }
    if (!fields.complete() || !map.complete()) return false;
    summary_.add_metadata(window_.offset(), record.length, metadata_name);
  } else if (record.opcode == Opcode::schema) {
    const auto id = fields.integer<std::uint16_t>();
    for (int i = 0; i < 3; ++i) fields.string();
    if (!fields.complete() || id == 0) return false;
    summary_.add_schema(id, whole);
  } else {
    const auto id = fields.integer<std::uint16_t>();
    fields.integer<std::uint16_t>();
    LogChannel channel;
    channel.topic = fields.string();
    if (channel.topic.size() > kMaxTopic) return false;
    channel.raw = fields.string() == kRawEncoding;
    McapFields map(fields.string());
    while (map.complete() && !map.at_end()) {
      const std::string_view key = map.string();
      channel.metadata.try_emplace(std::string(key), map.string());
    }
    if (!fields.complete() || !map.complete()) return false;
    if (!channels_.try_emplace(id, std::move(channel)).second) return true;
    summary_.add_channel(id, whole);
  }
  definition_bytes_ += record.length;
  return true;
}

LogMessage LogReader::hand_out(const Record& record) {
  LogMessage message;
  message.channel = read_le<std::uint16_t>(record.content, 0);
  message.offset = window_.offset();
  message.log_time_ns = read_le<std::uint64_t>(record.content, 6);
  message.publish_time_ns = read_le<std::uint64_t>(record.content, 14);
  message.data = record.content.substr(kMessageHead);
  LogChannel& channel = channels_.find(message.channel)->second;
  ++channel.messages;
  channel.bytes += message.data.size();
  summary_.add_message(message.channel, message.log_time_ns);
  pass_ = record.length;
  return message;
}

void LogReader::resynchronise() {
  const std::uint64_t begin = window_.offset();
  bool all_zero = window_.view().front() == '\0';
  window_.advance(1);
  while (window_.more()) {
    const std::size_t candidate = window_.view().find(static_cast<char>(Opcode::message));
    const std::string_view before = window_.view().substr(0, candidate);
    all_zero = all_zero && zero(before);
    window_.advance(before.size());
    if (candidate == std::string_view::npos) continue;
    const auto record = record_here(kMaxFound);
    if (record && judge(*record) == Verdict::good) {
      const std::uint64_t length = window_.offset() - begin;
      findings_.damaged_bytes += length;
      if (findings_.stretches.size() < kMaxStretches) findings_.stretches.push_back({begin, length});
      remark(fmt::format("byte {}: {} damaged bytes passed over", begin, length));
      return;
    }
    all_zero = false;
    window_.advance(1);
  }
  end_in_tail(all_zero);
}

void LogReader::end_in_tail(bool zero_tail) {
  ended_ = true;
  findings_.tail_bytes = window_.offset() - findings_.data_end;
  findings_.tail_is_zero = zero_tail;
  if (findings_.tail_bytes == 0) {
    remark("unfinished: ends after a whole record");
  } else {
    remark(fmt::format("unfinished: {} bytes after the last whole record{}", findings_.tail_bytes,
                       zero_tail ? ", all zero: space taken in advance" : ""));
  }
}

void LogReader::read_end() {
  ended_ = true;
  findings_.data_end = window_.offset();
  window_.advance(kRecordHead + sizeof(std::uint32_t));
  std::uint32_t crc = 0;
  while (const auto record = record_here(kMaxRecord)) {
    const std::string_view whole = window_.view().substr(0, record->length);
    const auto opcode = static_cast<std::uint8_t>(record->opcode);
    if (opcode > static_cast<std::uint8_t>(Opcode::last_defined)) break;
    if (record->opcode == Opcode::footer && record->content.size() == kFooterLength) {
      const std::size_t summed = record->length - sizeof(std::uint32_t);
      const auto stated = read_le<std::uint32_t>(whole, summed);
      const bool holds = stated == 0 || stated == crc32(whole.substr(0, summed), crc);
      window_.advance(record->length);
      findings_.finished = holds && window_.ensure(kMcapMagic.size()) && window_.view() == kMcapMagic;
      if (findings_.finished) window_.advance(kMcapMagic.size());
      break;
    }
    crc = crc32(whole, crc);
    window_.advance(record->length);
  }
  if (findings_.finished && !window_.more()) return;
  findings_.finished = false;
  while (window_.more()) window_.advance(window_.view().size());
  findings_.tail_bytes = window_.offset() - findings_.data_end;
  findings_.tail_is_zero = false;
  remark(fmt::format("unfinished: byte {}: its summary is incomplete or damaged", findings_.data_end));
}

void LogReader::remark(std::string text) {
  if (remarks_.size() < kMaxRemarks) {
    remarks_.push_back(std::move(text));
  } else {
    // The last place says how much was left out, so that memory stays bounded whatever the damage.
    ++remarks_left_out_;
    remarks_.back() = fmt::format("and {} more findings, the last: {}", remarks_left_out_ + 1, text);
  }
}

double LogReader::progress() const {
  return window_.size() == 0 ? 1.0 : static_cast<double>(window_.offset()) / static_cast<double>(window_.size());
}

}  // namespace navcal::record
