// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "analysis/noise/noise_run.h"

// Sentences and numbers about the noise of a channel, for text, page and JSON.
namespace navcal::report {

/// "at rest: 0 to 120 s, 181 to 3600 s (59 min 0 s)", or why nothing is.
[[nodiscard]] std::string rest_sentence(const analysis::NoiseReport& report);

/// What a table does not say: correlation, rounding, lines, why there is no noise, and which recording a missing
/// term would need.
[[nodiscard]] std::vector<std::string> noise_remarks(const analysis::RecordedChannel& recorded);

/// Cells of a row: name, unit, readings, rate, resolution, noise of a reading, white noise, bias instability,
/// random walk. A limit is "< 0.01", what is missing "-". `plus_minus` stands between value and error.
[[nodiscard]] std::vector<std::string> noise_row(const analysis::RecordedChannel& recorded,
                                                 std::string_view plus_minus);
[[nodiscard]] std::vector<std::string> noise_heads();

}  // namespace navcal::report
