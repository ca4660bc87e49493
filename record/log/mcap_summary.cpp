// SPDX-License-Identifier: Apache-2.0
#include "record/log/mcap_summary.h"

#include <algorithm>

#include "record/log/checksum.h"
#include "record/log/mcap_format.h"

namespace navcal::record {
namespace {

/// Notes where each group of records begins, for the summary offset section.
class Groups {
 public:
  Groups(std::string& out, std::uint64_t file_offset) : out_(out), shift_(file_offset - out.size()) {}

  template <class Append>
  void add(Opcode opcode, Append append) {
    const std::uint64_t start = here();
    append();
    if (here() == start) return;
    RecordScope record(offsets_, Opcode::summary_offset);
    offsets_ += static_cast<char>(opcode);
    append_le(offsets_, start);
    append_le(offsets_, here() - start);
  }
  [[nodiscard]] std::uint64_t here() const { return out_.size() + shift_; }
  [[nodiscard]] const std::string& offsets() const { return offsets_; }

 private:
  std::string& out_;
  std::uint64_t shift_;
  std::string offsets_;
};

}  // namespace

void McapSummary::add_channel(std::uint16_t id, std::string_view record) {
  channels_.try_emplace(id, Channel{std::string(record), 0});
}

void McapSummary::add_metadata(std::uint64_t offset, std::uint64_t length, std::string_view name) {
  ++metadata_;
  RecordScope record(metadata_index_, Opcode::metadata_index);
  append_le(metadata_index_, offset);
  append_le(metadata_index_, length);
  append_mcap_string(metadata_index_, name);
}

void McapSummary::add_message(std::uint16_t channel, std::uint64_t log_time_ns) {
  ++messages_;
  start_ns_ = std::min(start_ns_, log_time_ns);
  end_ns_ = std::max(end_ns_, log_time_ns);
  if (const auto found = channels_.find(channel); found != channels_.end()) ++found->second.messages;
}

void McapSummary::append_statistics(std::string& out) const {
  RecordScope record(out, Opcode::statistics);
  append_le(out, messages_);
  append_le(out, static_cast<std::uint16_t>(schemas_.size()));
  append_le(out, static_cast<std::uint32_t>(channels_.size()));
  append_le(out, std::uint32_t{0});  // attachments
  append_le(out, metadata_);
  append_le(out, chunks_);
  append_le(out, start_ns());
  append_le(out, end_ns_);
  append_le(out, static_cast<std::uint32_t>(channels_.size() * (sizeof(std::uint16_t) + sizeof(std::uint64_t))));
  for (const auto& [id, channel] : channels_) {
    append_le(out, id);
    append_le(out, channel.messages);
  }
}

void McapSummary::append_end(std::string& out, std::uint64_t data_bytes) const {
  const std::size_t begin = out.size();
  {
    RecordScope record(out, Opcode::data_end);
    append_le(out, std::uint32_t{0});  // no sum over the data section: every message has its own
  }
  const std::size_t summary = out.size();
  Groups groups(out, data_bytes + (summary - begin));
  const std::uint64_t summary_start = groups.here();
  groups.add(Opcode::schema, [&] {
    for (const auto& [id, record] : schemas_) out += record;
  });
  groups.add(Opcode::channel, [&] {
    for (const auto& [id, channel] : channels_) out += channel.record;
  });
  groups.add(Opcode::statistics, [&] { append_statistics(out); });
  groups.add(Opcode::chunk_index, [&] { out += chunk_indexes_; });
  groups.add(Opcode::metadata_index, [&] { out += metadata_index_; });
  const std::uint64_t offsets_start = groups.here();
  out += groups.offsets();

  out += static_cast<char>(Opcode::footer);
  append_le(out, std::uint64_t{kFooterLength});
  append_le(out, summary_start);
  append_le(out, offsets_start);
  append_le(out, crc32(std::string_view(out).substr(summary)));
  out += kMcapMagic;
}

}  // namespace navcal::record
