// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "analysis/noise/noise_run.h"

namespace navcal::report {

/// A table for a terminal, with remarks below each channel.
[[nodiscard]] std::string noise_text(const analysis::NoiseReport& report);

/// One JSON object in a line (docs/noise.md describes the keys).
[[nodiscard]] std::string noise_json(const analysis::NoiseReport& report);

/// The page of `navcal noise`: table, Allan deviations of each device, and of each channel its readings with the
/// parts at rest, Allan deviation and spectrum.
[[nodiscard]] std::string noise_page(const analysis::NoiseReport& report);

}  // namespace navcal::report
