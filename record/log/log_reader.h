// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "record/log/mcap_format.h"
#include "record/log/mcap_summary.h"
#include "record/read_window.h"

namespace navcal::record {

/// A message whose checksum holds; `data` with it, valid until the next call of next().
struct LogMessage {
  std::uint16_t channel = 0;
  std::uint64_t offset = 0;  ///< of its record in the file
  std::uint64_t log_time_ns = 0;
  std::uint64_t publish_time_ns = 0;
  std::string_view data;
};

struct LogChannel {
  std::string topic;
  bool raw = false;
  std::map<std::string, std::string, std::less<>> metadata;
  std::uint64_t messages = 0;
  std::uint64_t bytes = 0;  ///< of their data
};

/// Reads a log from front to back in constant memory, and past damage: see "Reading a damaged file" in
/// docs/log-format.md.
class LogReader {
 public:
  /// `name` stands for the file in messages. Throws BadRecording when it is not a log.
  LogReader(std::unique_ptr<ByteSource> source, std::string name);

  std::optional<LogMessage> next();

  struct Stretch {
    std::uint64_t offset = 0;
    std::uint64_t length = 0;
  };
  /// Complete once next() has answered nullopt.
  struct Findings {
    bool finished = false;            ///< it has its whole end: DataEnd, summary, footer, magic
    std::uint64_t bad_crc = 0;        ///< messages passed over
    std::uint64_t damaged_bytes = 0;  ///< passed over until a record that holds
    std::uint64_t tail_bytes = 0;     ///< behind the last whole record of an unfinished file
    bool tail_is_zero = true;         ///< space that was taken and not yet used
    std::uint64_t data_end = 0;       ///< where the last whole record of the data section ends
    std::vector<Stretch> stretches;   ///< where the damaged bytes are; the first thousand
  };
  [[nodiscard]] const Findings& findings() const { return findings_; }
  [[nodiscard]] const std::map<std::uint16_t, LogChannel>& channels() const { return channels_; }
  [[nodiscard]] const McapSummary& summary() const { return summary_; }
  /// Of the file: of its metadata record (docs/log-format.md).
  [[nodiscard]] const std::map<std::string, std::string, std::less<>>& metadata() const { return metadata_; }
  /// Remarks for the user; if there are very many, the first ones and a count.
  [[nodiscard]] const std::vector<std::string>& remarks() const { return remarks_; }
  /// log_time less monotonic time.
  [[nodiscard]] std::int64_t log_offset_ns() const { return log_offset_ns_; }
  [[nodiscard]] double progress() const;
  [[nodiscard]] const std::string& name() const { return name_; }

 private:
  enum class Verdict : std::uint8_t { good, bad_crc, damaged };
  struct Record {
    Opcode opcode{};
    std::string_view content;
    std::size_t length = 0;  ///< with its head
  };

  [[nodiscard]] std::optional<Record> record_here(std::uint64_t limit);
  [[nodiscard]] Verdict judge(const Record& record);
  [[nodiscard]] bool good_at(std::size_t distance);
  [[nodiscard]] bool define(const Record& record);
  LogMessage hand_out(const Record& record);
  void resynchronise();
  void end_in_tail(bool zero_tail);
  void read_end();
  void remark(std::string text);

  ReadWindow window_;
  std::string name_;
  std::size_t pass_ = 0;  ///< length of the record handed out last
  bool ended_ = false;
  std::map<std::uint16_t, LogChannel> channels_;
  std::map<std::string, std::string, std::less<>> metadata_;
  McapSummary summary_;
  std::int64_t log_offset_ns_ = 0;
  std::uint64_t definition_bytes_ = 0;
  std::uint64_t remarks_left_out_ = 0;
  Findings findings_;
  std::vector<std::string> remarks_;
};

}  // namespace navcal::record
