// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deque>

#include "record/capture/capture_reader.h"
#include "record/recording.h"

namespace navcal::record {

/// A capture as a recording: its times are UTC, so its mapping is the identity.
class CaptureRecording final : public Recording {
 public:
  CaptureRecording(std::unique_ptr<ByteSource> source, std::string name);

  [[nodiscard]] const config::Settings& settings() const override { return settings_; }
  std::optional<Entry> next() override;
  [[nodiscard]] const std::vector<std::string>& remarks() const override { return reader_.remarks(); }
  [[nodiscard]] double progress() const override { return reader_.progress(); }

 private:
  Entry begin();
  void queue_marks(std::int64_t time_ns);

  CaptureReader reader_;
  config::Settings settings_;
  std::optional<RawRead> first_;  ///< read ahead for the time of the mapping
  std::deque<LoggedEvent> marks_;
  std::int64_t newest_ns_ = 0;  ///< time of the read that the reader gave last
  bool mapping_told_ = false;
};

}  // namespace navcal::record
