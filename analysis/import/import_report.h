// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace navcal::analysis {

/// So the report and the event at the beginning of the log say it.
inline constexpr std::string_view kCorrectedFields =
    "fields of the compass are as the autopilot has corrected them";

/// So the remarks and the event of a log of a device's bytes say it.
inline constexpr std::string_view kNoTimes = "no time is stated: the bytes are placed evenly";

/// What was found in a log of another system, and what became of it.
struct ImportReport {
  enum class Utc : std::uint8_t {
    of_file,  ///< its times are UTC
    of_gps,   ///< by what a receiver stated
    unknown,  ///< times count from the stated date
  };
  /// A message's name, and a port that has samples of it: RAW_IMU has an inertial unit and a compass.
  using Source = std::pair<std::string, std::string>;
  struct Taken {
    std::uint64_t messages = 0;
    std::uint64_t samples = 0;
    std::int64_t first_ns = 0, last_ns = 0;
    /// Messages a second; 0 when there is one only.
    [[nodiscard]] double rate_Hz() const;
  };

  std::string input, output, format;
  std::uint64_t bytes = 0;
  std::map<Source, Taken> taken;
  std::map<std::string, std::uint64_t, std::less<>> left;  ///< messages that were not taken
  Utc utc = Utc::unknown;
  std::int64_t start_utc_ns = 0;  ///< of the first sample
  std::int64_t duration_ns = 0;
  std::uint64_t refused = 0;  ///< samples without a value in range: in the log as bytes, not as samples
  std::optional<std::uint64_t> cut_at{};
  std::uint64_t damaged_bytes = 0;
  std::vector<std::string> remarks;
};

/// The report as text, and as one JSON object (docs/cli.md).
[[nodiscard]] std::string to_text(const ImportReport& report);
[[nodiscard]] std::string to_json(const ImportReport& report);

}  // namespace navcal::analysis
