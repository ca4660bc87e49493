// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "analysis/decode_summary.h"
#include "protocols/described/description.h"

namespace navcal::analysis {

/// Bytes of a device with the time of their arrival; nullopt where the capture has none.
struct TimedBytes {
  protocols::Bytes bytes;
  std::optional<std::int64_t> arrival_ns;
};

/// What a capture says of one field, in the unit of the description.
struct FieldFinding {
  std::string name, unit;
  std::uint64_t values = 0;      ///< frames that had one
  std::uint64_t absent = 0;      ///< frames that had none
  std::uint64_t impossible = 0;  ///< values beyond the bounds of the field or of its meaning
  std::uint64_t changes = 0;     ///< values that differ from the one before
  double low = 0, high = 0, mean = 0;
};

struct KindFinding {
  protocols::FrameId id;
  std::uint64_t frames = 0;
  std::uint64_t impossible = 0;   ///< frames with a value that cannot be, or with text that is no number
  std::optional<double> rate_Hz;  ///< by the arrivals of the first and the last
  std::vector<FieldFinding> fields;
};

/// Bytes that belong to no frame.
struct SkippedRun {
  std::uint64_t offset = 0, length = 0;
  std::string first_bytes;  ///< at most sixteen
};

/// What a description finds in a capture.
struct DeviceFindings {
  DecodeSummary summary;
  std::vector<KindFinding> kinds;
  std::vector<SkippedRun> skipped;  ///< the first few
  std::uint64_t skipped_runs = 0;
  std::vector<std::string> warnings;
};

/// Reads a capture with a description. `next` gives its bytes, an empty piece at the end.
[[nodiscard]] DeviceFindings check_device(const protocols::described::Description& description,
                                          const std::function<TimedBytes()>& next);

[[nodiscard]] std::string to_text(const DeviceFindings& findings);
/// One JSON object a line (docs/cli.md, `devices check`).
[[nodiscard]] std::string to_json(const DeviceFindings& findings);

/// "A5 5A".
[[nodiscard]] std::string hex_of(std::string_view bytes);

/// What a user should look at before trusting a description: each one sentence.
[[nodiscard]] std::vector<std::string> warnings_about(const protocols::described::Description& description,
                                                      const DeviceFindings& findings);

}  // namespace navcal::analysis
