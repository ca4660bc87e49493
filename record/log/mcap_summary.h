// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>

namespace navcal::record {

/// Data for the summary at the end of a file, gathered while the file is written, or read again.
class McapSummary {
 public:
  struct Channel {
    std::string record;
    std::uint64_t messages = 0;
  };

  /// Whole records, as they stand in the data section. A second one of the same id changes nothing.
  void add_schema(std::uint16_t id, std::string_view record) { schemas_.try_emplace(id, record); }
  void add_channel(std::uint16_t id, std::string_view record);
  void add_metadata(std::uint64_t offset, std::uint64_t length, std::string_view name);
  /// Index of a chunk, a whole record.
  void add_chunk(std::string_view index_record) {
    chunk_indexes_ += index_record;
    ++chunks_;
  }
  void add_message(std::uint16_t channel, std::uint64_t log_time_ns);

  /// DataEnd, summary and summary offset sections, Footer and magic, for a data section of `data_bytes`.
  void append_end(std::string& out, std::uint64_t data_bytes) const;

  [[nodiscard]] std::uint64_t messages() const { return messages_; }
  [[nodiscard]] std::uint64_t start_ns() const { return messages_ == 0 ? 0 : start_ns_; }
  [[nodiscard]] std::uint64_t end_ns() const { return end_ns_; }

 private:
  void append_statistics(std::string& out) const;

  std::map<std::uint16_t, std::string> schemas_;
  std::map<std::uint16_t, Channel> channels_;
  std::string metadata_index_;
  std::uint32_t metadata_ = 0;
  std::string chunk_indexes_;
  std::uint32_t chunks_ = 0;
  std::uint64_t messages_ = 0;
  std::uint64_t start_ns_ = UINT64_MAX;
  std::uint64_t end_ns_ = 0;
};

}  // namespace navcal::record
