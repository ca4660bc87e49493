// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "protocols/samples_line.h"

namespace navcal::analysis {

/// Longer names of messages are cut or refused: each message may be told by its name.
inline constexpr std::size_t kLongestName = 256;

/// One sample of a log of another system.
struct ImportedSample {
  std::string_view message;              ///< its name in that log: "IMU[0]"
  std::string_view port;                 ///< source instrument, the name of a port in the navcal log
  std::int64_t time_ns = 0;              ///< on the clock of that log
  std::optional<std::int64_t> utc_ns{};  ///< time of validity that the message itself states
  bool continues = false;                ///< a further sample of the same message on the same port
};

/// Takes what a reader finds in a log of another system.
class ImportSink {
 public:
  virtual ~ImportSink() = default;
  /// `line` has its class and values, in the units of navcal; the time is added here.
  virtual void sample(const ImportedSample& sample, protocols::samples_line::LineWriter& line) = 0;
  /// A message that is not taken. `message` may say why: "MAG[1] (not healthy)".
  virtual void left(std::string_view message) = 0;
  /// A receiver with a fix states this time at `time_ns` of the log's clock.
  virtual void utc(std::int64_t time_ns, std::int64_t utc_ns) = 0;
  /// Bytes of the file that were read. May throw, to end the reading.
  virtual void progress(std::uint64_t done) = 0;
};

/// Standard error of the heading of a nearly level vehicle, by the variances of w and z of its quaternion: each is
/// a quarter of the heading's, times the square of the other one. nullopt where they are none.
[[nodiscard]] inline std::optional<double> heading_std_of(std::optional<double> w, std::optional<double> z) {
  const double square = 4 * (w.value_or(NAN) + z.value_or(NAN));
  return square > 0 ? std::optional(std::sqrt(square)) : std::nullopt;
}

/// What a reader has to say of a whole file.
struct ImportFindings {
  bool times_are_utc = false;             ///< else its clock counts from an unknown moment, such as the boot
  std::optional<std::uint64_t> cut_at{};  ///< first byte of a record that is not whole at the end of the file
  std::uint64_t damaged_bytes = 0;        ///< passed over until the next record
  std::vector<std::string> remarks{};
  bool has_corrected_fields = false;  ///< of the compass: the autopilot's calibration is still in them
};

}  // namespace navcal::analysis
