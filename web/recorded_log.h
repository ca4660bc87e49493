// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "base/descriptor.h"

namespace navcal::web {

/// The JSON messages of a log, in the order of their arrivals, each to be had at once. It is read once to its end
/// when it is opened, past damage as record::LogReader does.
class RecordedLog {
 public:
  struct Entry {
    std::int64_t time_ns = 0;  ///< log_time: the arrival, on a scale near UTC
    std::uint64_t offset = 0;  ///< of its bytes in the file
    std::uint32_t length = 0;
    std::uint16_t topic = 0;  ///< index into topics()
  };
  /// Called now and then with how far the file has been read, 0..1.
  using Progress = std::function<void(double)>;

  /// Throws record::BadRecording, which names the file, when it is no log or has no messages to show.
  RecordedLog(const std::filesystem::path& file, const Progress& progress);

  [[nodiscard]] const std::vector<Entry>& entries() const { return entries_; }
  [[nodiscard]] const std::vector<std::string>& topics() const { return topics_; }
  /// The text of a message; valid until the next call. Empty when the file cannot be read any more.
  [[nodiscard]] std::string_view text(const Entry& entry);
  /// Remarks for the user: damage, an unfinished end.
  [[nodiscard]] const std::vector<std::string>& remarks() const { return remarks_; }

 private:
  void read(const std::filesystem::path& file, const Progress& progress);

  std::vector<Entry> entries_;
  std::vector<std::string> topics_;
  std::vector<std::string> remarks_;
  base::Descriptor file_;
  std::string text_;
};

}  // namespace navcal::web
