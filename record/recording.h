// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

#include "base/failure.h"
#include "config/settings.h"
#include "pipeline/calibration.h"
#include "pipeline/utc_mapping.h"
#include "record/log/log_encoder.h"

namespace navcal::record {

/// A file that is not what it should be; what() names file and place (line of a capture, byte of a log).
class BadRecording : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// No read lies between --from and --to.
class NothingInWindow : public base::Failure {
 public:
  using base::Failure::Failure;
};

struct RawRead {
  std::uint16_t port = 0;
  Direction direction = Direction::received;
  std::int64_t time_ns = 0;  ///< monotonic in a log; UTC in a capture (whose mapping is the identity)
  std::vector<std::uint8_t> bytes;
};

/// An event of a log, or an `#event` line of a capture at the time of the last read before it.
struct LoggedEvent {
  std::int64_t time_ns = 0;
  std::string json;
};

/// What became of an order to the motor card; of a log.
struct LoggedCommand {
  std::int64_t time_ns = 0;
  std::string json;
};

struct MappingChange {
  std::int64_t time_ns = 0;
  pipeline::UtcMapping mapping;
};

using Entry = std::variant<RawRead, MappingChange, LoggedEvent, LoggedCommand, pipeline::CalibrationChange>;

/// A time in seconds from the first read, or in UTC.
struct TimeBound {
  double since_start_s = 0;
  std::optional<std::int64_t> utc_ns{};
};
/// Reads "12.5" or "2026-01-01T00:00:12Z"; nullopt: neither.
[[nodiscard]] std::optional<TimeBound> parse_time_bound(const std::string& text);

/// Part of a recording; without a bound to its end.
struct TimeWindow {
  std::optional<TimeBound> from{}, to{};
};

/// Whether a file begins as a log does. Throws BadRecording when it cannot be read.
[[nodiscard]] bool is_log(const std::filesystem::path& file);

/// Capture (.cap) or log (.mcap), told apart by content, read in order and in constant memory.
class Recording {
 public:
  /// Reads outside the window are left out; what else was recorded before it comes at its begin. Throws
  /// BadRecording when the file is neither; next() throws NothingInWindow at the end where no read lies in it.
  static std::unique_ptr<Recording> open(const std::filesystem::path& file, const TimeWindow& window = {});
  virtual ~Recording() = default;

  /// The ports of the recording: from the #port lines, or from the configuration stored in the log.
  [[nodiscard]] virtual const config::Settings& settings() const = 0;
  /// The next entry; nullopt at the end. Throws BadRecording for what cannot be read over.
  virtual std::optional<Entry> next() = 0;
  /// Remarks for the user, each with the file's name: "a.mcap: unfinished: 12 bytes after the last whole record".
  [[nodiscard]] virtual const std::vector<std::string>& remarks() const = 0;
  /// How far the file has been read, 0..1, for progress.
  [[nodiscard]] virtual double progress() const = 0;
};

}  // namespace navcal::record
