// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>

#include "record/log/log_reader.h"
#include "record/log/log_utc.h"
#include "record/recording.h"

namespace navcal::record {

/// A log as a recording: the raw bytes, the mappings, the events and the changes of calibration; samples are left
/// to be computed anew.
class LogRecording final : public Recording {
 public:
  LogRecording(std::unique_ptr<ByteSource> source, std::string name, LogUtc utc = {});

  [[nodiscard]] const config::Settings& settings() const override { return settings_; }
  std::optional<Entry> next() override;
  [[nodiscard]] const std::vector<std::string>& remarks() const override { return remarks_; }
  [[nodiscard]] double progress() const override { return reader_.progress(); }

 private:
  [[nodiscard]] std::optional<Entry> entry_of(const LogMessage& message);
  [[nodiscard]] std::optional<Entry> raw_entry(const LogMessage& message);
  [[nodiscard]] bool take_configuration(const LogMessage& message);
  void assume_configuration();
  void remark(const LogMessage& message, std::string_view what);
  void note_left_out(std::string_view event, std::string_view message);

  LogReader reader_;
  LogUtc utc_;
  config::Settings settings_;
  std::map<std::uint16_t, std::uint16_t> ports_;  ///< raw channel -> index of its port
  std::optional<Entry> first_;                    ///< read while looking for the configuration
  std::vector<std::string> remarks_;
  std::string left_out_;            ///< as the last event of it says
  std::size_t reader_remarks_ = 0;  ///< how many of the reader's are among ours
};

}  // namespace navcal::record
