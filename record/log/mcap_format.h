// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>

namespace navcal::record {

/// The container: https://mcap.dev/spec, version 0. All integers are little-endian.
inline constexpr std::string_view kMcapMagic{"\x89MCAP0\r\n", 8};

enum class Opcode : std::uint8_t {
  header = 0x01,
  footer = 0x02,
  schema = 0x03,
  channel = 0x04,
  message = 0x05,
  chunk = 0x06,  ///< these three are in bags of ROS alone
  message_index = 0x07,
  chunk_index = 0x08,
  statistics = 0x0B,
  metadata = 0x0C,
  metadata_index = 0x0D,
  summary_offset = 0x0E,
  data_end = 0x0F,
  last_defined = 0x0F,
  masked = 0x80,  ///< private range: what finish_log() makes of a damaged stretch; every reader passes over it
};

/// Opcode and length of the content.
inline constexpr std::size_t kRecordHead = 9;
/// Channel, sequence, log_time, publish_time.
inline constexpr std::size_t kMessageHead = 22;
inline constexpr std::size_t kFooterLength = 20;
/// A length beyond this is damage: the encoder writes nothing near it.
inline constexpr std::uint64_t kMaxRecord = 16ULL << 20;

inline constexpr std::string_view kProfile = "navcal";
/// Key of the metadata record "navcal": what log_time exceeds monotonic time by.
inline constexpr std::string_view kLogOffsetKey = "log_time_minus_monotonic_ns";
inline constexpr std::string_view kJsonEncoding = "json";
inline constexpr std::string_view kRawEncoding = "x-navcal-raw";

template <class Integer>
void append_le(std::string& out, Integer value) {
  for (std::size_t i = 0; i < sizeof(Integer); ++i) {
    out += static_cast<char>((static_cast<std::uint64_t>(value) >> (8 * i)) & 0xFFU);
  }
}

/// `bytes` must hold at least sizeof(Integer) from `at` on.
template <class Integer>
[[nodiscard]] Integer read_le(std::string_view bytes, std::size_t at) {
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < sizeof(Integer); ++i) {
    value |= static_cast<std::uint64_t>(static_cast<unsigned char>(bytes[at + i])) << (8 * i);
  }
  return static_cast<Integer>(value);
}

inline void append_mcap_string(std::string& out, std::string_view text) {
  append_le(out, static_cast<std::uint32_t>(text.size()));
  out += text;
}

/// A map of texts.
[[nodiscard]] inline std::string mcap_map(
    std::initializer_list<std::pair<std::string_view, std::string_view>> pairs) {
  std::string map;
  for (const auto& [key, value] : pairs) {
    append_mcap_string(map, key);
    append_mcap_string(map, value);
  }
  return map;
}

/// Begins a record; its length is filled in when this goes out of scope.
class RecordScope {
 public:
  RecordScope(std::string& out, Opcode opcode) : out_(out) {
    out_ += static_cast<char>(opcode);
    append_le(out_, std::uint64_t{0});
    content_ = out_.size();
  }
  RecordScope(const RecordScope&) = delete;
  RecordScope& operator=(const RecordScope&) = delete;
  ~RecordScope() {
    const std::uint64_t length = out_.size() - content_;
    for (std::size_t i = 0; i < 8; ++i) out_[content_ - 8 + i] = static_cast<char>((length >> (8 * i)) & 0xFFU);
  }

 private:
  std::string& out_;
  std::size_t content_ = 0;
};

inline void append_schema(std::string& out, std::uint16_t id, std::string_view name, std::string_view encoding,
                          std::string_view data) {
  const RecordScope record(out, Opcode::schema);
  append_le(out, id);
  append_mcap_string(out, name);
  append_mcap_string(out, encoding);
  append_mcap_string(out, data);
}

/// `metadata`: of mcap_map().
inline void append_channel(std::string& out, std::uint16_t id, std::uint16_t schema, std::string_view topic,
                           std::string_view encoding, std::string_view metadata) {
  const RecordScope record(out, Opcode::channel);
  append_le(out, id);
  append_le(out, schema);
  append_mcap_string(out, topic);
  append_mcap_string(out, encoding);
  append_mcap_string(out, metadata);
}

/// Magic and Header: how every log begins.
[[nodiscard]] inline std::string empty_log_head(std::string_view profile = kProfile) {
  std::string out(kMcapMagic);
  const RecordScope record(out, Opcode::header);
  append_mcap_string(out, profile);
  append_mcap_string(out, "navcal");
  return out;
}

}  // namespace navcal::record
