// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "analysis/noise/noise_run.h"

namespace navcal::report {

/// A table for a terminal, with remarks below each channel.
[[nodiscard]] std::string noise_text(const analysis::NoiseReport& report);

/// One JSON object in a line (docs/noise.md describes the keys).
[[nodiscard]] std::string noise_json(const analysis::NoiseReport& report);

/// The page of `navcal noise`: table, Allan deviations of each device, and of each channel its readings with the
/// parts at rest, Allan deviation and spectrum.
[[nodiscard]] std::string noise_page(const analysis::NoiseReport& report);

// Sentences and numbers about the noise of a channel, for text, page and JSON.

/// "at rest: 0 to 120 s, 181 to 3600 s (59 min 0 s)", or why nothing is.
[[nodiscard]] std::string rest_sentence(const analysis::NoiseReport& report);

/// Remarks that a table does not hold: correlation, rounding, lines, why there is no noise, and which recording a
/// missing term would need.
[[nodiscard]] std::vector<std::string> noise_remarks(const analysis::RecordedChannel& recorded);

/// Cells of a row: name, unit, readings, rate, resolution, noise of a reading, white noise, bias instability,
/// random walk. A limit is "< 0.01", what is missing "-". `plus_minus` stands between value and error.
[[nodiscard]] std::vector<std::string> noise_row(const analysis::RecordedChannel& recorded,
                                                 std::string_view plus_minus);
[[nodiscard]] std::vector<std::string> noise_heads();

}  // namespace navcal::report
