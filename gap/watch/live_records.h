// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "config/settings.h"
#include "gap/watch/watch.h"
#include "pipeline/pipeline.h"

namespace navcal::gap {

/// Hands a capture or a log to a watch as if it came now. `settings`: as for load_mission(). `go_on` is called
/// with the share that is done; false ends it. Throws record::BadRecording.
void watch_recording(const std::filesystem::path& file, const std::optional<config::Settings>& settings,
                     Watch& watch, const std::function<bool(double)>& go_on);

/// Request to a daemon for the lines that LiveRecords reads (docs/status-protocol.md, RECORD), with its newline.
[[nodiscard]] std::string_view live_request();

/// Reads the lines of a daemon's status socket: samples, commands to the motor card, and where the vehicle is.
/// Times are UTC.
class LiveRecords {
 public:
  /// `settings`: samples get the number of the port there that has the name of their device; those of a device
  /// that it lacks are counted as bad. Without it all are of port 0.
  explicit LiveRecords(const std::optional<config::Settings>& settings = std::nullopt);

  /// Takes one line, without its end. Samples and orders go to `watch`, where there is one. Lines of other classes
  /// are passed over; a line that is no JSON object, or a record that cannot be read, is counted.
  void take(std::string_view line, Watch* watch);

  [[nodiscard]] std::uint64_t samples() const { return samples_; }
  [[nodiscard]] std::uint64_t bad() const { return bad_; }
  /// Reports that the daemon left out because this client was slow.
  [[nodiscard]] std::uint64_t dropped() const { return dropped_; }
  /// The Earth's field by the first fix and its date; empty before one.
  [[nodiscard]] const std::optional<EarthField>& field() const { return field_; }

 private:
  class Counting;
  void take_record(std::string_view line, Watch* watch);

  pipeline::Pipeline pipeline_;
  std::map<std::string, std::uint16_t, std::less<>> ports_;  ///< by device
  std::uint64_t samples_ = 0, bad_ = 0, dropped_ = 0;
  std::int64_t newest_ns_ = 0;
  std::optional<EarthField> field_;
};

}  // namespace navcal::gap
